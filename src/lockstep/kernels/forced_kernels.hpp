// Kernels of an integrator and a mesh law under time-varying forces, for each given number of
// lanes.
#pragma once

#include "dynamics/fixed_shaft_motion.hpp"
#include "dynamics/torsional_motion.hpp"
#include "dynamics/translational_motion.hpp"
#include "lockstep/driven/forced_motion.hpp"
#include "lockstep/integrators/implicit_stage.hpp"
#include "lockstep/kernels/march_kernel.hpp"

namespace gearpod::lockstep {

template <machine::InstructionSet kSet, class Method, class Law, int W>
void add_forced_of_width(KernelTable& table, const KernelKey& key) {
    if constexpr (kImplicit<Method>) {
        add_kernel<kSet, Method, ForcedMatrixMotion<MatrixMotion<Law, W>>>(table, key,
                                                                           Moving::matrices);
    } else {
        using namespace dynamics;
        add_kernel<kSet, Method, Forced<TranslationalMotion<WithInertialTerms, Law, W>>>(
            table, key, Moving::translational_inertial);
        add_kernel<kSet, Method, Forced<TranslationalMotion<WithoutInertialTerms, Law, W>>>(
            table, key, Moving::translational);
        add_kernel<kSet, Method, Forced<TorsionalMotion<Law, W>>>(table, key, Moving::torsional);
        add_kernel<kSet, Method, Forced<FixedShaftMotions<Law, W>>>(table, key,
                                                                    Moving::fixed_shaft);
    }
}

template <machine::InstructionSet kSet, class Method, class Law, int... kWidths>
void add_forced(KernelTable& table, KernelKey key) {
    key.drive = Drive::forced;
    (add_forced_of_width<kSet, Method, Law, kWidths>(table, key), ...);
}

}  // namespace gearpod::lockstep
