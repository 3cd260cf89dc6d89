#include "mc/report/description/describe_lives.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "machine/instruction_sets.hpp"
#include "mc/ensemble/gearbox/solution_choice.hpp"
#include "mc/ensemble/ranks.hpp"
#include "mc/lives/campaign.hpp"
#include "mc/lives/interpolation.hpp"
#include "mc/lives/life_tile.hpp"
#include "mc/numerics/forecast/memory.hpp"
#include "mc/plan/scene_error.hpp"
#include "mc/report/description/terminal_text.hpp"

namespace gearpod::mc {
namespace {

// Describes how records at other torques or speeds are computed.
std::string load_text(const RecordDistribution& law, const LoadNumber& number, double tolerance) {
    const char* const unit = law.given() ? "the study's value" : "the gearbox's value";
    if (const std::vector<double> distinct = law.distinct_factors(); distinct.size() > 1) {
        return fmt::format(
            "{}; {} values occur, equally often, and each is integrated: {:.4g} "
            "times {}",
            law.text(), distinct.size(), fmt::join(distinct, ", "), unit);
    }
    const LoadAxis axis(law, number);
    return law.text() +
           (axis.factors().size() > 1
                ? fmt::format(
                      "; records between are interpolated from solutions at {:.3g} times {}{}",
                      fmt::join(axis.factors(), ", "), unit,
                      number.given ? ""
                                   : fmt::format(", or at more if the error is above {:g} "
                                                 "(life.interpolation_tolerance)",
                                                 tolerance))
                : "");
}

}  // namespace

void print_life(const StudyLives& lives) {
    if (!lives.requested) {
        return;
    }
    print_heading("lives");
    if (!lives.problems.empty()) {
        const SceneError& problem = lives.problems.front();
        print_entry("no lives",
                    fmt::format("{}: {}; {}", problem.key(), problem.what(), problem.remedy()));
        return;
    }
    const LifePlan& plan = *lives.plan;
    const RecordDistributions& laws = plan.distributions;
    print_entry("record", plan.record);
    print_entry("random per gearbox",
                plan.gearbox_inputs.empty()
                    ? "nothing: all gearboxes are identical"
                    : fmt::format("{}", fmt::join(plan.gearbox_inputs, ", ")));
    print_entry("torque per record",
                load_text(laws.torque, plan.torques, plan.interpolation_tolerance));
    print_entry("speed per record",
                load_text(laws.speed, plan.speeds, plan.interpolation_tolerance));
    print_entry("gain per record", laws.gain.text());
    print_entry("noise per record", laws.noise.text());
    std::string growth = std::holds_alternative<ParisStart>(plan.growth)
                             ? "Paris law, with the torque and speed of the records"
                             : "along the given curve";
    for (const std::string& key : plan.ignored_inputs) {
        growth += "; " + key + " in [random] is ignored";
    }
    print_entry("crack growth", growth);
    const CampaignPlan& campaign = plan.campaign;
    print_entry("crack depths integrated",
                fmt::format("0 and {} depths up to {:g} mm, with interpolation in between",
                            campaign.depth_steps, 1e3 * campaign.last_m));
    print_entry("gearboxes",
                fmt::format("{} with a crack, {} healthy for the thresholds, {} "
                            "healthy to count false alarms",
                            campaign.ensemble.test_gearboxes, campaign.ensemble.threshold_gearboxes,
                            campaign.counting_lives));
}

namespace {

// Memory of a tile with so many lanes and loads, in bytes. For each load it holds the signals kept
// by the integration, and those without a crack and at the depths below and above. If only the
// perturbation due to the fault is integrated, the transmission errors of all meshes are added. A
// depth being integrated and tested adds two more. One gearbox also holds the folded products of
// its records.
double tile_bytes(const SolvePlan& solve, const RecordPlan& record, double lanes, double loads) {
    const double samples = static_cast<double>(record.span.meshes()) * record.samples;
    const double signals = (solve.perturbation_only ? 5.0 : 4.0) * loads + 2.0;
    const double basis = 3.0 * loads + 1.0;
    const double bins = static_cast<double>(record.span.planet_teeth) * record.samples;
    return 8.0 * (signals * lanes * samples + 0.5 * basis * (basis + 1.0) * bins) +
           solve.record_bytes;
}

double file_bytes(const CampaignPlan& campaign) {
    return 8.0 * static_cast<double>(lives_plan(campaign).rows()) *
           static_cast<double>(row_shape(lives_frame(campaign)).values() + 1);
}

std::string time_text(double seconds) {
    return seconds < 9.95 ? fmt::format("{:.2g} s", seconds) : fmt::format("{:.0f} s", seconds);
}

std::string bytes_text(double bytes) {
    return bytes < 1e8 ? fmt::format("{:.2g} MB", bytes / 1e6)
                       : fmt::format("{:.0f} MB", bytes / 1e6);
}

// Numbers of torques and speeds with the most loads that may be chosen.
LifePlan with_most_loads(LifePlan plan) {
    if (plan.distributions.speed.varies() && !plan.speeds.given) {
        plan.speeds.nodes = kMostNodes;
    } else if (plan.distributions.torque.varies() && !plan.torques.given) {
        plan.torques.nodes = kMostNodes;
    }
    return plan;
}

}  // namespace

LivesForecast forecast_lives(const LifeTiles& tiles, int threads, double setup_s, int pilot_loads) {
    const SolvePlan& solve = *tiles.tile().solve;
    const RecordPlan& record = tiles.tile().record;
    const CampaignPlan& campaign = tiles.plan().campaign;
    const BatchPlan plan = lives_plan(campaign);
    const auto lanes = static_cast<double>(tiles.lanes()),
               loads = static_cast<double>(tiles.load_count());
    LivesForecast all;
    all.threads = std::max(1, std::min(threads, static_cast<int>(plan.batches())));
    all.setup_s = setup_s;
    // Mesh periods of a tile without a fault, and the additional ones of each crack depth.
    const double healthy_meshes = solve.integrated_meshes,
                 depth_meshes = solve.perturbation_only ? solve.passage_meshes : healthy_meshes;
    const double mesh_s = mesh_period_s(tiles.tile().draw(), *tiles.tile().gearbox, solve, record);
    const auto tile_s = [&](bool cracked, bool tested) {
        double meshes = loads * healthy_meshes;
        if (cracked) {
            meshes += loads * campaign.depth_steps * depth_meshes;
        }
        if (tested) {
            meshes += 2.0 * depth_meshes + static_cast<double>(tiles.gap_count()) * healthy_meshes;
        }
        return meshes * mesh_s;
    };
    // Mean number of records until the end of life, over the first gearboxes with a crack.
    constexpr std::uint64_t kMostLives = 64;
    const auto lives = std::clamp<std::uint64_t>(
        static_cast<std::uint64_t>(campaign.ensemble.test_gearboxes), 1, kMostLives);
    double cracked_records = 0.0;
    for (std::uint64_t i = 0; i < lives; ++i) {
        cracked_records += static_cast<double>(tiles.history({Group::test, i}).records.size());
    }
    cracked_records /= static_cast<double>(lives);
    const RecordTimes trial = tiles.time_records();
    std::vector<double> busy_s(static_cast<std::size_t>(all.threads), 0.0);
    double integrating_s = 0.0, records_s = 0.0, record_count = 0.0;
    for (std::size_t b = 0; b < plan.batches(); ++b) {
        const Batch batch = plan.batch(b);
        const bool cracked = batch.group == Group::test;
        const double records = cracked ? cracked_records : campaign.records;
        double batch_s = 0.0;
        for (std::size_t first = 0; first < batch.gearboxes; first += tiles.lanes()) {
            const bool tested = measures_interpolation({batch.group, batch.first_index + first});
            batch_s += tile_s(cracked, tested);
        }
        integrating_s += batch_s;
        const double tile_records_s =
            static_cast<double>(batch.gearboxes) *
            (records * trial.record_s + (cracked ? campaign.depth_steps : 1) * trial.step_s);
        record_count += static_cast<double>(batch.gearboxes) * records;
        records_s += tile_records_s;
        *std::ranges::min_element(busy_s) += batch_s + tile_records_s;
    }
    const double pilot_tiles = std::ceil(static_cast<double>(kInterpolationPilots) / lanes);
    all.pilots_s = pilot_loads == 0
                       ? 0.0
                       : mesh_s * pilot_tiles * (pilot_loads * healthy_meshes + depth_meshes);
    all.processor_s = all.pilots_s + integrating_s + records_s;
    all.gearboxes = static_cast<long>(plan.rows());
    all.records = std::lround(record_count);
    all.gearbox_s = integrating_s / static_cast<double>(std::max<std::size_t>(1, plan.rows()));
    all.record_s = records_s / std::max(1.0, record_count);
    all.integration_s = std::ranges::max(busy_s);
    all.file_bytes = file_bytes(campaign);
    all.memory_bytes = peak_memory_bytes() + all.threads * tile_bytes(solve, record, lanes, loads) +
                       all.file_bytes;
    return all;
}

void print_lives_forecast(const TilePlan& tile, const LifePlan& plan, double setup_s) {
    constexpr double kMostPilots_s = 5.0;
    // Torques and speeds that pilots examine.
    const auto interpolated = [](const RecordDistribution& quantity) {
        return quantity.varies() && quantity.distinct_factors().empty() ? 1 : 0;
    };
    const int axes =
        interpolated(plan.distributions.torque) + interpolated(plan.distributions.speed);
    const int threads = thread_count(plan.campaign.ensemble);
    // One load and five more for each quantity that varies are integrated at least.
    const int least_loads = axes == 0 ? 0 : 1 + 5 * axes;
    LivesForecast all = forecast_lives(LifeTiles(tile, plan), threads, setup_s, least_loads);
    std::string loads, most;
    if (axes > 0 && all.pilots_s <= kMostPilots_s) {
        const InterpolationChoice choice = choose_interpolation(tile, plan);
        const LifeTiles tiles(tile, choice.plan);
        all = forecast_lives(tiles, threads, setup_s, choice.loads);
        loads = fmt::format("{}; pilots are off by {:.2g} of what a crack of {:g} mm changes",
                            tiles.load_count(), choice.error, 1e3 * plan.campaign.smallest_m);
    } else if (const LifePlan most_loads = with_most_loads(plan);
               axes > 0 && most_loads.torques == plan.torques && most_loads.speeds == plan.speeds) {
        loads = fmt::format("{}; pilots measure the error when the run starts",
                            LifeTiles(tile, plan).load_count());
    } else if (axes > 0) {
        const LifeTiles tiles(tile, most_loads);
        const LivesForecast upper =
            forecast_lives(tiles, threads, setup_s, static_cast<int>(kMostLoads));
        loads = fmt::format("at least {}, at most {}: chosen when the run starts",
                            LifeTiles(tile, plan).load_count(), tiles.load_count());
        most = ", at most " + time_text(upper.total_s());
    }
    print_heading("forecast of lives");
    print_entry("based on",
                "the time of one mesh period, the number of mesh periods that the damping "
                "requires, and records of artificial signals");
    print_entry("threads", fmt::format("{}, {}", all.threads,
                                       machine::name(machine::active_instruction_set())));
    print_entry("set-up", time_text(all.setup_s));
    if (!loads.empty()) {
        print_entry("integrated loads", loads);
        print_entry("pilots", time_text(all.pilots_s) + " on one thread");
    }
    print_entry("gearboxes", fmt::format("{}, time integration {:.2g} s of processor time each",
                                         all.gearboxes, all.gearbox_s));
    print_entry("records", fmt::format("{}, superposition {:.2g} ms of processor time each",
                                       all.records, 1e3 * all.record_s));
    print_entry("processor time", time_text(all.processor_s));
    print_entry("estimated time", time_text(all.total_s()) + most);
    print_entry("estimated memory", bytes_text(all.memory_bytes));
    print_entry("results file",
                bytes_text(all.file_bytes) + "; the checkpoint is as large until the run ends");
}

}  // namespace gearpod::mc
