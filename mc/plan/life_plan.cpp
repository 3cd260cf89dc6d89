#include "mc/plan/life_plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "analysis/statistics/distributions.hpp"
#include "mc/plan/scene_stiffness.hpp"
#include "mc/study/assumptions.hpp"
#include "mc/study/faults/crack.hpp"
#include "mc/study/fluctuations.hpp"
#include "mc/study/gears.hpp"
#include "mc/study/schema/schema.hpp"
#include "mc/study/sensor_signal.hpp"

namespace gearpod::mc {
namespace {

constexpr double kReach = 1.5;  // standard deviations

double nominal_of(const Study& study, const RandomInput& input) {
    const Key& key = *find_key(input.key);
    return std::get<NumberAccess>(key.access).get(study).value() / key.unit.to_si;
}

double normal_density(double z) {
    return std::isinf(z) ? 0.0 : std::exp(-0.5 * z * z) / std::sqrt(2.0 * std::numbers::pi);
}

// Means of a normal number over equally probable parts of its range, with a spread of 1.
std::vector<double> means_of_parts(int parts) {
    std::vector<double> means;
    double square = 0.0, before = 0.0;
    for (int i = 1; i <= parts; ++i) {
        const double here =
            i < parts ? normal_density(analysis::normal_quantile(static_cast<double>(i) / parts))
                      : 0.0;
        means.push_back(parts * (before - here));
        square += means.back() * means.back() / parts;
        before = here;
    }
    for (double& mean : means) {
        mean /= std::sqrt(square);
    }
    return means;
}

int first_step_of(const Life& life) {
    constexpr double kRounding = 1e-9;
    const double steps = crack_begin_m(life) / *life.last_depth_m * life.depth_steps;
    return std::min(static_cast<int>(steps + kRounding), life.depth_steps - 1);
}

// Study of the gearboxes: inputs that vary by record keep their nominal values.
Study study_of_gearboxes(const Study& study) {
    Study all = study;
    std::erase_if(all.random,
                  [](const RandomInput& input) { return input.distribution.per_record(); });
    return all;
}

double mesh_frequency_Hz(const Drivetrain& drivetrain, double speed_rad_s) {
    return std::abs(drivetrain.mesh_frequency_rad_s(speed_rad_s)) / (2.0 * std::numbers::pi);
}

RecordSpan span_of(const RecordLength& length, int recordings, const signals::SpanLayout& span,
                   double mesh_Hz) {
    RecordSpan record{span.ring_teeth, span.ring_teeth, recordings};
    if (length.given()) {
        check_record_length(length, span, mesh_Hz);
        record.turns = whole_turns(length, span, mesh_Hz);
    }
    return record;
}

// Length of a recording, s.
double recording_s(const RecordSpan& record, int planet_teeth, double mesh_Hz) {
    return record.turns * planet_teeth / mesh_Hz;
}

std::string record_text(const Study& study, const GearboxPlan& gearbox) {
    const signals::SpanLayout span = gearbox.drivetrain->span();
    const double mesh_Hz = mesh_frequency_Hz(*gearbox.drivetrain, gearbox.nominal.speed_rad_s);
    const RecordSpan record =
        span_of(life_record_length(study), study.life.recordings, span, mesh_Hz);
    const int teeth = span.planet_teeth;
    std::string text = fmt::format("{} turns of {} mesh periods, {:.3g} s", record.turns, teeth,
                                   recording_s(record, teeth, mesh_Hz));
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

CrackedTooth cracked_tooth(const Study& study, const GearboxPlan& gearbox) {
    const FaultPlace place = fault_places(study.fault).front();
    const Member member = *study.fault.member;
    return {gearbox.stiffness->meshes()[place.mesh].geometry.value(), place.gear, profile_of(study),
            crack_angle_rad(study), study.gearbox.face_width_m.value(), crack_law(study),
            gearbox.teeth[member],
            // A tooth of a central gear meets every planet in turn.
            member == Member::sun ? gearbox.planets : 1};
}

std::variant<ParisStart, DepthCurve> growth_of(const Life& life) {
    if (life.curve_h.empty()) {
        return ParisStart{life.first_depth_m.value()};
    }
    return DepthCurve{life.curve_h, life.curve_depth_m};
}

}  // namespace

RecordDistribution::RecordDistribution(const Study& study, RecordQuantity quantity, double scatter,
                                       std::optional<int> distinct)
    : scatter_(scatter) {
    if (distinct) {
        distinct_ = means_of_parts(*distinct);
    }
    for (const RandomInput& input : study.random) {
        if (input.distribution.per_record() && input.quantity == quantity) {
            input_ = input;
            input_->distribution = input.distribution.in_unit_of_file();
            nominal_ = nominal_of(study, input);
        }
    }
}

double RecordDistribution::factor(double unit) const {
    if (distinct_.empty()) {
        return factor_of(unit);
    }
    const auto parts = static_cast<double>(distinct_.size());
    const double part = std::min(std::floor(parts * analysis::normal_cdf(unit)), parts - 1.0);
    return factor_of(distinct_[static_cast<std::size_t>(part)]);
}

std::vector<double> RecordDistribution::distinct_factors() const {
    std::vector<double> all;
    for (const double unit : distinct_) {
        const double next = factor_of(unit);
        if (all.empty() || next > all.back()) {
            all.push_back(next);
        }
    }
    return all;
}

double RecordDistribution::factor_of(double unit) const {
    if (!input_) {
        return std::exp(scatter_ * unit);
    }
    const double share = analysis::normal_cdf(unit);
    return input_->distribution.quantile(share) / nominal_;
}

double RecordDistribution::rms() const {
    if (!input_) {
        return std::exp(scatter_ * scatter_);
    }
    constexpr int kShares = 999;
    double sum = 0.0;
    for (int i = 0; i < kShares; ++i) {
        const double value = input_->distribution.quantile((i + 0.5) / kShares) / nominal_;
        sum += value * value / kShares;
    }
    return std::sqrt(sum);
}

std::vector<double> RecordDistribution::integrated_factors() const {
    if (!varies()) {
        return {1.0};
    }
    const double low = factor(-kReach), high = factor(kReach);
    if (low < high) {
        return {low, high};
    }
    // These quantiles of a discrete distribution may coincide; then its limits are used.
    const Support support = input_ ? input_->distribution.support() : Support{1.0, 1.0};
    return support.low < support.high
               ? std::vector<double>{support.low / nominal_, support.high / nominal_}
               : std::vector<double>{low};
}

std::string RecordDistribution::text() const {
    if (input_) {
        return fmt::format("{} = {}", input_->key, input_->distribution.toml());
    }
    return scatter_ > 0.0
               ? fmt::format("varies by {:g} % (rms) about the gearbox's value", 100.0 * scatter_)
               : "the gearbox's";
}

RecordDistributions::RecordDistributions(const Study& study)
    : torque(study, RecordQuantity::torque, study.life.torque_scatter, study.life.distinct_torques),
      speed(study, RecordQuantity::speed, study.life.speed_scatter, study.life.distinct_speeds),
      gain(study, RecordQuantity::gain, study.life.gain_scatter),
      noise(study, RecordQuantity::noise, study.life.noise_scatter),
      sensor_noise_only(std::ranges::any_of(study.random, [](const RandomInput& input) {
          return input.distribution.per_record() && input.quantity == RecordQuantity::noise;
      })) {}

CampaignPlan make_campaign_plan(const Study& study) {
    EnsemblePlan ensemble(study);
    ensemble.inputs = EnsemblePlan(study_of_gearboxes(study)).inputs;
    return {.ensemble = std::move(ensemble),
            .assumptions = mc::assumptions(study, true, make_fault_plan(study).phrase()),
            .counting_lives = study.life.healthy_lives,
            .records = study.life.records,
            .baseline_records = study.monitoring.baseline_records,
            .interval_h = study.life.interval_h.value(),
            .begin_m = crack_begin_m(study.life),
            .smallest_m = smallest_depth_m(study.life),
            .last_m = study.life.last_depth_m.value(),
            .depth_steps = study.life.depth_steps,
            .first_step = first_step_of(study.life),
            .torque_regression = study.monitoring.torque_regression,
            .detectors = study.monitoring.detectors,
            .false_alarms_per_1000_h = study.monitoring.false_alarms_per_1000_h};
}

std::optional<CampaignPlan> recorded_campaign_plan(const std::string& study_text,
                                                   const std::string& name) {
    const std::optional<Study> study = read_study_text(study_text, name).study;
    return study && study->life.interval_h ? std::optional(make_campaign_plan(*study))
                                           : std::nullopt;
}

namespace {

LifePlan make_life_plan(const Study& study, const GearboxPlan& gearbox) {
    const Life& life = study.life;
    std::vector<std::string> used, ignored;
    if (gearbox.tooth_errors) {
        used.emplace_back("tooth errors");
    }
    for (const RandomInput& input : study_of_gearboxes(study).random) {
        (input.kind == InputKind::fault_size ? ignored : used).push_back(input.key);
    }
    return {.campaign = make_campaign_plan(study),
            .distributions = RecordDistributions(study),
            .torques = {life.polynomial_torques, life.polynomial_torques || life.distinct_torques},
            .speeds = {life.polynomial_speeds, life.polynomial_speeds || life.distinct_speeds},
            .interpolation_tolerance = life.interpolation_tolerance,
            .noise_level = study.sensor.noise_levels.front(),
            .length = life_record_length(study),
            .recordings = life.recordings,
            .record = record_text(study, gearbox),
            .seed = static_cast<std::uint64_t>(study.ensemble.seed),
            .sampler = std::make_shared<const Sampler>(DrawPlan(study_of_gearboxes(study))),
            .drivetrain = gearbox.drivetrain,
            .gearbox_inputs = std::move(used),
            .ignored_inputs = std::move(ignored),
            .tooth = cracked_tooth(study, gearbox),
            .growth = growth_of(life)};
}

// Reason why a feature cannot be computed from superposed records; empty if it can.
std::string feature_problem(const Study& study, const FeaturePlan& plan, const RecordSpan& record,
                            const features::Feature& feature) {
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
    const int meshes = record.turns * plan.span.planet_teeth, least = plan.least_meshes(feature);
    return least > meshes ? fmt::format("needs {} mesh periods, but a record has {}", least, meshes)
                          : "";
}

std::vector<SceneError> life_problems(const Study& study, const FeaturePlan& features,
                                      const GearboxPlan& gearbox) {
    std::vector<SceneError> problems;
    const auto reject = [&](const char* key, const std::string& what, const char* remedy) {
        problems.emplace_back(key, what, remedy);
    };
    if (!study.life.interval_h) {
        reject("life.interval_h", "missing: the time between records", "add [life]");
    }
    try {
        const double mesh_Hz = mesh_frequency_Hz(*gearbox.drivetrain, gearbox.nominal.speed_rad_s);
        const RecordLength length = life_record_length(study);
        const RecordSpan record = span_of(length, study.life.recordings, features.span, mesh_Hz);
        const double hours =
            recording_s(record, features.span.planet_teeth, mesh_Hz) * record.recordings / 3600.0;
        if (length.given() && study.life.interval_h && hours > *study.life.interval_h) {
            problems.emplace_back(
                length.section + "." + length.key(),
                fmt::format("a record lasts {:.4g} h or more, but there are {:g} h between two "
                            "records (life.interval_h)",
                            hours, *study.life.interval_h),
                "shorten it");
        }
        for (const features::Feature* feature : features.used) {
            if (const std::string what = feature_problem(study, features, record, *feature);
                !what.empty()) {
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

// Keys given in the study that have no effect on lives, because they concern single records.
std::vector<std::string> keys_without_effect_on_lives(const Study& study) {
    std::vector<std::string> keys;
    if (study.numerics.verify) {
        keys.emplace_back("numerics.verify");
    }
    if (!study.detection.uncertain_inputs.empty()) {
        keys.emplace_back("detection.uncertain_inputs");
    }
    return keys;
}

}  // namespace

RecordSpan LifePlan::record_span(double speed_rad_s) const {
    return span_of(length, recordings, drivetrain->span(),
                   mesh_frequency_Hz(*drivetrain, speed_rad_s));
}

StudyLives::StudyLives(const Study& study, const FeaturePlan& features, const GearboxPlan& gearbox)
    : requested(study.life.interval_h),
      ignored(keys_without_effect_on_lives(study)),
      problems(life_problems(study, features, gearbox)),
      plan(problems.empty() ? std::make_shared<const LifePlan>(make_life_plan(study, gearbox))
                            : nullptr) {}

Problems StudyLives::problems_in(const std::string& file) const {
    Problems all;
    for (const SceneError& error : problems) {
        all.push_back({file, 0, error.key(), error.what(), error.remedy()});
    }
    return all;
}

}  // namespace gearpod::mc
