// From the sensor's samples over a span and the averaged TE to the signals that features look at,
// beyond the folded squares: for simulated gearboxes and for measured signals alike.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "features/feature.hpp"
#include "mc/scene/scene.hpp"
#include "signals/spectra/mesh_separation.hpp"
#include "signals/windowing/tooth_signals.hpp"
#include "signals/windowing/windowing.hpp"

namespace gearpod::mc {

// For features with some needs (features::Need). Holds scratch memory: one object per thread.
class SpanAnalysis {
  public:
    SpanAnalysis(const Scene& scene, unsigned needs);

    // `samples`: m/s^2, P a mesh period, at least meshes_needed() of them, or, of features of the
    // planets' teeth and turns alone, those of `planet_turns`: the span's Z_r, or fewer of a short
    // recording. `planet_offset`: of the best first window of the planets' teeth. Fills what was
    // needed; `input` looks at this object's memory.
    void sensor(std::span<const double> samples, int planet_turns, int planet_offset,
                features::FeatureInput& input);
    // `turn`: rad, the averaged TE.
    void te(std::span<const double> turn, features::FeatureInput& input);

  private:
    features::ToothSignals central_teeth(std::span<const double> samples, int teeth, bool moments,
                                         signals::ToothStatistics& statistics);

    const Scene& scene_;
    unsigned needs_;
    std::vector<double> window_;  // of one mesh period
    std::unique_ptr<signals::MeshSeparation> sensor_turn_, te_turn_;
    std::vector<double> average_;
    signals::ToothStatistics planet_, sun_, ring_;
};

}  // namespace gearpod::mc
