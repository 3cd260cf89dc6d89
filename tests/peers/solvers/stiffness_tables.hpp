// The pairs' stiffness over the fault's pattern, from the study's own curves: by step and stage
// node for solvers with fixed steps, by time for those with adaptive steps.
#pragma once

#include <span>
#include <vector>

#include "gearbox.hpp"
#include "lockstep/plan/fault_schedule.hpp"
#include "mc/plan/scene.hpp"

namespace gearpod::peers {

// Eight realizations of the scene's test group; where they are integrated one by one, the one
// with the largest crack.
inline constexpr int kGearboxes = 8, kLargestCrack = 6;

struct GearboxInputs8 {
    std::vector<mc::InstanceInputs> instances;
    std::vector<dynamics::GearboxInputs> inputs;
    lockstep::FaultCurves faults;
};
GearboxInputs8 inputs_of_gearboxes(const mc::Scene& scene);

class StiffnessTables {
  public:
    // Values at the nodes of the steps of `plan`, which must outlive the tables.
    StiffnessTables(const mc::Scene& scene, const lockstep::IntegrationPlan& plan,
                    const GearboxInputs8& gearboxes);

    const lockstep::PhaseGrid& grid() const { return plan_.grid; }
    int meshes() const { return static_cast<int>(overrides_.size()); }

    // Values at stage node 0, 1 or 2 (start, middle, end) of a step of mesh k of the pattern.
    void at_node(int mesh, int step, int node, int gearbox, Meshes<double>& m) const;
    // Same for all eight, with T::load().
    template <class T>
    void at_node(int mesh, int step, int node, Meshes<T>& m) const {
        const std::size_t row = row_of(step, node);
        const T factor[2] = {T::load(factor_[0]), T::load(factor_[1])};
        for (int pair = 0; pair < kPairs; ++pair) {
            const std::size_t at = row + static_cast<std::size_t>(pair);
            m.k[pair] = plan_.nodes.stiffness[at];
            m.c[pair] = plan_.nodes.damping_shape[at] * factor[side(pair)];
        }
        for (const lockstep::PairOverride& o : overrides_[static_cast<std::size_t>(mesh)]) {
            if (step >= o.first_step && step < o.last_step) {
                const std::size_t at = lane_row(o, step, node);
                m.k[o.pair] = T::load(&o.stiffness[at]);
                m.c[o.pair] = factor[side(o.pair)] * T::load(&o.damping_shape[at]);
            }
        }
    }

    // Values at `phase` in [0, 1] of mesh k, linear between nodes of steps first to last - 1 only,
    // so that a stretch between two transitions does not depend on values beyond them.
    void at_phase(int mesh, double phase, int first, int last, int gearbox,
                  Meshes<double>& m) const;

    // Steps that begin at a transition, ascending, and one past the last.
    const std::vector<int>& stretches() const { return stretches_; }

  private:
    static int side(int pair) { return pair < kPlanets ? 0 : 1; }
    std::size_t row_of(int step, int node) const {
        return static_cast<std::size_t>((step * 3 + node) * kPairs);
    }
    std::size_t lane_row(const lockstep::PairOverride& o, int step, int node) const {
        return static_cast<std::size_t>(((step - o.first_step) * 3 + node) * kGearboxes);
    }
    int step_at(double phase, int first, int last) const;

    const lockstep::IntegrationPlan& plan_;
    std::vector<std::vector<lockstep::PairOverride>> overrides_;  // by mesh
    double factor_[2][kGearboxes];
    std::vector<int> stretches_;
    std::vector<int> first_of_cell_;  // first step of each of equal parts of the mesh period
};

}  // namespace gearpod::peers
