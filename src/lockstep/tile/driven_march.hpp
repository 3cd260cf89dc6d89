// Marches W gearboxes that are driven unevenly (excitation.hpp) through one mesh period after the
// other.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "lockstep/plan/excitation.hpp"
#include "lockstep/plan/march.hpp"

namespace gearpod::lockstep {

template <int W>
class DrivenMarch {
  public:
    virtual ~DrivenMarch() = default;
    // Marches `state` through mesh period `mesh` and records it. `record` must have its sizes
    // (make_record). Mesh periods of which one is marched after the other must ascend by one, or
    // time does not run on (ExcitationRows::fill).
    virtual void operator()(int mesh, const MeshOverrides& overrides, TileState& state,
                            MeshRecord& record) = 0;
};

// Whether kernels exist: doubles by rk4 or sdirk3; where the speed fluctuates by rk4, with a node
// on every sample.
bool can_be_driven(const MarchPlan& plan, const Excitation& excitation);

// `inputs` holds W gearboxes of the plan's kind. Plan and excitation must outlive the result.
// Throws std::invalid_argument where kernels are missing.
template <int W>
std::unique_ptr<DrivenMarch<W>> make_driven_march(const MarchPlan& plan,
                                                  const Excitation& excitation,
                                                  std::span<const dynamics::GearboxInputs> inputs);

#define GEARPOD_DRIVEN_MARCH(W, REAL)                                     \
    extern template std::unique_ptr<DrivenMarch<W>> make_driven_march<W>( \
        const MarchPlan&, const Excitation&, std::span<const dynamics::GearboxInputs>);
GEARPOD_FOR_DOUBLE_WIDTHS(GEARPOD_DRIVEN_MARCH)
#undef GEARPOD_DRIVEN_MARCH

}  // namespace gearpod::lockstep
