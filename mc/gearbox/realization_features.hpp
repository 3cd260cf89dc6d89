// Computes the features of one gearbox at every noise level from its signals.
#pragma once

#include <memory>
#include <vector>

#include "mc/gearbox/healthy_reference.hpp"
#include "mc/gearbox/python_features.hpp"
#include "mc/gearbox/realization_signals.hpp"
#include "mc/gearbox/record_window.hpp"

namespace gearpod::mc {

// Signals from which features are computed at one noise level.
struct LevelSignals {
    std::vector<double> te_turn;    // rad, Z_p P_te samples, from tooth 0
    std::vector<double> tooth_rms;  // m/s^2, Z_p values, from tooth 0; empty without a sensor
};

// Computes the features that a study uses.
class RealizationFeatures : public RealizationSignals {
  public:
    // `healthy` comes from healthy_reference() and must outlive the object. Without `python`,
    // features in Python are NaN, and their files are not needed.
    RealizationFeatures(const Scene& scene, const HealthyReference* healthy, bool python = true);

    // Values of all used features, [feature * noise levels + level]. If `signals` is not null, one
    // entry per noise level is appended to it.
    std::vector<double> compute(const LaneSignals& gearbox, const Realization& realization,
                                std::vector<LevelSignals>* signals = nullptr);

  private:
    // A baseline record with noise. If records have a length, `cut` is the record, and `aligned`
    // are its signals at the tooth position of the test record.
    struct Baseline {
        RealizationSignals signals;
        LaneSignals cut, aligned;
        double noise_m_s2 = 0.0;  // rms noise of the sensor at noise level 1
    };
    // Computes the features in Python from the signals that were added to `python_`.
    void add_python_values(const Realization& realization, std::vector<double>& values);
    void load(const LaneSignals& gearbox, const Realization& realization);
    void load_baselines(const LaneSignals& gearbox, const Realization& realization,
                        const RecordWindow& window);
    void load_change(const LaneSignals& gearbox, const Realization& realization);

    const Scene& scene_;
    std::vector<const features::Feature*> features_;
    PythonFeatures python_;
    const HealthyReference* healthy_;
    std::size_t levels_;
    LaneSignals record_;               // cut from the signals if records have a length
    std::vector<Baseline> baselines_;  // empty unless a feature compares with baseline records
    // Null unless a feature uses the change since the baseline.
    std::unique_ptr<RealizationSignals> change_;
    LaneSignals changed_;
};

}  // namespace gearpod::mc
