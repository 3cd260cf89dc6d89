// Forces of the gear pairs (springs and mesh damping) at the samples of a mesh period.
#pragma once

#include <span>
#include <vector>

#include "dynamics/gearbox.hpp"
#include "lockstep/plan/integration_plan.hpp"

namespace gearpod::lockstep {

template <int W>
class MeshForces {
  public:
    // `inputs` holds W gearboxes. The plan must outlive the object.
    MeshForces(const IntegrationPlan& plan, std::span<const dynamics::GearboxInputs> inputs);

    // Sets MeshRecord::mesh_force from MeshRecord::step_states. The force of a sample is that at
    // the first stage node of the step that contains it. This is the sample itself, or the middle
    // of the following step if the integrator evaluates forces there.
    void write(const MeshOverrides& overrides, MeshRecord& record) const;

    // Forces at the first stage node of a step, [pair][lane], N, positive in compression. q (m) and
    // v (m/s): [degree of freedom][lane].
    void at(int step, const MeshOverrides& overrides, std::span<const double> q,
            std::span<const double> v, double* force) const;

  private:
    template <class Law>
    void with_law(int step, const MeshOverrides& overrides, std::span<const double> q,
                  std::span<const double> v, double* force) const;

    struct Lanes {
        alignas(64) double mesh_period[W], backlash[W];
        dynamics::DampingLanes<W> mesh_damping[dynamics::kMaxPairs];
    };
    template <class Law>
    struct Model;

    const IntegrationPlan& plan_;
    Lanes lanes_;
    std::vector<std::vector<double>> row_;  // [pair][degree of freedom]: weights of its deflection
};

}  // namespace gearpod::lockstep
