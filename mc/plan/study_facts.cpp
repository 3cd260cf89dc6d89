#include "mc/plan/study_facts.hpp"

#include <fmt/format.h>

#include <numbers>

#include "analysis/report/wording.hpp"
#include "mc/plan/record_plan.hpp"
#include "mc/study/assumptions.hpp"
#include "mc/study/gears.hpp"
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
                    .record = record_conditions(*study),
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

}  // namespace gearpod::mc
