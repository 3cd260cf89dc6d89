// Computes the features of one gearbox at every noise level from its signals.
#pragma once

#include <memory>
#include <vector>

#include "mc/gearbox/healthy_reference.hpp"
#include "mc/gearbox/realization_signals.hpp"

namespace gearpod::mc {

// Signals from which features are computed at one noise level.
struct LevelSignals {
    std::vector<double> te_turn;    // rad, Z_p P_te samples
    std::vector<double> tooth_rms;  // m/s^2, Z_p values; empty without a sensor
};

// Computes the features that a study uses.
class RealizationFeatures : public RealizationSignals {
  public:
    // `healthy` comes from healthy_reference() and must outlive the object.
    RealizationFeatures(const Scene& scene, const HealthyReference* healthy);

    // Values of all used features, [feature * noise levels + level]. If `signals` is not null, one
    // entry per noise level is appended to it.
    std::vector<double> compute(const LaneSignals& gearbox, const Realization& realization,
                                std::vector<LevelSignals>* signals = nullptr);

  private:
    void load(const LaneSignals& gearbox, const Realization& realization);

    const Scene& scene_;
    std::vector<const features::Feature*> features_;
    const HealthyReference* healthy_;
    std::size_t levels_;
    // Null unless a feature compares with the baseline record.
    std::unique_ptr<RealizationSignals> baseline_, change_;
    LaneSignals changed_;
};

}  // namespace gearpod::mc
