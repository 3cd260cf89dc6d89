// Adds integration kernels to the table.
#pragma once

#include "dynamics/fixed_shaft_motion.hpp"
#include "dynamics/planetary_motion.hpp"
#include "lockstep/excitation/forced_motion.hpp"
#include "lockstep/excitation/variable_speed.hpp"
#include "lockstep/integrators/implicit_stage.hpp"
#include "lockstep/integrators/integration_steps.hpp"
#include "lockstep/kernels/kernel_table.hpp"
#include "machine/instruction_sets.hpp"

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

// Kernels of an integrator and a mesh law at constant load and speed, for each given number of
// lanes.
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

// Kernels of an integrator and a mesh law under time-varying forces, for each given number of
// lanes.
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

// Kernels of an integrator and a mesh law at variable speed, for each given number of lanes.
template <machine::InstructionSet kSet, class Method, class Law, int W>
void add_variable_speed_of_width(KernelTable& table, const KernelKey& key) {
    using SpeedMethod = typename VariableSpeed<Method>::Type;
    add_kernel<kSet, SpeedMethod, VariableSpeedTranslational<true, Law, W>>(
        table, key, MotionModel::translational_inertial);
    add_kernel<kSet, SpeedMethod, VariableSpeedTranslational<false, Law, W>>(
        table, key, MotionModel::translational);
    add_kernel<kSet, SpeedMethod, VariableSpeedTorsional<Law, W>>(table, key,
                                                                  MotionModel::torsional);
    add_kernel<kSet, SpeedMethod, VariableSpeedFixedShaft<Law, W>>(table, key,
                                                                   MotionModel::fixed_shaft);
}

template <machine::InstructionSet kSet, class Method, class Law, int... kWidths>
void add_variable_speed(KernelTable& table, KernelKey key) {
    key.excitation = ExcitationKind::variable_speed;
    (add_variable_speed_of_width<kSet, Method, Law, kWidths>(table, key), ...);
}

}  // namespace gearpod::lockstep
