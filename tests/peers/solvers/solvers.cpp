// The same gearbox by gearpod and by other solvers: time and error side by side (README.md).
//
//     peer_solvers [STUDY] [--rounds N] [--error E] [--csv FILE] [--steps-only]
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <fstream>
#include <functional>
#include <memory>
#include <optional>

#include "comparison.hpp"
#include "lockstep/mesh_march.hpp"
#include "lockstep/rigid_rotation.hpp"
#include "mc/gearbox_tile.hpp"
#include "mc/numerics_choice.hpp"
#include "mc/thread_clock.hpp"

namespace gearpod::peers {
namespace {

struct Options {
    std::string study = GEARPOD_SOURCE_DIR "/studies/liang-fig-5-8.toml";
    std::string csv;
    int rounds = 5;
    double error = 1e-3;  // of the worst feature
    bool steps_only = false;
};

std::unique_ptr<mc::Scene> scene_of(const Options& options,
                                    const std::vector<std::string>& overrides) {
    const mc::StudyReading reading = mc::read_study(options.study, overrides);
    if (!reading.study) {
        throw std::runtime_error(mc::format(reading.problems));
    }
    return std::make_unique<mc::Scene>(*reading.study);
}

double median(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    return values[values.size() / 2];
}

// A way to march. `times`: seconds a gearbox, over the span or a step, by round.
struct Row {
    std::string name;
    std::vector<double> times;
    double meshes = 0.0;  // that those times are of; 0: a step
    std::optional<mc::PilotError> error;
    double tolerance = 0.0, steps = 0.0;
};

std::string ratio_text(const Row& row, const Row& to, double scale = 1.0) {
    std::vector<double> all;
    for (std::size_t i = 0; i < row.times.size(); ++i) {
        all.push_back(scale * row.times[i] / to.times[i]);
    }
    std::sort(all.begin(), all.end());
    return fmt::format("{:>9.3g} ({:.3g}..{:.3g})", median(all), all.front(), all.back());
}

// The study's gearboxes on gearpod's own march and all that peers need of them.
class Bench {
  public:
    explicit Bench(const Options& options)
        : options_(options),
          scene_(scene_of(options, {"numerics.integrator=rk4"})),
          fine_(scene_of(options, {"numerics.integrator=rk4",
                                   fmt::format("numerics.steps_per_mesh={}",
                                               2 * scene_->plan().grid.steps.size())})),
          boxes_(boxes_of(*scene_)),
          tables_(*scene_, scene_->plan(), boxes_),
          fine_tables_(*fine_, fine_->plan(), boxes_),
          task_{*scene_, boxes_, tables_, fine_tables_, {}, 0.0, {}} {
        task_.mesh_period_s = dynamics::mesh_period_s(boxes_.inputs[0]);
        start();
    }

    const Task& task() const { return task_; }
    const mc::Scene& scene() const { return *scene_; }

    // Processor seconds that a mesh period of the tile takes, in doubles by the scene's rk4.
    double tile_mesh_s() {
        lockstep::MeshRecord record = lockstep::make_record(scene_->plan(), kGearboxes, false);
        const double began = mc::thread_processor_s();
        (*march_)({}, state_, record);
        const double seconds = mc::thread_processor_s() - began;
        rotation_->remove(state_);
        return seconds;
    }

  private:
    // From rest to the orbit; the states' sizes on the way.
    void start() {
        march_ = lockstep::make_mesh_march<kGearboxes>(scene_->plan(), boxes_.inputs);
        rotation_ = std::make_unique<lockstep::RigidRotation>(scene_->plan().layout, boxes_.inputs);
        state_ = lockstep::rest_state(scene_->plan(), boxes_.inputs);
        for (int k = 0; k < 5; ++k) {
            tile_mesh_s();
        }
        task_.start = state_;
        double size[6] = {};
        for (int i = 0; i < kSensing; ++i) {
            size[kind(i)] = std::max(size[kind(i)], std::abs(start_value(i)));
        }
        for (int i = 0; i < kSensing; ++i) {
            task_.scale[i] = size[kind(i)];
        }
    }
    // Positions, velocities, and x, x', y, y' of the filter.
    static int kind(int i) { return i < kMotions ? 0 : i < kMoving ? 1 : 2 + (i - kMoving) % 4; }
    double start_value(int i) const {
        double y[kSensing];
        copy_start(task_, 0, y);
        return y[i];
    }

    const Options& options_;
    std::unique_ptr<mc::Scene> scene_, fine_;
    Boxes boxes_;
    StiffnessTables tables_, fine_tables_;
    Task task_;
    std::unique_ptr<const lockstep::MeshMarch<kGearboxes>> march_;
    std::unique_ptr<const lockstep::RigidRotation> rotation_;
    lockstep::TileState state_;
};

// Steps alone, on the same grid, in doubles.
class StepTable {
  public:
    StepTable(Bench& bench, const mc::Reference& reference) : bench_(bench), reference_(reference) {
        rows_.push_back({"gearpod, 8 in lockstep", {}, 0.0, {}});
        for (const bool motion_only : {false, true}) {
            const std::string what = motion_only ? ", motion without sensor" : "";
            add("odeint rk4, one gearbox" + what, [=](const Task& task, const Extent& extent) {
                return odeint_scalar_rk4(task, extent, 6, 7, motion_only);
            });
            add("odeint rk4, 8-wide value type" + what,
                [=](const Task& task, const Extent& extent) {
                    PeerRun run = odeint_wide_rk4(task, extent, motion_only);
                    run.march_s /= kGearboxes;
                    return run;
                });
        }
    }

    void measure_errors() {
        const Extent pattern{2, bench_.task().steps.meshes()};
        for (std::size_t i = 0; i < ways_.size(); ++i) {
            const PeerRun run = ways_[i](bench_.task(), pattern);
            rows_[i + 1].error = error_of(bench_.scene(), run.records, 6, 7, reference_.record);
        }
    }

    void round() {
        const double steps = static_cast<double>(bench_.task().steps.grid().steps.size());
        std::vector<std::vector<double>> all(rows_.size());
        for (int repeat = 0; repeat < 5; ++repeat) {
            all[0].push_back(bench_.tile_mesh_s() / steps / kGearboxes);
            for (std::size_t i = 0; i < ways_.size(); ++i) {
                all[i + 1].push_back(ways_[i](bench_.task(), {1, 0}).march_s / steps);
            }
        }
        for (std::size_t i = 0; i < rows_.size(); ++i) {
            rows_[i].times.push_back(median(all[i]));
        }
    }

    void print() const {
        fmt::print(
            "\na step of a gearbox, classical Runge-Kutta, {} steps a mesh period, doubles\n"
            "{:<54} {:>8} {:>24} {:>14}\n",
            bench_.task().steps.grid().steps.size(), "", "ns", "over gearpod", "worst feature");
        for (const Row& row : rows_) {
            fmt::print("{:<54} {:>8.1f} {:>24} {:>14}\n", row.name, 1e9 * median(row.times),
                       ratio_text(row, rows_[0]),
                       row.error ? fmt::format("{:.1e}", row.error->largest_feature()) : "");
        }
    }

  private:
    using Way = std::function<PeerRun(const Task&, const Extent&)>;
    void add(const std::string& name, Way way) {
        rows_.push_back({name, {}, 0.0, {}});
        ways_.push_back(std::move(way));
    }

    Bench& bench_;
    const mc::Reference& reference_;
    std::vector<Row> rows_;
    std::vector<Way> ways_;  // of the rows but the first
};

// What a gearbox costs over the whole span, each way at the loosest tolerance that keeps the error.
class SpanTable {
  public:
    SpanTable(const Options& options, Bench& bench, const mc::Pilot& pilot,
              const mc::Reference& reference)
        : options_(options), bench_(bench), pilot_(pilot), reference_(reference) {
        chosen_ = scene_of(options, {fmt::format("numerics.tolerance={}", options.error)});
        span_ = kRunIn + bench.scene().span_meshes();
        const mc::PilotRecord record = pilot.run(*chosen_);
        rows_.push_back({"gearpod, " + chosen_->numerics_choice()->rung.text(),
                         {},
                         record.meshes_per_tile(),
                         mc::pilot_error(record, reference.record),
                         0.0,
                         static_cast<double>(record.steps)});
        rows_.push_back({"gearpod, rk4 in doubles, every mesh marched",
                         {},
                         span_,
                         {},
                         0.0,
                         static_cast<double>(bench.task().steps.grid().steps.size())});
    }

    void add_all() {
        add("odeint rk4, one by one", [](const Task& task, const Extent& extent, double) {
            return odeint_scalar_rk4(task, extent, kBox, kBox + 1, false);
        });
        add("odeint rk4, 8-wide value type", [](const Task& task, const Extent& extent, double) {
            PeerRun run = odeint_wide_rk4(task, extent, false);
            run.march_s /= kGearboxes;
            return run;
        });
        for (const bool stops : {false, true}) {
            const std::string how = stops ? ", restarted at transitions" : "";
            add("odeint dopri5" + how, [=](const Task& task, const Extent& extent, double e) {
                return odeint_dopri5(task, extent, kBox, kBox + 1, e, stops);
            });
            for (const Multistep method : {Multistep::bdf, Multistep::adams}) {
                add((method == Multistep::bdf ? "CVODE BDF" : "CVODE Adams") + how,
                    [=](const Task& task, const Extent& extent, double e) {
                        return cvode(task, extent, kBox, kBox + 1, method, e, stops);
                    });
            }
        }
    }

    void round() {
        rows_[0].times.push_back(pilot_.run(*chosen_).march_s);
        rows_[1].times.push_back(bench_.tile_mesh_s() / kGearboxes * span_);
        for (std::size_t i = 0; i < ways_.size(); ++i) {
            const PeerRun run = ways_[i](bench_.task(), {1, 1}, rows_[i + 2].tolerance);
            rows_[i + 2].times.push_back(run.march_s / 2.0 * span_);
        }
    }

    void print() const {
        fmt::print(
            "\na gearbox over {} + {} mesh periods with the worst feature within {:g}, one thread\n"
            "(others: from {} measured mesh periods; errors over the fault's pattern, {} of them)\n"
            "{:<44} {:>9} {:>10} {:>10} {:>24} {:>24} {:>9} {:>9} {:>9}\n",
            kRunIn, bench_.scene().span_meshes(), options_.error, 2 * options_.rounds,
            kRunIn + bench_.task().steps.meshes(), "", "tolerance", "steps/mesh", "s",
            "over gearpod", "a mesh over gearpod's", "feature", "sensor", "TE");
        const Row& own = rows_[0];
        for (const Row& row : rows_) {
            fmt::print("{:<44} {:>9} {:>10.0f} {:>10.3g} {:>24} {:>24} {:>9} {:>9} {:>9}\n",
                       row.name, row.tolerance > 0.0 ? fmt::format("{:.0e}", row.tolerance) : "",
                       row.steps, median(row.times), ratio_text(row, own),
                       ratio_text(row, own, own.meshes / row.meshes),
                       row.error ? fmt::format("{:.1e}", row.error->largest_feature()) : "",
                       row.error ? fmt::format("{:.1e}", row.error->sensor) : "",
                       row.error ? fmt::format("{:.1e}", row.error->te) : "");
        }
    }

    // As `gearpod accuracy --peers` reads it.
    void write(const std::string& path) const {
        std::ofstream file(path);
        file << "name,command,march_s,mesh_s,sensor,te";
        for (const std::string& feature : bench_.scene().study().features.use) {
            file << ',' << feature;
        }
        file << '\n';
        const int levels = static_cast<int>(bench_.scene().study().sensor.noise_levels.size());
        for (std::size_t i = 2; i < rows_.size(); ++i) {
            const Row& row = rows_[i];
            const double march_s = median(row.times);
            file << fmt::format("\"{}\",peer_solvers,{:.6g},{:.6g},{:.6g},{:.6g}", row.name,
                                march_s, march_s / row.meshes, row.error->sensor, row.error->te);
            for (std::size_t f = 0; f < bench_.scene().study().features.use.size(); ++f) {
                file << fmt::format(",{:.6g}", row.error->feature(static_cast<int>(f), levels));
            }
            file << '\n';
        }
        if (!file.flush()) {
            throw std::runtime_error(path + ": cannot be written");
        }
    }

  private:
    using Way = std::function<PeerRun(const Task&, const Extent&, double)>;
    static constexpr int kBox = 6;  // the largest crack
    static constexpr int kRunIn = 2;

    // Tighter by half a decade until the error is small enough.
    void add(const std::string& name, Way way) {
        const Extent pattern{kRunIn, bench_.task().steps.meshes()};
        for (double exponent = 1.0; exponent < 10.0; exponent += 0.5) {
            const double tolerance = std::pow(10.0, -exponent);
            const PeerRun run = way(bench_.task(), pattern, tolerance);
            const mc::PilotError error =
                error_of(bench_.scene(), run.records, kBox, kBox + 1, reference_.record);
            const bool fixed =
                run.steps == static_cast<double>(bench_.task().steps.grid().steps.size());
            fmt::print(stderr, "{}: {:.1e}: worst feature {:.1e}\n", name, tolerance,
                       error.largest_feature());
            if (!run.failed && (fixed || error.largest_feature() <= options_.error)) {
                rows_.push_back({name, {}, span_, error, fixed ? 0.0 : tolerance, run.steps});
                ways_.push_back(std::move(way));
                return;
            }
        }
        fmt::print(stderr, "{}: no tolerance keeps the error\n", name);
    }

    const Options& options_;
    Bench& bench_;
    const mc::Pilot& pilot_;
    const mc::Reference& reference_;
    std::unique_ptr<mc::Scene> chosen_;
    double span_ = 0.0;
    std::vector<Row> rows_;
    std::vector<Way> ways_;  // of the rows but the first two
};

void compare(const Options& options) {
    Bench bench(options);
    const mc::Pilot pilot(bench.scene());
    fmt::print(stderr, "reference: two methods until they agree\n");
    const mc::Reference reference = mc::converged_reference(bench.scene().study(), pilot, {});
    StepTable steps(bench, reference);
    steps.measure_errors();
    SpanTable span(options, bench, pilot, reference);
    if (!options.steps_only) {
        span.add_all();
    }
    for (int round = 0; round < options.rounds; ++round) {
        fmt::print(stderr, "round {} of {}\n", round + 1, options.rounds);
        steps.round();
        if (!options.steps_only) {
            span.round();
        }
    }
    steps.print();
    if (!options.steps_only) {
        span.print();
    }
    if (!options.csv.empty()) {
        span.write(options.csv);
    }
}

}  // namespace
}  // namespace gearpod::peers

int main(int argc, char** argv) {
    gearpod::peers::Options options;
    CLI::App app("The same gearbox by gearpod and by other solvers: time and error side by side");
    app.add_option("study", options.study, "a planetary study with four planets and no scatter");
    app.add_option("--rounds", options.rounds, "interleaved rounds of timing");
    app.add_option("--error", options.error, "of the worst feature, relative");
    app.add_option("--csv", options.csv, "table for `gearpod accuracy --peers`");
    app.add_flag("--steps-only", options.steps_only, "only the steps of Runge-Kutta's method");
    CLI11_PARSE(app, argc, argv);
    try {
        gearpod::peers::compare(options);
    } catch (const std::exception& error) {
        fmt::print(stderr, "{}\n", error.what());
        return 2;
    }
    return 0;
}
