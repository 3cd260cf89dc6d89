#include "mc/numerics/numerical_error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>

#include "analysis/detection/detection.hpp"
#include "lockstep/kernels/kernel_table.hpp"
#include "machine/no_value.hpp"
#include "mc/ensemble/batch_workers.hpp"
#include "mc/ensemble/gearbox/gearbox_tile.hpp"
#include "mc/ensemble/gearbox/solution_choice.hpp"
#include "mc/numerics/pilot.hpp"
#include "mc/numerics/solver_setting.hpp"

namespace gearpod::mc {

double standard_deviation(const std::vector<double>& values) {
    const double middle =
        std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
    double squares = 0.0;
    for (const double value : values) {
        squares += (value - middle) * (value - middle);
    }
    return values.size() > 1 ? std::sqrt(squares / static_cast<double>(values.size() - 1)) : kNan;
}

namespace {

constexpr int kFiner = 4;
constexpr double kConverged = 1e-10;

// The setting with the number of its steps, if its integrator's own rule gives them.
SolverSetting with_steps(SolverSetting setting, const Planner& planner) {
    if (setting.numerics.steps_per_mesh == 0) {
        setting.numerics.steps_per_mesh = planner.steps(setting.numerics).steps;
    }
    return setting;
}

constexpr int kVerified = 8;  // gearboxes, unless the study has numerics.paired_gearboxes

// Rows of the gearboxes `ids` among those with which `each_row` calls its argument; empty if one is
// missing. `width`: values in a row.
template <class EachRow>
std::optional<BatchRows> rows_among(const std::vector<GearboxId>& ids, std::size_t width,
                                    const EachRow& each_row) {
    BatchRows rows{std::vector<int>(ids.size()), std::vector<double>(ids.size() * width)};
    std::size_t found = 0;
    each_row([&](const GearboxId& id, int status, const double* values) {
        for (std::size_t i = 0; i < ids.size(); ++i) {
            if (id.group == ids[i].group && id.index == ids[i].index && id.repeat == 0) {
                rows.status[i] = status;
                std::copy_n(values, width, &rows.values[i * width]);
                ++found;
            }
        }
    });
    return found == ids.size() ? std::optional(rows) : std::nullopt;
}

// Adds the differences of the first `test_count` gearboxes in one of their `count` values. Infinite
// if a gearbox has it with fine steps only.
void add_differences(const std::vector<double>& coarse, const std::vector<double>& fine,
                     std::size_t test_count, std::size_t value, std::size_t count,
                     NumericalError& error) {
    double squares = 0.0, largest = 0.0;
    std::size_t compared = 0;
    for (std::size_t g = 0; g < test_count; ++g) {
        const double here = coarse[g * count + value], there = fine[g * count + value];
        if (std::isfinite(there)) {
            const double difference = std::isfinite(here) ? std::abs(here - there) : INFINITY;
            squares += difference * difference;
            largest = std::max(largest, difference);
            ++compared;
        }
    }
    error.rms.push_back(
        std::sqrt(squares / static_cast<double>(std::max<std::size_t>(1, compared))));
    error.largest.push_back(largest);
}

// Counts of one feature at one noise level over the rows of the results.
struct Counts {
    std::vector<double> healthy;
    std::vector<long> near, tested;  // by size
};

std::vector<Counts> count_near(const Results& frame, const RowSource& rows) {
    const RowShape shape = row_shape(frame);
    const auto& groups = frame.request.groups;
    std::vector<Counts> all(shape.features * shape.levels);
    for (Counts& counts : all) {
        counts.near.assign(groups.size(), 0);
        counts.tested.assign(groups.size(), 0);
    }
    const std::size_t size_index = frame.parameter_index(frame.request.size.name).value_or(0);
    for_each_row(rows, [&](const ResultRow& row) {
        const bool test = row.group == static_cast<int>(Group::test);
        const auto group = analysis::group_of(row.values[size_index], groups);
        for (std::size_t i = 0; i < all.size(); ++i) {
            const double value = row.values[shape.parameters + i];
            if (!std::isfinite(value)) {
                continue;
            }
            if (!test) {
                all[i].healthy.push_back(value);
            } else if (group) {
                const double threshold =
                    frame.detection[i / shape.levels].levels[i % shape.levels].threshold;
                const double error = 2.0 * frame.numerical->largest[i];
                ++all[i].tested[*group];
                all[i].near[*group] += std::abs(value - threshold) <= error ? 1 : 0;
            }
        }
    });
    return all;
}

void set_rate_contribution(const analysis::LevelDetection& level, const Counts& counts,
                           NumericalContribution& contribution) {
    contribution.pd = contribution.pd_half_width = kNan;
    if (!std::isfinite(level.threshold)) {
        return;
    }
    contribution.pd = contribution.pd_half_width = 0.0;
    for (std::size_t c = 0; c < level.cells.size(); ++c) {
        if (counts.tested[c] == 0) {
            continue;
        }
        contribution.pd = std::max(contribution.pd, static_cast<double>(counts.near[c]) /
                                                        static_cast<double>(counts.tested[c]));
        contribution.pd_half_width = std::max(contribution.pd_half_width,
                                              0.5 * (level.cells[c].upper - level.cells[c].lower));
    }
}

}  // namespace

std::optional<SolverSetting> finer_setting(const Planner& planner, const Numerics& numerics) {
    if (planner.facts().step_cost == nullptr) {
        return std::nullopt;
    }
    if (numerics.mass_scaling_Hz > 0.0) {
        Numerics unscaled = numerics;
        unscaled.mass_scaling_Hz = 0.0;
        unscaled.steps_per_mesh = 0;
        return own_setting(unscaled);
    }
    SolverSetting finer = with_steps(own_setting(numerics), planner);
    Numerics& n = finer.numerics;
    n.convergence_tolerance = std::min(kConverged, n.convergence_tolerance);
    double steps = n.steps_per_mesh;
    if (const auto finest =
            planner.steps(numerics)
                .finest_step) {  // uniform steps, finer than the finest one of the graded grid
        n.grid = StepGrid::uniform;
        finer.options.emplace_back("grid");
        steps = std::ceil(1.0 / *finest);
    }
    for (int factor = kFiner; factor > 1; factor /= 2) {
        n.steps_per_mesh = static_cast<int>(std::min(1e6, factor * steps));
        try {
            steps_of(planner, finer);
            return finer;
        } catch (const SceneError&) {  // more steps than the program allows
            continue;
        }
    }
    return std::nullopt;
}

std::vector<GearboxId> paired_gearboxes(const TilePlan& tile, const EnsemblePlan& ensemble,
                                        int pairs) {
    const std::uint64_t together = tile.record.same_positions;
    const auto wanted = static_cast<std::size_t>(std::max(0, pairs));
    std::vector<std::pair<double, GearboxId>> faulty;
    for (std::int64_t i = 0; pairs > 0 && i < ensemble.test_gearboxes; ++i) {
        const GearboxId id{Group::test, static_cast<std::uint64_t>(i)};
        if (together > 1 && id.index % together == 0 && faulty.size() >= wanted) {
            break;
        }
        const double size = tile.sampler->draw(id).inputs.fault_size;
        if (size > 0.0) {
            faulty.emplace_back(size, id);
        }
    }
    std::ranges::stable_sort(faulty, {}, &std::pair<double, GearboxId>::first);
    std::vector<GearboxId> spread;
    const std::size_t count = std::min(wanted, faulty.size());
    for (std::size_t i = 0; i < count; ++i) {
        spread.push_back(faulty[(2 * i + 1) * faulty.size() / (2 * count)].second);
    }
    if (together > 1) {
        std::ranges::sort(spread, {}, &GearboxId::index);
    }
    for (std::int64_t i = 0; i < std::min<std::int64_t>(pairs, ensemble.threshold_gearboxes); ++i) {
        spread.push_back({Group::threshold, static_cast<std::uint64_t>(i)});
    }
    return spread;
}

AssumptionRows changed_rows(const RowOrder& order, std::span<const GearboxId> ids) {
    AssumptionRows all;
    std::ranges::transform(ids, std::back_inserter(all.rows),
                           [&](const GearboxId& id) { return order.row_of(id); });
    return all;
}

std::vector<double> feature_values(const RowShape& shape, const BatchRows& rows) {
    std::vector<double> values;
    for (std::size_t row = 0; row < rows.count(); ++row) {
        std::ranges::copy(
            std::span(rows.values)
                .subspan(row * shape.values() + shape.parameters, shape.features * shape.levels),
            std::back_inserter(values));
    }
    return values;
}

std::optional<NumericalError> find_numerical_error(const Planner& planner, const RowSource* run,
                                                   const FineRows* fine) {
    const Numerics& numerics = planner.facts().numerics;
    const auto finer = planner.facts().verified ? finer_setting(planner, numerics) : std::nullopt;
    if (!finer) {
        return std::nullopt;
    }
    const TilePlan plan = planner.tile(numerics);
    const EnsemblePlan ensemble = planner.ensemble(numerics);
    const int pairs = numerics.paired_gearboxes;
    std::vector<GearboxId> ids = paired_gearboxes(plan, ensemble, pairs);
    const auto faulty =
        static_cast<std::size_t>(std::ranges::count(ids, Group::test, &GearboxId::group));
    std::size_t test_count = faulty;
    if (faulty == 0) {  // no pairs, or no gearbox with a fault
        // None that the pilot of a tolerance has, if there are enough.
        const bool neighbours = plan.record.same_positions > 1;
        const auto apart = static_cast<std::uint64_t>(
            std::max<std::int64_t>(1, ensemble.test_gearboxes / kVerified));
        const std::uint64_t stride = neighbours ? 1 : apart;
        const std::uint64_t first = !neighbours ? stride / 2 : apart > 1 ? kVerified : 0;
        const std::vector<GearboxId> tested = pilot_gearboxes(first, stride);
        ids.insert(ids.begin(), tested.begin(), tested.end());
        test_count = tested.size();
    }
    const std::size_t width = ensemble.shape.values();
    const RowOrder& order = plan.draw().rows;
    std::optional<BatchRows> coarse_rows, fine_rows;
    if (run != nullptr && order.threshold_noise == NoiseSampling::plain) {
        coarse_rows = rows_among(ids, width, [&](const auto& use) {
            for_each_row(*run, [&](const ResultRow& row) {
                use(order.id_of(static_cast<long>(row.index)), row.status, row.values);
            });
        });
    }
    if (fine != nullptr && fine->numerics == finer->numerics) {
        fine_rows = rows_among(ids, width, [&](const auto& use) {
            for (std::size_t i = 0; i < fine->ids.size(); ++i) {
                use(fine->ids[i], fine->rows.status[i], &fine->rows.values[i * width]);
            }
        });
    }
    if (!coarse_rows) {
        coarse_rows = rows_of_gearboxes(plan, ensemble, ids);
    }
    if (!fine_rows) {
        fine_rows = rows_of_gearboxes(planner.tile(finer->numerics),
                                      planner.ensemble(finer->numerics), ids);
    }
    const std::vector<double> coarse = feature_values(ensemble.shape, *coarse_rows),
                              fine_values = feature_values(ensemble.shape, *fine_rows);
    const std::size_t count = ensemble.shape.features * ensemble.shape.levels;
    NumericalError error{with_steps(own_setting(numerics), planner).text(),
                         with_steps(*finer, planner).text(),
                         static_cast<int>(test_count),
                         {},
                         {}};
    for (std::size_t value = 0; value < count; ++value) {
        add_differences(coarse, fine_values, test_count, value, count, error);
    }
    if (faulty > 0 && order.threshold_noise == NoiseSampling::plain) {
        error.pairs = changed_rows(order, ids);
        error.pairs.changed.push_back({kFineSteps, 1.0, fine_values});
    }
    return error;
}

std::vector<NumericalContribution> numerical_contributions(const Results& frame,
                                                           const RowSource& rows) {
    std::vector<NumericalContribution> contributions;
    if (!frame.numerical) {
        return contributions;
    }
    const std::size_t levels = frame.noise_levels.size();
    const std::vector<Counts> counts = count_near(frame, rows);
    for (std::size_t i = 0; i < counts.size(); ++i) {
        const std::size_t f = i / levels, level = i % levels;
        NumericalContribution contribution;
        contribution.feature = frame.features[f].name;
        contribution.noise_level = frame.noise_levels[level];
        contribution.rms = frame.numerical->rms[i];
        contribution.spread = standard_deviation(counts[i].healthy);
        set_rate_contribution(frame.detection[f].levels[level], counts[i], contribution);
        contribution.numerical_dominates =
            std::isfinite(contribution.pd)
                ? contribution.pd > contribution.pd_half_width
                : std::isfinite(contribution.spread) && !(contribution.rms < contribution.spread);
        contributions.push_back(contribution);
    }
    return contributions;
}

namespace {

constexpr int kMeshes = 16;

// Sums of the squared deviation from a reference, and of the reference and its squares.
struct Squares {
    double deviation = 0.0, sum = 0.0, squares = 0.0, count = 0.0;

    void add(double value, double reference) {
        deviation += (value - reference) * (value - reference);
        sum += reference;
        squares += reference * reference;
        count += 1.0;
    }
    // Relative root mean square error; `about_mean`: relative to the reference without its mean,
    // for signals whose mean has no meaning.
    double relative(bool about_mean) const {
        const double size = squares - (about_mean ? sum * sum / std::max(1.0, count) : 0.0);
        return size > 0.0 ? std::sqrt(deviation / size) : 0.0;
    }
};

// Test records of the pilot's gearboxes with the numerics of a plan.
GearboxTile pilot_tile(const TilePlan& plan) {
    std::vector<Realization> gearboxes;
    for (const GearboxId& id : pilot_gearboxes()) {
        gearboxes.push_back(plan.sampler->draw(id));
    }
    const int lanes = lockstep::lanes_for(plan.solve->integration().precision,
                                          static_cast<int>(gearboxes.size()));
    return run_realizations(plan, std::move(gearboxes), lanes,
                            {.records = lockstep::RecordOptions{}});
}

const lockstep::MeshRecord& record_of(const GearboxTile& tile, int mesh) {
    const std::vector<int>& content = tile.integration.content;
    return tile.integration.records[static_cast<std::size_t>(
        content[static_cast<std::size_t>(mesh) % content.size()])];
}

void add_lane(const machine::AlignedVector& values, std::size_t lanes,
              const machine::AlignedVector& reference, std::size_t reference_lanes, LaneId lane,
              Squares& squares) {
    for (std::size_t row = 0; row < values.size() / lanes; ++row) {
        squares.add(values[row * lanes + lane], reference[row * reference_lanes + lane]);
    }
}

}  // namespace

std::optional<StepError> find_step_error(const Planner& planner, double most_meshes) {
    const TilePlan plan = planner.tile(planner.facts().numerics);
    if (!dynamics::separates(plan.solve->integration().mesh_law)) {
        return std::nullopt;
    }
    const auto finer = finer_setting(planner, planner.facts().numerics);
    if (!finer) {
        return std::nullopt;
    }
    Numerics in_double_precision = finer->numerics;
    in_double_precision.precision = Precision::double_precision;
    const TilePlan coarse = plan.recording_at_most(kMeshes),
                   fine = planner.tile(in_double_precision).recording_at_most(kMeshes);
    const std::size_t steps = coarse.solve->integration().grid.steps.size(),
                      finer_steps = fine.solve->integration().grid.steps.size();
    const double ratio = static_cast<double>(finer_steps) / static_cast<double>(steps);
    if (coarse.solve->integrated_meshes * (1.0 + ratio) > most_meshes) {
        return std::nullopt;
    }
    const GearboxTile tile = pilot_tile(coarse), reference = pilot_tile(fine);
    Squares sensor, te;
    StepError error;
    error.meshes = std::min(kMeshes, coarse.record.recorded_meshes);
    for (LaneId lane{0}; lane < lockstep::kPilotLanes; ++lane) {
        if (tile.status[lane] != Status::ok || reference.status[lane] != Status::ok) {
            continue;
        }
        ++error.gearboxes;
        for (int mesh = 0; mesh < error.meshes; ++mesh) {
            const lockstep::MeshRecord &a = record_of(tile, mesh), &b = record_of(reference, mesh);
            add_lane(a.acceleration, tile.realizations.size(), b.acceleration,
                     reference.realizations.size(), lane, sensor);
            add_lane(a.te, tile.realizations.size(), b.te, reference.realizations.size(), lane, te);
        }
    }
    if (error.gearboxes == 0) {
        return std::nullopt;
    }
    error.sensor = sensor.relative(false);
    error.te = te.relative(true);
    error.steps = static_cast<int>(steps);
    error.finer_steps = static_cast<int>(finer_steps);
    return error;
}

std::optional<StepError> find_step_error_of_run(const Planner& planner, std::size_t gearboxes) {
    constexpr double kShare = 0.02;
    const TilePlan plan = planner.tile(planner.facts().numerics);
    const double tiles = static_cast<double>(gearboxes) / plan.solve->settings.numerics.lanes;
    return find_step_error(planner, kShare * tiles * plan.solve->integrated_meshes);
}

std::string step_error_text(const StepError& error) {
    return fmt::format(
        "relative rms {:.1e} of the acceleration in the sensor's band and {:.1e} of the "
        "transmission error (difference between {} and {} steps per mesh period; {} gearboxes, "
        "{} mesh periods)",
        error.sensor, error.te, error.steps, error.finer_steps, error.gearboxes, error.meshes);
}

}  // namespace gearpod::mc
