// Kernels of an integrator and a mesh law under time-varying forces, for each given number of
// lanes.
#pragma once

#include "dynamics/fixed_shaft_motion.hpp"
#include "dynamics/torsional_motion.hpp"
#include "dynamics/translational_motion.hpp"
#include "lockstep/excitation/forced_motion.hpp"
#include "lockstep/integrators/implicit_stage.hpp"
#include "lockstep/kernels/integration_kernel.hpp"

namespace gearpod::lockstep {

template <machine::InstructionSet kSet, class Method, class Law, int W>
void add_forced_of_width(KernelTable& table, const KernelKey& key) {
    if constexpr (kImplicit<Method>) {
        add_kernel<kSet, Method, ForcedMatrixMotion<MatrixMotion<Law, W>>>(table, key,
                                                                           MotionModel::matrices);
    } else {
        using namespace dynamics;
        add_kernel<kSet, Method, Forced<TranslationalMotion<WithInertialTerms, Law, W>>>(
            table, key, MotionModel::translational_inertial);
        add_kernel<kSet, Method, Forced<TranslationalMotion<WithoutInertialTerms, Law, W>>>(
            table, key, MotionModel::translational);
        add_kernel<kSet, Method, Forced<TorsionalMotion<Law, W>>>(table, key,
                                                                  MotionModel::torsional);
        add_kernel<kSet, Method, Forced<FixedShaftMotions<Law, W>>>(table, key,
                                                                    MotionModel::fixed_shaft);
    }
}

template <machine::InstructionSet kSet, class Method, class Law, int... kWidths>
void add_forced(KernelTable& table, KernelKey key) {
    key.excitation = ExcitationKind::forced;
    (add_forced_of_width<kSet, Method, Law, kWidths>(table, key), ...);
}

}  // namespace gearpod::lockstep
