#include "mc/plan/study_facts.hpp"

#include <fmt/format.h>

#include <numbers>

#include "analysis/report/wording.hpp"
#include "mc/plan/record_plan.hpp"
#include "mc/study/assumptions.hpp"
#include "mc/study/gears.hpp"
#include "mc/study/schema/sizes.hpp"
#include "mc/study/sensor_signal.hpp"

namespace gearpod::mc {
namespace {

// Noise that x 1 stands for.
std::string noise_unit_text(const Study& study) {
    constexpr double kArcSeconds = 180.0 * 3600.0 / std::numbers::pi;  // per radian
    const double sensor = study.effects.quasi_static() ? 0.0 : sensor_noise_m_s2(study),
                 encoder = kArcSeconds * study.sensor.encoder_noise_rad;
    std::vector<std::string> parts;
    if (sensor > 0.0) {
        parts.push_back(fmt::format("{} m/s^2 rms at the sensor{}", analysis::number_text(sensor),
                                    chosen_mark(study, noise_key(study))));
    }
    if (encoder > 0.0) {
        parts.push_back(fmt::format("{} arcsec rms on the TE", analysis::number_text(encoder)));
    }
    return parts.empty() ? "" : "Noise x 1 is " + analysis::joined(parts) + ".";
}

Study of_feature(const Study& study, const std::string& feature, double noise_level) {
    Study restricted = study;
    restricted.features.use = {feature};
    restricted.sensor.noise_levels = {noise_level};
    return restricted;
}

Study with_fault(const Study& study, double size) {
    Study restricted = study;
    const std::string key = fault_size_key(study).path();
    std::erase_if(restricted.random, [&](const RandomInput& input) { return input.key == key; });
    std::erase_if(restricted.correlations,
                  [&](const Correlation& pair) { return pair.first == key || pair.second == key; });
    set_fault_size(restricted, size);
    restricted.detection.size_edges_m.clear();
    restricted.detection.size_edges.clear();
    return restricted;
}

// Study of test gearboxes that all have a fault of the requested size. The other inputs keep their
// distributions.
Study study_for_miss_rate(const Study& study, const MissRateRequest& request) {
    Study restricted =
        with_fault(of_feature(study, request.feature, request.noise_level), request.size);
    restricted.ensemble.instances = request.gearboxes;
    restricted.ensemble.threshold_records = request.records;
    restricted.ensemble.importance_sampling = true;
    return restricted;
}

// Study for multilevel splitting. Healthy gearboxes are those of its threshold group, faulty ones
// are as for a miss rate.
Study study_for_rare_rate(const Study& study, const RareRateRequest& request) {
    Study restricted = of_feature(study, request.feature, request.noise_level);
    if (!request.rate) {
        restricted = with_fault(restricted, request.size);
    }
    restricted.ensemble.instances = request.gearboxes;
    restricted.ensemble.threshold_records = 1;
    restricted.ensemble.importance_sampling.reset();
    return restricted;
}

}  // namespace

std::optional<MeasuringFacts> measuring_facts(const std::string& study_text,
                                              const std::string& name) {
    const std::optional<Study> study = read_study_text(study_text, name).study;
    if (!study) {
        return std::nullopt;
    }
    MeasuringFacts facts{study->title, study->features.use, study->monitoring, {}};
    for (const Member member : {Member::sun, Member::planet, Member::ring}) {
        facts.teeth[member] = study->gearbox.bodies[member].teeth.value_or(0);
    }
    return facts;
}

std::optional<RunFacts> run_facts(const std::string& study_text, const std::string& name) {
    const std::optional<Study> study = read_study_text(study_text, name).study;
    if (!study) {
        return std::nullopt;
    }
    const FaultPlan fault = make_fault_plan(*study);
    const std::string other_fault = other_fault_text(*study);
    return RunFacts{.ensemble = EnsemblePlan(*study),
                    .rows = RowOrder(study->ensemble),
                    .fault = fault,
                    .other_fault = other_fault.empty() ? "another fault" : other_fault,
                    .conditions = assumptions(*study, false, fault.phrase()),
                    .record = record_facts(*study),
                    .false_alarms = false_alarm_target_text(*study),
                    .noise = noise_unit_text(*study),
                    .untested = has_gears(*study) && !has_tooth_errors(*study)
                                    ? "give the teeth errors (gearbox.tooth_quality) and run again"
                                    : "",
                    .sensor_noise_m_s2 = study->effects.quasi_static()
                                             ? std::nullopt
                                             : std::optional(sensor_noise_m_s2(*study)),
                    .encoder_noise_rad = study->sensor.encoder_noise_rad};
}

void declare_recorded_features(const std::string& text) {
    if (text.find("\npython = [\n") != std::string::npos) {
        read_study_text(text, "");
    }
}

analysis::Alarm RareRateRequest::towards() const {
    const analysis::Alarm alarm = features::find_feature(feature)->alarm;
    return rate ? alarm : analysis::opposite(alarm);
}

RareEventSource rare_event_source(const std::string& text, const std::string& name) {
    const auto [study, problems, notices] = read_study_text(text, name);
    if (!study) {
        throw std::runtime_error(name + ": the study in the file cannot be read:\n" +
                                 format(problems));
    }
    RareEventSource source{text, make_fault_plan(*study), {}};
    if (noise_by_density(*study)) {
        source.noise_problems.emplace_back(
            "its study gives the noise by density, which is not white after the low-pass; "
            "`misses` needs white noise (sensor.noise_m_s2)");
    }
    if (has_range(*study)) {
        source.noise_problems.emplace_back(
            "its study clips the samples, so that their noise is not Gaussian "
            "(sensor.range_m_s2); `misses` needs white noise");
    }
    if (has_other_sources(*study)) {
        source.noise_problems.emplace_back(
            "its study has faulty bearings or neighbouring stages, whose vibration all records of "
            "a gearbox would share (sensor.bearings, sensor.stages)");
    }
    return source;
}

std::string miss_rate_text(const RareEventSource& source, const MissRateRequest& request) {
    return resolved_text(study_for_miss_rate(*read_study_text(source.text, "").study, request));
}

std::string rare_rate_text(const RareEventSource& source, const RareRateRequest& request) {
    return resolved_text(study_for_rare_rate(*read_study_text(source.text, "").study, request));
}

}  // namespace gearpod::mc
