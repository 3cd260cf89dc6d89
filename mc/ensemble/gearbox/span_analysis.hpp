// Computes further signals that features need from the sensor samples over a span and from the
// averaged transmission error. Used for simulated gearboxes and for measured signals.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "mc/plan/feature_plan.hpp"
#include "mc/plan/record_plan.hpp"
#include "signals/prediction/prewhitening.hpp"
#include "signals/spectra/order_spectrum.hpp"
#include "signals/windowing/tooth_statistics.hpp"
#include "signals/windowing/windowing.hpp"

namespace gearpod::mc {

// Holds scratch memory: use one object per thread.
class SpanAnalysis {
  public:
    SpanAnalysis(const RecordPlan& record, const FeaturePlan& features, features::SignalSet needs);

    // `samples`: m/s^2, P per mesh period. Features of the planets' teeth and turns need
    // `planet_turns` turns: Z_r, or fewer in a short recording. Signals that need more mesh periods
    // than there are (FeaturePlan::least_meshes()) become NaN.
    // `planet_offset`: first sample of the best window of the planets' teeth. Fills the needed
    // parts of `input`, which refer to memory of this object.
    void sensor(std::span<const double> samples, int planet_turns, int planet_offset,
                features::FeatureInput& input);
    // `turn`: averaged transmission error, rad.
    void te(std::span<const double> turn, features::FeatureInput& input);

  private:
    // Adds the statistics of the teeth of a central gear if they are needed.
    template <Member kGear>
    void central_teeth(std::span<const double> samples, signals::ToothStatistics& statistics,
                       features::FeatureInput& input);

    // RMS of every tooth of a gear in a signal of these turns, in the best window. Returns its
    // first sample.
    int search_window(std::span<const double> span, const signals::GearTurns& gear,
                      std::vector<double>& rms) const;
    void whitened_teeth(std::span<const double> span, const signals::GearTurns& planet,
                        features::FeatureInput& input);

    const RecordPlan& record_;
    const FeaturePlan& features_;
    features::SignalSet needs_;
    std::vector<double> window_;  // one mesh period
    std::unique_ptr<signals::MeshSeparation> sensor_turn_, te_turn_;
    std::unique_ptr<signals::Prewhitening> prewhitening_;  // of the length used last
    std::vector<double> average_, whitened_rms_;
    signals::ToothStatistics planet_, sun_, ring_;
};

}  // namespace gearpod::mc
