#include "mc/lives/superposition.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "mc/plan/scene_error.hpp"
#include "mc/study/fluctuations.hpp"
#include "mc/study/housing.hpp"
#include "mc/study/noise.hpp"
#include "mc/study/other_sources.hpp"
#include "signals/spectra/synchronous_average.hpp"

namespace gearpod::mc {
namespace {

double mesh_frequency_Hz(const Scene& scene, double speed_rad_s) {
    return std::abs(scene.drivetrain().mesh_frequency_rad_s(speed_rad_s)) /
           (2.0 * std::numbers::pi);
}

// Length of a recording at this speed, s.
double recording_s(const Scene& scene, const RecordSpan& record, double speed_rad_s) {
    return record.turns * scene.span().planet_teeth / mesh_frequency_Hz(scene, speed_rad_s);
}

// Reason why a feature cannot be computed from superposed records; empty if it can.
std::string feature_problem(const Scene& scene, const RecordSpan& record,
                            const features::Feature& feature) {
    const Study& study = scene.study();
    if (feature.needs.has<features::HealthyRecords>()) {
        return "compares with the records of other healthy gearboxes, but a life has its own "
               "baseline (monitoring.baseline_records)";
    }
    if (life_record_length(study).given() && !feature.external &&
        feature.needs.has<features::TeTurn, features::TeParts>()) {
        return "averages the transmission error over the whole span, but recordings have another "
               "length (record_s, record_turns)";
    }
    if (record.recordings > 1 && needs_samples(feature.needs)) {
        return fmt::format(
            "needs the samples of one recording, but a record averages {} (life.recordings)",
            record.recordings);
    }
    const int meshes = record.turns * scene.span().planet_teeth,
              least = scene.features().least_meshes(feature);
    return least > meshes ? fmt::format("needs {} mesh periods, but a record has {}", least, meshes)
                          : "";
}

}  // namespace

RecordSpan record_span(const Scene& scene, double speed_rad_s) {
    const signals::SpanLayout& span = scene.span();
    const RecordLength length = life_record_length(scene.study());
    RecordSpan record{span.ring_teeth, span.ring_teeth, scene.study().life.recordings};
    if (length.given()) {
        const double mesh_Hz = mesh_frequency_Hz(scene, speed_rad_s);
        check_record_length(length, span, mesh_Hz);
        record.turns = whole_turns(length, span, mesh_Hz);
    }
    return record;
}

std::string record_text(const Scene& scene) {
    const double speed = nominal_inputs(scene.study()).speed_rad_s;
    const RecordSpan record = record_span(scene, speed);
    const int teeth = scene.span().planet_teeth;
    std::string text = fmt::format("{} turns of {} mesh periods, {:.3g} s", record.turns, teeth,
                                   recording_s(scene, record, speed));
    if (record.recordings > 1) {
        text += fmt::format(", averaged over {} such recordings", record.recordings);
    }
    return text +
           (record.turns >= record.all_turns
                ? fmt::format(": each of the {} teeth with all {} mating teeth", teeth,
                              record.all_turns)
                : fmt::format(
                      ": each of the {} teeth with {} of its {} mating teeth, chosen at random",
                      teeth, record.turns, record.all_turns));
}

ComparedNeeds superposed_needs(std::span<const features::Feature* const> features) {
    using features::BaselineUse;
    ComparedNeeds needs;
    for (const features::Feature* feature : features) {
        const BaselineUse use = feature->baseline_use;
        const bool changes = use == BaselineUse::change || use == BaselineUse::record_and_change;
        if (use != BaselineUse::change) {
            needs.record |= feature->needs;
        }
        if (changes) {
            needs.change |= feature->needs;
        }
        if (use == BaselineUse::baseline || (changes && feature->external)) {
            needs.baseline |= feature->needs;
        }
    }
    return needs;
}

std::vector<SceneError> superposition_problems(const Scene& scene) {
    const Study& study = scene.study();
    std::vector<SceneError> problems;
    const auto reject = [&](const char* key, const std::string& what, const char* remedy) {
        problems.emplace_back(key, what, remedy);
    };
    if (!study.life.interval_h) {
        reject("life.interval_h", "missing: the time between records", "add [life]");
    }
    try {
        const RecordSpan record = record_span(scene, nominal_inputs(study).speed_rad_s);
        const RecordLength length = life_record_length(study);
        const double hours = recording_s(scene, record, nominal_inputs(study).speed_rad_s) *
                             record.recordings / 3600.0;
        if (length.given() && study.life.interval_h && hours > *study.life.interval_h) {
            problems.emplace_back(
                length.section + "." + length.key(),
                fmt::format("a record lasts {:.4g} h or more, but there are {:g} h between two "
                            "records (life.interval_h)",
                            hours, *study.life.interval_h),
                "shorten it");
        }
        for (const features::Feature* feature : used_features(study)) {
            if (const std::string what = feature_problem(scene, record, *feature); !what.empty()) {
                reject("features.use", "\"" + std::string(feature->name) + "\" " + what,
                       "remove it");
            }
        }
    } catch (const SceneError& error) {
        problems.push_back(error);
    }
    if (study.effects.quasi_static()) {
        reject("effects.motion", "a quasi-static gearbox has no sensor signal",
               "use motion = \"translational-torsional\" or \"torsional\"");
    }
    if (study.sensor.noise_levels.size() != 1) {
        reject("sensor.noise_levels", "a life has one noise level", "use noise_levels = [1]");
    }
    if (has_random_fluctuations(study) || !study.sensor.tones.empty() || has_other_sources(study)) {
        reject("life.interval_h",
               "records are superpositions of steady signals, but the study has fluctuations, "
               "gravity, tones, bearings or stages that differ between records",
               "remove them");
    }
    if (study.numerics.paired_gearboxes > 0) {
        reject("numerics.paired_gearboxes",
               "has no effect on lives: only `run` corrects its results", "remove it");
    }
    if (!study.sensor.additional.empty()) {
        reject("sensor.additional", "lives have the first sensor only", "remove them");
    }
    if (has_range(study)) {
        reject("sensor.range_m_s2", "records are superpositions of parts, which are not clipped",
               "remove it");
    }
    if (has_housing(study)) {
        reject("sensor.housing_modes",
               "records are superpositions of parts that reach the sensor along a stiff path",
               "remove them, and a measured response (sensor.response_Hz)");
    }
    return problems;
}

void check_superposable(const Scene& scene) {
    if (const auto problems = superposition_problems(scene); !problems.empty()) {
        throw problems.front();
    }
}

namespace {

void add(std::span<const double> values, double factor, std::vector<double>& sum) {
    if (factor == 0.0 || values.empty()) {
        return;
    }
    sum.resize(values.size(), 0.0);
    for (std::size_t i = 0; i < values.size(); ++i) {
        sum[i] += factor * values[i];
    }
}

}  // namespace

SuperposedSignals::SuperposedSignals(std::span<const LaneSignals* const> basis, std::size_t bins,
                                     bool folds)
    : bins_(bins), count_(basis.size()) {
    for (std::size_t k = 0; k < count_; ++k) {
        samples_.emplace_back(basis[k]->sensor);
        te_turns_.push_back(basis[k]->te_turn);
        for (std::size_t l = k; folds && l < count_; ++l) {
            products_.push_back(
                signals::fold_of_products(basis[k]->sensor, basis[l]->sensor, bins));
        }
    }
}

LaneSignals SuperposedSignals::at(std::span<const double> coefficients) const {
    LaneSignals sum;
    sum.folded.assign(products_.empty() ? 0 : bins_, 0.0);
    std::size_t product = 0;
    for (std::size_t k = 0; k < count_; ++k) {
        add(te_turns_[k], coefficients[k], sum.te_turn);
        for (std::size_t l = k; product < products_.size() && l < count_; ++l, ++product) {
            const double twice = k == l ? 1.0 : 2.0;
            add(products_[product], twice * coefficients[k] * coefficients[l], sum.folded);
        }
    }
    // The sum of squares may become negative by rounding.
    for (double& value : sum.folded) {
        value = std::max(0.0, value);
    }
    return sum;
}

// The turns continue periodically.
std::vector<double> SuperposedSignals::turn(std::span<const double> coefficients,
                                            std::size_t number) const {
    const std::size_t begin = number % (samples_.front().size() / bins_) * bins_;
    std::vector<double> sum(bins_, 0.0);
    for (std::size_t k = 0; k < count_; ++k) {
        add(samples_[k].subspan(begin, bins_), coefficients[k], sum);
    }
    return sum;
}

void SuperposedSignals::add_turns(std::span<const double> coefficients, std::size_t first,
                                  std::size_t turns, std::vector<double>& folded) const {
    folded.resize(bins_, 0.0);
    for (std::size_t i = 0; i < turns; ++i) {
        const std::vector<double> one = turn(coefficients, first + i);
        for (std::size_t b = 0; b < bins_; ++b) {
            folded[b] += one[b] * one[b];
        }
    }
}

void SuperposedSignals::append_turns(std::span<const double> coefficients, std::size_t first,
                                     std::size_t turns, std::vector<double>& samples) const {
    samples.reserve(samples.size() + turns * bins_);
    for (std::size_t i = 0; i < turns; ++i) {
        const std::vector<double> one = turn(coefficients, first + i);
        samples.insert(samples.end(), one.begin(), one.end());
    }
}

}  // namespace gearpod::mc
