// Adds integration kernels to the table.
#pragma once

#include "lockstep/integrators/integration_steps.hpp"
#include "lockstep/kernels/kernel_table.hpp"
#include "machine/kernel.hpp"

namespace gearpod::lockstep {

// Adds the kernel of a model. The caller sets the key's integrator, law and excitation.
template <machine::InstructionSet kSet, class Method, class Motion>
void add_kernel(KernelTable& table, KernelKey key, MotionModel motion_model) {
    key.set = kSet;
    key.motion_model = motion_model;
    key.lanes = Motion::kWidth;
    key.precision = std::is_same_v<RealOf<Motion>, float> ? Precision::single_precision
                                                          : Precision::double_precision;
    table.add<typename Motion::Lanes>(
        key, machine::Compiled<integrate_mesh<Method, Motion>>::template of<kSet>());
}

}  // namespace gearpod::lockstep
