#include "mc/plan/study_facts.hpp"

#include "mc/plan/record_plan.hpp"
#include "mc/study/assumptions.hpp"
#include "mc/study/noise.hpp"
#include "mc/study/other_sources.hpp"

namespace gearpod::mc {

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
    const std::string other_fault = other_fault_text(*study);
    return RunFacts{.ensemble = EnsemblePlan(*study),
                    .rows = RowOrder(study->ensemble),
                    .fault = make_fault_plan(*study),
                    .other_fault = other_fault.empty() ? "another fault" : other_fault,
                    .conditions = assumptions(*study, false),
                    .record = record_conditions(*study),
                    .false_alarms = false_alarm_target_text(*study),
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
