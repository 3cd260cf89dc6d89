// Kernels of an integrator and a mesh law at variable speed, for each given number of lanes.
#pragma once

#include "lockstep/driven/paced_motion.hpp"
#include "lockstep/driven/paced_runge_kutta.hpp"
#include "lockstep/kernels/march_kernel.hpp"

namespace gearpod::lockstep {

template <machine::InstructionSet kSet, class Method, class Law, int W>
void add_paced_of_width(KernelTable& table, const KernelKey& key) {
    using Own = typename Paced<Method>::Type;
    add_kernel<kSet, Own, PacedTranslational<true, Law, W>>(table, key,
                                                            Moving::translational_inertial);
    add_kernel<kSet, Own, PacedTranslational<false, Law, W>>(table, key, Moving::translational);
    add_kernel<kSet, Own, PacedTorsional<Law, W>>(table, key, Moving::torsional);
    add_kernel<kSet, Own, PacedFixedShaft<Law, W>>(table, key, Moving::fixed_shaft);
}

template <machine::InstructionSet kSet, class Method, class Law, int... kWidths>
void add_paced(KernelTable& table, KernelKey key) {
    key.drive = Drive::paced;
    (add_paced_of_width<kSet, Method, Law, kWidths>(table, key), ...);
}

}  // namespace gearpod::lockstep
