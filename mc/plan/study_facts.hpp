// Facts that reports state of the study in a results file.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "mc/plan/ensemble_plan.hpp"
#include "mc/plan/fault_plan.hpp"
#include "mc/plan/gearbox_streams.hpp"
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
    std::string other_fault;   // in words; "another fault" without one
    std::string conditions;    // see assumptions()
    std::string record;        // see record_conditions()
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

}  // namespace gearpod::mc
