// Kernel entry points, written once for all integrators, models and instruction sets. All
// instruction sets give the same bits (machine/dispatch.hpp).
#pragma once

#include "lockstep/integrators/march_steps.hpp"
#include "lockstep/kernels/kernel_table.hpp"

namespace gearpod::lockstep {

#if defined(__x86_64__) && !defined(GEARPOD_ONE_INSTRUCTION_SET)
template <class Method, class Motion>
__attribute__((target("arch=x86-64-v4,prefer-vector-width=512"))) void march_x86_64_v4(
    const MarchPlan& plan, const typename Motion::Lanes& lanes,
    const machine::AlignedVector& filter, const MeshOverrides& overrides, TileState& state,
    MeshRecord& record) {
    march<Method, Motion>(plan, lanes, filter, overrides, state, record);
}

template <class Method, class Motion>
__attribute__((target("arch=x86-64-v3"))) void march_x86_64_v3(const MarchPlan& plan,
                                                               const typename Motion::Lanes& lanes,
                                                               const machine::AlignedVector& filter,
                                                               const MeshOverrides& overrides,
                                                               TileState& state,
                                                               MeshRecord& record) {
    march<Method, Motion>(plan, lanes, filter, overrides, state, record);
}
#endif

template <class Method, class Motion>
void march_baseline(const MarchPlan& plan, const typename Motion::Lanes& lanes,
                    const machine::AlignedVector& filter, const MeshOverrides& overrides,
                    TileState& state, MeshRecord& record) {
    march<Method, Motion>(plan, lanes, filter, overrides, state, record);
}

template <machine::InstructionSet kSet, class Method, class Motion>
constexpr MarchKernel<typename Motion::Lanes>* march_kernel() {
#if defined(__x86_64__) && !defined(GEARPOD_ONE_INSTRUCTION_SET)
    if constexpr (kSet == machine::InstructionSet::x86_64_v4) {
        return &march_x86_64_v4<Method, Motion>;
    }
    if constexpr (kSet == machine::InstructionSet::x86_64_v3) {
        return &march_x86_64_v3<Method, Motion>;
    }
#endif
    return &march_baseline<Method, Motion>;
}

// Adds the kernel of a model. The caller sets the key's integrator, law and excitation.
template <machine::InstructionSet kSet, class Method, class Motion>
void add_kernel(KernelTable& table, KernelKey key, Moving moving) {
    key.set = kSet;
    key.moving = moving;
    key.lanes = Motion::kWidth;
    key.precision = std::is_same_v<RealOf<Motion>, float> ? Precision::single_precision
                                                          : Precision::double_precision;
    table.add<typename Motion::Lanes>(key, march_kernel<kSet, Method, Motion>());
}

}  // namespace gearpod::lockstep
