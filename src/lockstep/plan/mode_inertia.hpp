// Selective mass scaling: additional inertia of a gearbox's fast natural modes, so that explicit
// steps may be longer (L. Olovsson, K. Simonsson and M. Unosson, Int. J. Numer. Methods Eng. 63
// (2005), 1436-1445).
//
// With M-orthonormal mode shapes phi_k and angular frequencies w_k above the limit w of the
// nominal gearbox at mean mesh stiffness, the mass matrix becomes
//
//     M_s = M + sum over k of s_k (M phi_k)(M phi_k)^T,    s_k = (w_k / w)^2 - 1,
//
// so that these modes have the frequency w and all others, the static deflection included, are
// unchanged. Accelerations a = M^-1 f become M_s^-1 f = a - sum of s_k / (1 + s_k) phi_k (M
// phi_k)^T a.
#pragma once

#include <vector>

#include "dynamics/gearbox_matrices.hpp"

namespace gearpod::lockstep {

// Modes are processed in blocks of this many, the last of which is filled with zeros.
inline constexpr int kModesPerBlock = 8;

// [block of modes][degree of freedom][mode of the block].
template <class Real>
struct ModeTables {
    std::vector<Real> momentum;  // (M phi_k)^T, one row per mode
    std::vector<Real> effect;    // -s_k / (1 + s_k) phi_k
};

struct ModeInertia {
    int modes = 0;               // number of modes with additional inertia
    int blocks = 0;              // of kModesPerBlock modes
    double fastest_rad_s = 0.0;  // angular frequency of the fastest of them without it
    Eigen::MatrixXd mass;        // sum of s_k (M phi_k)(M phi_k)^T; empty without modes
    ModeTables<double> in_double = {};
    ModeTables<float> in_single = {};

    template <class Real>
    const ModeTables<Real>& tables() const {
        if constexpr (sizeof(Real) == sizeof(float)) {
            return in_single;
        } else {
            return in_double;
        }
    }
};

// Inertia that lowers all modes of these matrices above `limit_rad_s` to it; none for a limit of 0.
ModeInertia mode_inertia(const dynamics::GearboxMatrices& matrices, double limit_rad_s);

// The same matrices with that inertia.
dynamics::GearboxMatrices with_mode_inertia(dynamics::GearboxMatrices matrices,
                                            const ModeInertia& inertia);

}  // namespace gearpod::lockstep
