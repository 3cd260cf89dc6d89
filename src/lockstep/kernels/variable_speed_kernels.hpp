// Kernels of an integrator and a mesh law at variable speed, for each given number of lanes.
#pragma once

#include "lockstep/excitation/variable_speed_motion.hpp"
#include "lockstep/excitation/variable_speed_runge_kutta.hpp"
#include "lockstep/kernels/integration_kernel.hpp"

namespace gearpod::lockstep {

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
