// Stiffness of a study's gear pairs, healthy and with the fault, and the scales of their tooth
// errors. Scenes share it unless they differ in numerics.stiffness_tolerance or
// numerics.face_slices.
#pragma once

#include <memory>
#include <vector>

#include "gears/tooth_deviations.hpp"
#include "mc/scene/drivetrain.hpp"
#include "mc/scene/faults.hpp"
#include "mc/scene/meshes.hpp"

namespace gearpod::mc {

class SceneStiffness {
  public:
    // Throws SceneError.
    SceneStiffness(const Study& study, const Drivetrain& drivetrain);
    SceneStiffness(const SceneStiffness&) = delete;
    SceneStiffness& operator=(const SceneStiffness&) = delete;

    const std::vector<SceneMesh>& meshes() const { return meshes_; }
    const lockstep::PairSet& pairs() const { return pairs_; }
    const SceneFault& fault() const { return fault_; }
    // Mean stiffness of every pair over the mesh period, N/m.
    const std::vector<double>& mean_pairs() const { return mean_pairs_; }
    // Scales of the tooth errors of ISO 1328 grade 5; all 0 without a quality.
    const MemberArray<gears::DeviationScales>& tooth_scales() const { return tooth_scales_; }
    // Largest stiffness of every gear pair, with all tooth pairs in contact that can touch, N/m. It
    // bounds the integrator's step.
    std::vector<double> stiffest_pairs() const;
    // Phases in [0, 1) at which steps must end.
    std::vector<double> transitions() const;

  private:
    std::vector<SceneMesh> meshes_;
    lockstep::PairSet pairs_;
    SceneFault fault_;
    std::vector<double> mean_pairs_;
    MemberArray<gears::DeviationScales> tooth_scales_;
};

}  // namespace gearpod::mc
