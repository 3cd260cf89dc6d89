// Kernels of an integrator and a mesh law at constant load and speed, for each given number of
// lanes.
#pragma once

#include "dynamics/fixed_shaft_motion.hpp"
#include "dynamics/torsional_motion.hpp"
#include "dynamics/translational_motion.hpp"
#include "lockstep/integrators/implicit_stage.hpp"
#include "lockstep/kernels/integration_kernel.hpp"

namespace gearpod::lockstep {

template <machine::InstructionSet kSet, class Method, class Law, class Real, int W>
void add_steady(KernelTable& table, const KernelKey& key) {
    if constexpr (kImplicit<Method>) {
        add_kernel<kSet, Method, MatrixMotion<Law, W>>(table, key, MotionModel::matrices);
    } else {
        using namespace dynamics;
        add_kernel<kSet, Method, TranslationalMotion<WithInertialTerms, Law, W, Real>>(
            table, key, MotionModel::translational_inertial);
        add_kernel<kSet, Method, TranslationalMotion<WithoutInertialTerms, Law, W, Real>>(
            table, key, MotionModel::translational);
        add_kernel<kSet, Method, TorsionalMotion<Law, W, Real>>(table, key, MotionModel::torsional);
        add_kernel<kSet, Method, FixedShaftMotions<Law, W, Real>>(table, key,
                                                                  MotionModel::fixed_shaft);
    }
}

template <machine::InstructionSet kSet, class Method, class Law, int... kWidths>
void add_doubles(KernelTable& table, const KernelKey& key) {
    (add_steady<kSet, Method, Law, double, kWidths>(table, key), ...);
}

template <machine::InstructionSet kSet, class Method, class Law, int... kWidths>
void add_singles(KernelTable& table, const KernelKey& key) {
    (add_steady<kSet, Method, Law, float, kWidths>(table, key), ...);
}

}  // namespace gearpod::lockstep
