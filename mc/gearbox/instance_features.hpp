// From one gearbox's signals to its features at every noise level.
#pragma once

#include <memory>
#include <vector>

#include "mc/gearbox/healthy_reference.hpp"
#include "mc/gearbox/instance_signals.hpp"

namespace gearpod::mc {

// What the features of one noise level look at.
struct LevelSignals {
    std::vector<double> te_turn;    // rad, Z_p P_te samples
    std::vector<double> tooth_rms;  // m/s^2, Z_p; empty without a sensor
};

// The features that a study uses.
class InstanceFeatures : public InstanceSignals {
  public:
    // `healthy` is that of healthy_reference() and outlives the object.
    InstanceFeatures(const Scene& scene, const HealthyReference* healthy);

    // Values of all used features: [feature * noise levels + level]. `signals` gets what they look
    // at, an entry a noise level, unless it is null.
    std::vector<double> compute(const LaneSignals& gearbox, const InstanceInputs& inputs,
                                const GearboxId& id, std::vector<LevelSignals>* signals = nullptr);

  private:
    void load(const LaneSignals& gearbox, const InstanceInputs& inputs, const GearboxId& id);

    const Scene& scene_;
    std::vector<const features::Feature*> features_;
    const HealthyReference* healthy_;
    std::size_t levels_;
    // Where features compare with them.
    std::unique_ptr<InstanceSignals> baseline_, change_;
    LaneSignals changed_;
};

}  // namespace gearpod::mc
