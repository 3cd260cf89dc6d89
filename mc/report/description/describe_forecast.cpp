#include "mc/report/description/describe_forecast.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "machine/instruction_sets.hpp"
#include "mc/ensemble/ensemble.hpp"
#include "mc/ensemble/gearbox/solution_choice.hpp"
#include "mc/ensemble/ranks.hpp"
#include "mc/numerics/forecast/forecast.hpp"
#include "mc/numerics/forecast/memory.hpp"
#include "mc/numerics/numerical_error.hpp"
#include "mc/report/description/describe_lives.hpp"
#include "mc/report/description/terminal_text.hpp"
#include "mc/report/gearbox_values.hpp"
#include "mc/results/result_rows.hpp"

namespace gearpod::mc {
namespace {

// Size of the HDF5 file without its rows: names, attributes, the study's text, detection.
constexpr double kFrame_bytes = 45e3;

// Number of integrated tiles. Every rank caches only the solutions that it integrated itself.
IntegrationCounts integrations_of_ranks(const RunCost& cost, const BatchPlan& plan, int ranks) {
    IntegrationCounts counts = cost.integrations;
    const std::array<std::size_t, 2> gearboxes{plan.threshold_gearboxes(), plan.test_rows()};
    for (std::size_t g = 0; g < gearboxes.size(); ++g) {
        const std::size_t tiles = (gearboxes[g] + cost.lanes - 1) / cost.lanes;
        counts.integrated[g] =
            std::min(tiles, counts.integrated[g] * static_cast<std::size_t>(ranks));
    }
    return counts;
}

}  // namespace

double checkpoint_bytes(const BatchPlan& plan, const RowShape& shape) {
    // Each batch has a mark, a count and a checksum; each row has a status
    // (docs/reference/results-file.md).
    const double row = 8.0 * (1.0 + static_cast<double>(shape.values()));
    const auto healthy = static_cast<double>(plan.threshold_batches() * plan.threshold_records());
    const auto test = static_cast<double>(plan.batches() - plan.threshold_batches());
    return 24.0 * static_cast<double>(plan.batches()) + kBatchRows * row * (healthy + test);
}

double results_bytes(const BatchPlan& plan, const RowShape& shape) {
    // Each row also has a group and a status.
    return kFrame_bytes +
           static_cast<double>(plan.rows()) * 8.0 * (2.0 + static_cast<double>(shape.values()));
}

double leader_time_s(double batch_bytes) {
    constexpr double kBatch_s = 14e-6, kByte_s = 2.2e-9;
    return kBatch_s + kByte_s * batch_bytes;
}

RankForecast forecast_ranks(const RunCost& calibration, const BatchPlan& plan,
                            const RowShape& shape, const AnalysisTrial& analysis,
                            const RunForecast& alone, int ranks) {
    const IntegrationCounts integrations = integrations_of_ranks(calibration, plan, ranks);
    const double motion = calibration.motion_bytes;
    const auto batches = static_cast<double>(plan.batches());

    RankForecast forecast;
    RunCost all = calibration;
    all.threads = static_cast<int>(
        std::min(static_cast<double>(calibration.threads) * ranks, std::max(1.0, batches)));
    forecast.busy_threads = all.threads;
    forecast.checkpoint_bytes = checkpoint_bytes(plan, shape);
    forecast.results_bytes = results_bytes(plan, shape);

    const double computing_s = gearboxes_s(all, plan, integrations);
    const double leading_s =
        batches * leader_time_s(forecast.checkpoint_bytes / std::max(1.0, batches));
    forecast.gearboxes_s = std::max(computing_s, leading_s);
    forecast.total_s = alone.setup_s + forecast.gearboxes_s + alone.detection_s;
    forecast.batches_per_s = batches / forecast.gearboxes_s;
    forecast.leader_share = leading_s / forecast.gearboxes_s;
    // Number of ranks that together finish a batch in the time that rank 0 needs to receive one.
    const double thread_s =
        gearboxes_s(calibration, plan, calibration.integrations) * calibration.threads;
    forecast.bounding_ranks = thread_s / leading_s / calibration.threads;
    forecast.rank_bytes = memory_bytes(calibration.memory, integrations, motion, 0.0);
    forecast.leader_bytes = memory_bytes(calibration.memory, integrations, motion, analysis.bytes);
    return forecast;
}

namespace {

// Time limit for the trial gearboxes, and again for the trial analysis.
constexpr double kBudget_s = 1.0;

// Formats seconds with two significant figures, or as whole seconds.
std::string seconds_text(double seconds) {
    return seconds < 0.01   ? "less than 0.01 s"
           : seconds < 9.95 ? fmt::format("{:.2g} s", seconds)
                            : fmt::format("{:.0f} s", seconds);
}

std::string measured_text(const RunCost& calibration, const AnalysisTrial& trial,
                          std::size_t levels) {
    if (calibration.integration_only) {
        return "the time of one mesh period and the number of mesh periods that the damping "
               "requires, because a batch of gearboxes takes too long";
    }
    std::string text =
        fmt::format("{} gearboxes in {:.1f} s",
                    std::ranges::count(calibration.gearboxes, 0U, &GearboxId::repeat),
                    calibration.wall_s + calibration.task_s);
    if (calibration.recorded < calibration.to_record) {
        text +=
            fmt::format(" over {} of {} mesh periods", calibration.recorded, calibration.to_record);
    }
    return text +
           fmt::format("; analysis of {} artificial gearboxes, {} of {} noise levels, in {:.1f} s",
                       trial.rows, trial.levels, levels, trial.trial_s);
}

// Rows of the gearboxes computed to calibrate the forecast.
class CalibrationRows final : public RowSource {
  public:
    explicit CalibrationRows(const RunCost& calibration) : calibration_(calibration) {}
    std::size_t rows() const override { return calibration_.rows.count(); }
    void visit(const std::function<void(const RowBlock&)>& use) const override {
        RowBlock block{0, {}, calibration_.rows.status, calibration_.rows.values};
        for (const GearboxId& id : calibration_.gearboxes) {
            block.group.push_back(static_cast<int>(id.group));
        }
        use(block);
    }

  private:
    const RunCost& calibration_;
};

// Shares of the threads' time, with the same names as in the report of `run`.
std::string shares_text(const Seconds& work, double thread_s) {
    const auto share = [&](double seconds) { return 100.0 * seconds / std::max(1e-9, thread_s); };
    return fmt::format(
        "time integration {:.0f} %, stiffness {:.0f} %, signals {:.0f} %, noise {:.0f} %, "
        "features {:.0f} %",
        share(work.integration), share(work.stiffness + work.sampling), share(work.signals),
        share(work.noise), share(work.features));
}

// Formats a count with two significant figures.
std::string about(double count) {
    const double unit = std::pow(10.0, std::max(0.0, std::floor(std::log10(count)) - 1.0));
    return fmt::format("{:.0f}", unit * std::round(count / unit));
}

// Describes rank 0's work in addition to its own gearboxes.
std::string leader_text(const RankForecast& forecast) {
    const std::string most = about(std::max(1.0, forecast.bounding_ranks));
    return fmt::format("receives and writes {:.3g} batches per second, {:.2g} % of its time; {}",
                       forecast.batches_per_s, 100.0 * forecast.leader_share,
                       forecast.leader_share < 1.0
                           ? fmt::format("it would limit the speed from {} ranks on", most)
                           : fmt::format("it limits the speed from {} ranks on; split the run "
                                         "with --part, each part has its own rank 0",
                                         most));
}

void print_ranks(const RankForecast& forecast, int threads, int ranks) {
    print_heading(fmt::format("forecast for {} MPI ranks", ranks));
    print_entry("threads", fmt::format("{} per rank, as here; {:.0f} have a batch of {} gearboxes "
                                       "to compute",
                                       threads, forecast.busy_threads, kBatchRows));
    print_entry("gearboxes", seconds_text(forecast.gearboxes_s));
    print_entry("estimated time", seconds_text(forecast.total_s));
    print_entry("estimated memory",
                fmt::format("{:.0f} MB per rank, {:.0f} MB for rank 0", forecast.rank_bytes / 1e6,
                            forecast.leader_bytes / 1e6));
    print_entry("estimated disk",
                fmt::format("checkpoint {:.3g} MB, results {:.3g} MB (twice that while the file "
                            "is rewritten)",
                            forecast.checkpoint_bytes / 1e6, forecast.results_bytes / 1e6));
    print_entry("rank 0", leader_text(forecast));
}

}  // namespace

void print_step_forecast(const TilePlan& tile, const EnsemblePlan& ensemble,
                         const PeakMemory& memory) {
    const BatchPlan plan = ensemble.batches();
    const auto threads =
        std::min(static_cast<std::size_t>(std::max(1, thread_count(ensemble))), plan.batches());
    print_heading("forecast of a run");
    print_entry(
        "based on",
        fmt::format("the number of gearboxes and time steps and the time of one mesh period alone; "
                    "{}signals, features and analysis take more. Raise --seconds to compute some "
                    "gearboxes instead",
                    tile.gearbox->stages.empty() ? "" : "neighbouring stages, "));
    print_entry("threads", std::to_string(threads));
    if (tile.solve->settings.quasi_static) {
        print_entry("gearboxes", "not forecast: a quasi-static study integrates nothing");
    } else {
        const auto lanes = static_cast<double>(ensemble.lanes);
        const double tiles = std::ceil(static_cast<double>(plan.threshold_gearboxes()) / lanes) +
                             std::ceil(static_cast<double>(plan.test_rows()) / lanes);
        const double meshes = tile.solve->integrated_meshes;
        print_entry(
            "time integration",
            fmt::format(
                "{}: {:.0f} tiles of {} gearboxes, about {:.0f} mesh periods of {} steps each",
                seconds_text(tiles * meshes *
                             mesh_period_s(tile.draw(), *tile.gearbox, *tile.solve, tile.record) /
                             static_cast<double>(threads)),
                tiles, ensemble.lanes, meshes, tile.solve->integration().grid.steps.size()));
    }
    const double least_bytes =
        std::max(memory.setup_bytes + least_memory_bytes(motion_bytes(tile), ensemble.shape, plan,
                                                         static_cast<int>(threads)),
                 memory.computed_bytes);
    print_entry("memory", fmt::format("at least {:.0f} MB", least_bytes / 1e6));
}

void print_forecast(const Scene& scene, const Planner& planner, double setup_s, int ranks) {
    if (ranks == 0 && scene.lives().problems.empty()) {
        try {
            return print_lives_forecast(scene.tile(), scene.life(), setup_s);
        } catch (const SceneError&) {  // the records of some gearbox are too short
        }
    }
    const EnsemblePlan& ensemble = scene.ensemble();
    const BatchPlan plan = ensemble.batches();
    const int threads = thread_count(ensemble);
    const RunCost calibration = measure_run_cost(scene.tile(), ensemble, plan, threads, kBudget_s);
    const AnalysisTrial trial =
        measure_analysis(scene.sampler(), ensemble, calibration, plan, threads, kBudget_s);
    const RunForecast forecast =
        forecast_run(calibration, plan, trial, verification_s(planner, calibration), setup_s);
    if (!ensemble.meshes.empty()) {
        print_heading("contact");
    }
    if (const std::string loss = contact_loss_text(
            summarise_contact_loss(results_frame(ensemble), CalibrationRows(calibration)));
        !loss.empty()) {
        print_entry("out of contact",
                    fmt::format("{} of the time of a tooth pair: mean (5 to 95 % range of {} "
                                "gearboxes)",
                                loss, calibration.rows.count()));
    }
    if (!ensemble.meshes.empty() && !scene.solve().settings.quasi_static) {
        constexpr double kMost_s = 1.0;
        const auto error = find_step_error(
            planner,
            kMost_s / mesh_period_s(scene.draw(), scene.gearbox(), scene.solve(), scene.record()));
        print_entry("time step error",
                    error ? step_error_text(*error)
                          : "not measured, because it would take too long; contact loss lowers "
                            "the order of the method");
    }
    print_heading("forecast of a run");
    print_entry("based on", measured_text(calibration, trial, ensemble.shape.levels));
    print_entry("threads", fmt::format("{}, {}", calibration.threads,
                                       machine::name(machine::active_instruction_set())));
    print_entry("set-up", seconds_text(forecast.setup_s));
    print_entry("gearboxes", fmt::format("{}: {}", seconds_text(forecast.gearboxes_s),
                                         shares_text(forecast.work,
                                                     forecast.gearboxes_s * calibration.threads)));
    print_entry("detection and results", seconds_text(forecast.detection_s));
    print_entry("estimated time", seconds_text(forecast.total_s()));
    print_entry("estimated memory", fmt::format("{:.0f} MB", forecast.memory_bytes / 1e6));
    if (ranks > 0) {
        print_ranks(forecast_ranks(calibration, plan, ensemble.shape, trial, forecast, ranks),
                    calibration.threads, ranks);
    }
}

}  // namespace gearpod::mc
