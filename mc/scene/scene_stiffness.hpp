// The stiffness of a study's gear pairs, healthy and with the fault, and what their quality allows.
// Of the numerics only stiffness_tolerance has a part in it: scenes that differ in others share
// one.
#pragma once

#include <memory>
#include <vector>

#include "gears/tooth_deviations.hpp"
#include "mc/scene/drive.hpp"
#include "mc/scene/faults.hpp"
#include "mc/scene/meshes.hpp"

namespace gearpod::mc {

class SceneStiffness {
  public:
    // Throws SceneError.
    SceneStiffness(const Study& study, const Drive& drive);
    SceneStiffness(const SceneStiffness&) = delete;
    SceneStiffness& operator=(const SceneStiffness&) = delete;

    const std::vector<SceneMesh>& meshes() const { return meshes_; }
    const lockstep::PairSet& pairs() const { return pairs_; }
    const SceneFault& fault() const { return fault_; }
    // Every pair's mean over the mesh period, N/m.
    const std::vector<double>& mean_pairs() const { return mean_pairs_; }
    // The teeth of gears of ISO 1328 grade 5; all 0 without a quality.
    const EachMember<gears::DeviationScales>& tooth_scales() const { return tooth_scales_; }
    // All pairs at their stiffest: the bound for the integrator's step.
    std::vector<double> stiffest_pairs() const;
    // Phases in [0, 1) on which steps must end.
    std::vector<double> transitions() const;

  private:
    std::vector<SceneMesh> meshes_;
    lockstep::PairSet pairs_;
    SceneFault fault_;
    std::vector<double> mean_pairs_;
    EachMember<gears::DeviationScales> tooth_scales_;
};

}  // namespace gearpod::mc
