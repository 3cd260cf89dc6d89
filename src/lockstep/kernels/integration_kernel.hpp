// Kernel entry points, written once for all integrators, models and instruction sets. All
// instruction sets give the same bits (machine/dispatch.hpp).
#pragma once

#include "lockstep/integrators/integration_steps.hpp"
#include "lockstep/kernels/kernel_table.hpp"

namespace gearpod::lockstep {

#if defined(__x86_64__) && !defined(GEARPOD_ONE_INSTRUCTION_SET)
template <class Method, class Motion>
__attribute__((target("arch=x86-64-v4,prefer-vector-width=512"))) void integrate_x86_64_v4(
    const IntegrationPlan& plan, const typename Motion::Lanes& lanes,
    const machine::AlignedVector& filter, const MeshOverrides& overrides, TileState& state,
    MeshRecord& record) {
    integrate_mesh<Method, Motion>(plan, lanes, filter, overrides, state, record);
}

template <class Method, class Motion>
__attribute__((target("arch=x86-64-v3"))) void integrate_x86_64_v3(
    const IntegrationPlan& plan, const typename Motion::Lanes& lanes,
    const machine::AlignedVector& filter, const MeshOverrides& overrides, TileState& state,
    MeshRecord& record) {
    integrate_mesh<Method, Motion>(plan, lanes, filter, overrides, state, record);
}
#endif

template <class Method, class Motion>
void integrate_baseline(const IntegrationPlan& plan, const typename Motion::Lanes& lanes,
                        const machine::AlignedVector& filter, const MeshOverrides& overrides,
                        TileState& state, MeshRecord& record) {
    integrate_mesh<Method, Motion>(plan, lanes, filter, overrides, state, record);
}

template <machine::InstructionSet kSet, class Method, class Motion>
constexpr IntegrationKernel<typename Motion::Lanes>* integration_kernel() {
#if defined(__x86_64__) && !defined(GEARPOD_ONE_INSTRUCTION_SET)
    if constexpr (kSet == machine::InstructionSet::x86_64_v4) {
        return &integrate_x86_64_v4<Method, Motion>;
    }
    if constexpr (kSet == machine::InstructionSet::x86_64_v3) {
        return &integrate_x86_64_v3<Method, Motion>;
    }
#endif
    return &integrate_baseline<Method, Motion>;
}

// Adds the kernel of a model. The caller sets the key's integrator, law and excitation.
template <machine::InstructionSet kSet, class Method, class Motion>
void add_kernel(KernelTable& table, KernelKey key, MotionModel motion_model) {
    key.set = kSet;
    key.motion_model = motion_model;
    key.lanes = Motion::kWidth;
    key.precision = std::is_same_v<RealOf<Motion>, float> ? Precision::single_precision
                                                          : Precision::double_precision;
    table.add<typename Motion::Lanes>(key, integration_kernel<kSet, Method, Motion>());
}

}  // namespace gearpod::lockstep
