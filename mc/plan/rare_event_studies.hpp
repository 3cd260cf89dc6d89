// Studies from which the rates of rare events are estimated: those of stored results, restricted to
// one feature, one noise level and gearboxes of one kind.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analysis/detection/detection_table.hpp"
#include "mc/plan/fault_plan.hpp"

namespace gearpod::mc {

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
