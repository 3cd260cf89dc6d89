// Facts that reports state of the study in a results file, and studies made from it to estimate the
// rates of rare events.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analysis/detection/detection_table.hpp"
#include "mc/plan/ensemble_plan.hpp"
#include "mc/plan/gearbox_streams.hpp"
#include "mc/plan/record_plan.hpp"
#include "mc/plan/scene_stiffness.hpp"
#include "mc/study/study.hpp"

namespace gearpod::mc {

// Facts of the study by which recordings were measured.
struct MeasuringFacts {
    std::string title;
    std::vector<std::string> features;  // used
    Monitoring monitoring;
    MemberArray<int> teeth;  // 0: no such gear
};

// Facts of the study of simulated gearboxes.
struct RunFacts {
    EnsemblePlan ensemble;
    RowOrder rows;
    FaultPlan fault;
    std::string other_fault;  // in words; "another fault" without one
    std::string conditions;   // see assumptions()
    RecordFacts record;
    std::string false_alarms;  // see false_alarm_target_text()
    std::string noise;         // "Noise x 1 is 0.02 m/s^2 rms at the sensor"
    std::string untested;      // next step that removes an idealization, or ""
    // Nominal noise at level 1; no value for quasi-static gearboxes.
    std::optional<double> sensor_noise_m_s2;
    double encoder_noise_rad;
};

// Both read the text of a study in a results file; `name` stands for it in messages. Empty if this
// program cannot read the study.
std::optional<MeasuringFacts> measuring_facts(const std::string& study_text,
                                              const std::string& name = "");
std::optional<RunFacts> run_facts(const std::string& study_text, const std::string& name = "");

// Makes the titles of features in Python known if the text is that of a study with some.
void declare_recorded_features(const std::string& text);

// Studies from which the rates of rare events are estimated: those of stored results, restricted to
// one feature, one noise level and gearboxes of one kind.

// Miss rate for faults of one size.
struct MissRateRequest {
    std::string feature;
    double threshold = 0.0;    // alarm threshold in the feature's unit
    double noise_level = 1.0;  // one of sensor.noise_levels
    double size = 0.0;         // fault size, SI
    long gearboxes = 0;
    int records = 0;  // per gearbox, a multiple of NoiseImportanceSampler::kKinds
};

// Either the threshold of healthy gearboxes for a false-alarm rate, or the miss rate of a given
// threshold for gearboxes with a fault.
struct RareRateRequest {
    std::string feature;
    double noise_level = 1.0;    // one of sensor.noise_levels
    std::optional<double> rate;  // false-alarm rate; if empty, the miss rate is estimated for:
    double size = 0.0;           // fault size, SI
    double threshold = 0.0;      // alarm threshold in the feature's unit
    long gearboxes = 0;          // members per level

    // Side on which the rare values lie. Misses lie on the opposite side of alarms.
    analysis::Alarm towards() const;
};

// Study of stored results, as far as rare events need it.
struct RareEventSource {
    std::string text;  // of the study
    FaultPlan fault;
    // Reasons why its noise cannot be tilted, as sentences that follow the name of its file.
    std::vector<std::string> noise_problems;
};
// Throws std::runtime_error with the problems of a text that this version cannot read. `name`
// stands for it in messages.
RareEventSource rare_event_source(const std::string& text, const std::string& name);
// Texts of the studies for the requests.
std::string miss_rate_text(const RareEventSource& source, const MissRateRequest& request);
std::string rare_rate_text(const RareEventSource& source, const RareRateRequest& request);

}  // namespace gearpod::mc
