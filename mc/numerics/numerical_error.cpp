#include "mc/numerics/numerical_error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "analysis/detection/detection.hpp"
#include "lockstep/kernels/kernel_table.hpp"
#include "mc/ensemble/batch_workers.hpp"
#include "mc/ensemble/gearbox/gearbox_tile.hpp"
#include "mc/ensemble/gearbox/solution_choice.hpp"
#include "mc/numerics/pilot.hpp"
#include "mc/numerics/solver_setting.hpp"
#include "mc/study/gears.hpp"

namespace gearpod::mc {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr int kFiner = 4;
constexpr double kConverged = 1e-10;

SolverSetting setting_of(const Scene& scene) {
    SolverSetting setting = own_setting(scene.study());
    if (setting.numerics.steps_per_mesh == 0) {
        setting.numerics.steps_per_mesh = static_cast<int>(scene.plan().grid.steps.size());
    }
    return setting;
}

// The same setting with finer uniform steps; for a graded grid finer than its finest step.
SolverSetting finer_than(const Scene& scene, const SolverSetting& setting, int factor) {
    SolverSetting finer = setting;
    Numerics& n = finer.numerics;
    n.convergence_tolerance = std::min(kConverged, n.convergence_tolerance);
    double steps = n.steps_per_mesh;
    if (scene.calibration()) {
        n.grid = StepGrid::uniform;
        finer.options.emplace_back("grid");
        steps = std::ceil(1.0 / scene.calibration()->grading.first);
    }
    n.steps_per_mesh = static_cast<int>(std::min(1e6, factor * steps));
    return finer;
}

constexpr int kVerified = 8;  // gearboxes, unless the study has numerics.paired_gearboxes

// At most `count` of the gearboxes, spread evenly over them.
std::vector<GearboxId> spread(const std::vector<GearboxId>& all, std::size_t count) {
    const std::size_t stride =
        std::max<std::size_t>(1, all.size() / std::max<std::size_t>(1, count));
    std::vector<GearboxId> ids;
    for (std::size_t i = stride / 2; i < all.size() && ids.size() < count; i += stride) {
        ids.push_back(all[i]);
    }
    return ids;
}

// Gearboxes of a group; of the test gearboxes only those with a fault.
std::vector<GearboxId> members(const Scene& scene, Group group) {
    const Ensemble& ensemble = scene.study().ensemble;
    const std::int64_t count =
        group == Group::test ? ensemble.instances : ensemble.threshold_instances;
    std::vector<GearboxId> ids;
    for (std::int64_t i = 0; i < count; ++i) {
        const GearboxId id{group, static_cast<std::uint64_t>(i)};
        if (group == Group::threshold || scene.sampler().draw(id).inputs.fault_size > 0.0) {
            ids.push_back(id);
        }
    }
    return ids;
}

// Values of the features of some gearboxes, by gearbox, and their fault sizes.
struct Values {
    std::vector<std::span<const double>> features;  // NaN for a gearbox that failed
    std::vector<double> size;
    std::size_t count = 0;  // of values of a gearbox
};
Values values_of(const Scene& scene, const BatchRows& rows) {
    const RowShape& shape = scene.ensemble().shape;
    Values values{{}, {}, shape.features * shape.levels};
    for (std::size_t row = 0; row < rows.count(); ++row) {
        const std::span all(rows.values);
        values.features.push_back(
            all.subspan(row * shape.values() + shape.parameters, values.count));
        values.size.push_back(rows.values[row * shape.values() + shape.fault_size()]);
    }
    return values;
}

// Adds the differences of the first `test_count` gearboxes in one value. Infinite if a gearbox has
// it with fine steps only.
void add_differences(const Values& own, const Values& fine, std::size_t test_count, std::size_t at,
                     NumericalError& error) {
    double squares = 0.0, largest = 0.0;
    std::size_t compared = 0;
    for (std::size_t g = 0; g < test_count; ++g) {
        const double here = own.features[g][at], there = fine.features[g][at];
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
    const std::size_t size_at = frame.parameter_index(frame.request.size.name).value_or(0);
    for_each_row(rows, [&](const ResultRow& row) {
        const bool is_test = row.group == static_cast<int>(Group::test);
        const auto group = analysis::group_of(row.values[size_at], groups);
        for (std::size_t at = 0; at < all.size(); ++at) {
            const double value = row.values[shape.parameters + at];
            if (!std::isfinite(value)) {
                continue;
            }
            if (!is_test) {
                all[at].healthy.push_back(value);
            } else if (group) {
                const double threshold =
                    frame.detection[at / shape.levels].levels[at % shape.levels].threshold;
                const double error = 2.0 * frame.numerical->largest[at];
                ++all[at].tested[*group];
                all[at].near[*group] += std::abs(value - threshold) <= error ? 1 : 0;
            }
        }
    });
    return all;
}

void set_rate_contribution(const analysis::LevelDetection& level, const Counts& counts,
                           NumericalContribution& contribution) {
    contribution.pd = contribution.pd_half_width = kNaN;
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

void set_size_contribution(const analysis::HitMissPod& pod, NumericalContribution& contribution) {
    using Where = analysis::SizeEstimate::Where;
    contribution.a90 = contribution.a90_interval = kNaN;
    if (!pod.refusal.empty() || pod.a90.estimate.where != Where::reached ||
        !std::isfinite(contribution.pd)) {
        return;
    }
    constexpr double kStep = 1e-4;
    const double size = pod.a90.estimate.size;
    const analysis::PodCurve& curve = pod.chosen.curve;
    const double slope =
        (curve.pod(size * (1.0 + kStep)) - curve.pod(size * (1.0 - kStep))) / (2.0 * kStep * size);
    contribution.a90 = contribution.pd / slope;
    contribution.a90_interval =
        pod.a90.upper.where == Where::reached ? pod.a90.upper.size - size : INFINITY;
}

}  // namespace

FinerScene finer_scene(const Scene& scene) {
    const Numerics& numerics = scene.study().numerics;
    const bool verifies = numerics.tolerance > 0.0 || numerics.scatter_tolerance > 0.0 ||
                          numerics.verify || numerics.paired_gearboxes > 0;
    return verifies ? with_finer_steps(scene) : FinerScene{};
}

FinerScene with_finer_steps(const Scene& scene) {
    const Study& study = scene.study();
    FinerScene finer;
    if (study.effects.quasi_static()) {
        return finer;
    }
    if (study.numerics.mass_scaling_Hz > 0.0) {
        Study own_rule = study;
        own_rule.numerics.mass_scaling_Hz = 0.0;
        own_rule.numerics.steps_per_mesh = 0;
        finer.setting = own_setting(own_rule);
        finer.scene.emplace(scene.with(with_setting(study, finer.setting).numerics));
        finer.setting = setting_of(*finer.scene);
        return finer;
    }
    const SolverSetting setting = setting_of(scene);
    for (int factor = kFiner; !finer.scene && factor > 1; factor /= 2) {
        finer.setting = finer_than(scene, setting, factor);
        try {
            finer.scene.emplace(scene.with(with_setting(study, finer.setting).numerics));
        } catch (const SceneError&) {  // more steps than the program allows
            continue;
        }
    }
    return finer;
}

std::optional<NumericalError> find_numerical_error(const Scene& scene) {
    const FinerScene finer = finer_scene(scene);
    if (!finer.scene) {
        return std::nullopt;
    }
    const auto pairs = static_cast<std::size_t>(scene.study().numerics.paired_gearboxes);
    std::vector<GearboxId> ids, healthy;
    if (pairs > 0) {
        ids = spread(members(scene, Group::test), pairs);
        healthy = spread(members(scene, Group::threshold), pairs);
    }
    const std::size_t faulty = ids.size();
    if (ids.empty()) {  // no pairs, or no gearbox with a fault
        const auto stride = static_cast<std::uint64_t>(std::max<std::int64_t>(
            1, scene.study().ensemble.instances / static_cast<std::int64_t>(kVerified)));
        ids = pilot_gearboxes(stride / 2, stride);
    }
    const std::size_t test_count = ids.size();
    ids.insert(ids.end(), healthy.begin(), healthy.end());
    const BatchRows own_rows = rows_of_gearboxes(scene, ids),
                    fine_rows = rows_of_gearboxes(*finer.scene, ids);
    const Values own = values_of(scene, own_rows), fine = values_of(scene, fine_rows);
    NumericalError error{
        setting_of(scene).text(), finer.setting.text(), static_cast<int>(test_count), {}, {}};
    error.healthy_pairs = static_cast<int>(healthy.size());
    error.faulty_pairs = static_cast<int>(faulty);
    for (std::size_t at = 0; at < own.count; ++at) {
        add_differences(own, fine, test_count, at, error);
        PairedValues values;
        for (std::size_t g = 0; g < ids.size(); ++g) {
            values.own.push_back(own.features[g][at]);
            values.fine.push_back(fine.features[g][at]);
            values.size.push_back(g < test_count ? own.size[g] : 0.0);
        }
        if (pairs > 0) {
            error.corrections.push_back(fit_correction(values));
        }
    }
    return error;
}

std::vector<NumericalContribution> numerical_contributions(
    const Results& frame, const RowSource& rows,
    const std::optional<analysis::Reliability>& reliability) {
    std::vector<NumericalContribution> contributions;
    if (!frame.numerical) {
        return contributions;
    }
    const std::size_t levels = frame.noise_levels.size();
    const std::vector<Counts> counts = count_near(frame, rows);
    const std::vector<CorrectedDetection> corrected = corrected_detection(frame, rows);
    for (std::size_t at = 0; at < counts.size(); ++at) {
        const std::size_t f = at / levels, level = at % levels;
        NumericalContribution contribution;
        contribution.feature = frame.features[f].name;
        contribution.noise_level = frame.noise_levels[level];
        contribution.rms = frame.numerical->rms[at];
        contribution.spread = standard_deviation(counts[at].healthy);
        set_rate_contribution(frame.detection[f].levels[level], counts[at], contribution);
        if (reliability) {
            set_size_contribution(reliability->features[f].levels[level].hit_miss, contribution);
        } else {
            contribution.a90 = contribution.a90_interval = kNaN;
        }
        if (!corrected.empty()) {
            contribution.corrected = corrected[at];
            contribution.correction = frame.numerical->corrections[at];
        }
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
        const double own = squares - (about_mean ? sum * sum / std::max(1.0, count) : 0.0);
        return own > 0.0 ? std::sqrt(deviation / own) : 0.0;
    }
};

class StepPilot {
  public:
    explicit StepPilot(const Scene& scene) {
        for (const GearboxId& id : pilot_gearboxes()) {
            gearboxes_.push_back(scene.sampler().draw(id));
        }
    }

    GearboxTile run(const Scene& scene) const {
        const int lanes =
            lockstep::lanes_for(scene.plan().precision, static_cast<int>(gearboxes_.size()));
        return run_realizations(scene, sensor_paths(scene), gearboxes_, lanes,
                                {.records = lockstep::RecordOptions{}});
    }

    std::size_t size() const { return gearboxes_.size(); }

  private:
    std::vector<Realization> gearboxes_;
};

const lockstep::MeshRecord& record_of(const GearboxTile& tile, int mesh) {
    const std::vector<int>& content = tile.integration.content;
    return tile.integration.records[static_cast<std::size_t>(
        content[static_cast<std::size_t>(mesh) % content.size()])];
}

void add_lane(const machine::AlignedVector& values, std::size_t lanes,
              const machine::AlignedVector& reference, std::size_t reference_lanes,
              std::size_t lane, Squares& squares) {
    for (std::size_t row = 0; row < values.size() / lanes; ++row) {
        squares.add(values[row * lanes + lane], reference[row * reference_lanes + lane]);
    }
}

}  // namespace

std::optional<StepError> find_step_error(const Scene& scene, double most_meshes) {
    if (scene.study().effects.quasi_static() || !teeth_can_separate(scene.study())) {
        return std::nullopt;
    }
    FinerScene finer = with_finer_steps(scene);
    if (!finer.scene) {
        return std::nullopt;
    }
    Numerics in_double_precision = finer.scene->study().numerics;
    in_double_precision.precision = Precision::double_precision;
    const Scene coarse = scene.recording_at_most(kMeshes);
    const Scene fine = finer.scene->with(in_double_precision).recording_at_most(kMeshes);
    const double ratio = static_cast<double>(fine.plan().grid.steps.size()) /
                         static_cast<double>(coarse.plan().grid.steps.size());
    if (integrated_meshes(coarse) * (1.0 + ratio) > most_meshes) {
        return std::nullopt;
    }
    const StepPilot pilot(scene);
    const GearboxTile own = pilot.run(coarse), reference = pilot.run(fine);
    Squares sensor, te;
    StepError error;
    error.meshes = std::min(kMeshes, coarse.recorded_meshes());
    for (std::size_t lane = 0; lane < pilot.size(); ++lane) {
        if (own.status[lane] != Status::ok || reference.status[lane] != Status::ok) {
            continue;
        }
        ++error.gearboxes;
        for (int mesh = 0; mesh < error.meshes; ++mesh) {
            const lockstep::MeshRecord &a = record_of(own, mesh), &b = record_of(reference, mesh);
            add_lane(a.acceleration, own.realizations.size(), b.acceleration,
                     reference.realizations.size(), lane, sensor);
            add_lane(a.te, own.realizations.size(), b.te, reference.realizations.size(), lane, te);
        }
    }
    if (error.gearboxes == 0) {
        return std::nullopt;
    }
    error.sensor = sensor.relative(false);
    error.te = te.relative(true);
    error.steps = static_cast<int>(coarse.plan().grid.steps.size());
    error.finer_steps = static_cast<int>(fine.plan().grid.steps.size());
    return error;
}

std::optional<StepError> find_step_error_of_run(const Scene& scene, std::size_t gearboxes) {
    constexpr double kShare = 0.02;
    const double tiles = static_cast<double>(gearboxes) / scene.study().numerics.lanes;
    return find_step_error(scene, kShare * tiles * integrated_meshes(scene));
}

std::string step_error_text(const StepError& error) {
    return fmt::format(
        "relative rms {:.1e} of the acceleration in the sensor's band and {:.1e} of the "
        "transmission error (difference between {} and {} steps per mesh period; {} gearboxes, "
        "{} mesh periods)",
        error.sensor, error.te, error.steps, error.finer_steps, error.gearboxes, error.meshes);
}

}  // namespace gearpod::mc
