#include "lockstep/integrators/central_difference.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "dynamics/gearbox_matrices.hpp"

namespace gearpod::lockstep {

double CentralDifference::stable_step(const dynamics::GearboxMatrices& m) {
    const Eigen::MatrixXd stiffness = m.stiffness + m.centrifugal;
    const auto is_stable = [&](double h) {
        const Eigen::MatrixXd left = m.mass - h * (m.damping + 0.25 * h * stiffness);
        return dynamics::positive_definite(left);
    };
    // Upper bound: the longest stable step of any single body, m = h c + h^2/4 k.
    double above = std::numeric_limits<double>::infinity();
    for (Eigen::Index i = 0; i < m.mass.rows(); ++i) {
        const double c = m.damping(i, i), k = std::max(0.0, stiffness(i, i)), mass = m.mass(i, i);
        const double rate = c + std::sqrt(c * c + k * mass);
        above = rate > 0.0 ? std::min(above, 2.0 * mass / rate) : above;
    }
    if (!std::isfinite(above)) {
        return above;
    }
    constexpr int kHalvings = 40;
    double below = 0.0;
    for (int i = 0; i < kHalvings; ++i) {
        const double middle = 0.5 * (below + above);
        (is_stable(middle) ? below : above) = middle;
    }
    return below;
}

}  // namespace gearpod::lockstep
