#include "lockstep/plan/mode_inertia.hpp"

#include <cmath>

namespace gearpod::lockstep {

ModeInertia mode_inertia(const dynamics::GearboxMatrices& m, double limit_rad_s) {
    ModeInertia inertia;
    if (!(limit_rad_s > 0.0)) {
        return inertia;
    }
    const dynamics::Modes modes = dynamics::modes(m.stiffness, m.mass);
    const Eigen::Index n = m.mass.rows();
    const double limit2 = limit_rad_s * limit_rad_s;
    inertia.modes = static_cast<int>((modes.squares.array() > limit2).count());
    if (inertia.modes == 0) {
        return inertia;
    }
    inertia.blocks = (inertia.modes + kModesPerBlock - 1) / kModesPerBlock;
    inertia.fastest_rad_s = std::sqrt(modes.squares(n - 1));
    inertia.mass = Eigen::MatrixXd::Zero(n, n);
    const std::size_t size = static_cast<std::size_t>(inertia.blocks * kModesPerBlock * n);
    inertia.in_double = {std::vector<double>(size), std::vector<double>(size)};
    for (int k = 0; k < inertia.modes; ++k) {
        const Eigen::Index mode = n - inertia.modes + k;
        const Eigen::VectorXd shape =
            modes.shapes.col(mode) /
            std::sqrt(modes.shapes.col(mode).dot(m.mass * modes.shapes.col(mode)));
        const Eigen::VectorXd momentum = m.mass * shape;
        const double added = modes.squares(mode) / limit2 - 1.0;
        inertia.mass += added * momentum * momentum.transpose();
        for (Eigen::Index i = 0; i < n; ++i) {
            const auto index = static_cast<std::size_t>(
                (k / kModesPerBlock * n + i) * kModesPerBlock + k % kModesPerBlock);
            inertia.in_double.momentum[index] = momentum(i);
            inertia.in_double.effect[index] = -added / (1.0 + added) * shape(i);
        }
    }
    inertia.in_single = {{inertia.in_double.momentum.begin(), inertia.in_double.momentum.end()},
                         {inertia.in_double.effect.begin(), inertia.in_double.effect.end()}};
    return inertia;
}

dynamics::GearboxMatrices with_mode_inertia(dynamics::GearboxMatrices matrices,
                                            const ModeInertia& inertia) {
    if (inertia.modes > 0) {
        matrices.mass += inertia.mass;
    }
    return matrices;
}

}  // namespace gearpod::lockstep
