// Computing time of a study's optional effects, and how its features change when an effect is left
// out, or added where the study leaves it out.
#pragma once

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "machine/clocks.hpp"
#include "mc/numerics/pilot.hpp"

namespace gearpod::mc {

// Remaining processor time of a measurement. No new part is started when it has run out.

class TimeBudget {
  public:
    // `seconds` 0: no limit.
    explicit TimeBudget(double seconds)
        : end_s_(seconds > 0.0 ? thread_processor_s() + seconds : INFINITY) {}

    double seconds() const { return end_s_ - thread_processor_s(); }
    bool enough(double needed_s = 0.0) const { return seconds() > needed_s; }

  private:
    double end_s_;
};

// Relative change of a feature that matters where the feature's scatter is unknown.
inline constexpr double kChangeOfFeature = 1e-2;

// Effect that the study includes and was left out of it, or that was added to it.
struct MeasuredEffect {
    std::string effect;
    bool in_study = false;
    std::string refusal;      // why it was not measured; the members below are then empty
    double time_ratio = 0.0;  // processor time of a gearbox with the effect over that without
    PilotError change;        // of signals and features, relative to the study
};

struct EffectRequest {
    int repeats = 1;
    double seconds = 0.0;  // processor time after which no effect is started; 0: no limit
    std::function<void(const std::string&)> progress = [](const std::string&) {};
    std::function<void(const MeasuredEffect&)> measured = [](const MeasuredEffect&) {};
};

struct EffectMeasurement {
    std::vector<MeasuredEffect> effects;
    std::vector<std::string> omitted;  // effects for which the time did not suffice
};

// Integrates the pilot of a study with and without each effect.
EffectMeasurement measure_effects(const Planner& planner, const EffectRequest& request);

}  // namespace gearpod::mc
