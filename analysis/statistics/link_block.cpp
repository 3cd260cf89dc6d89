#include "analysis/statistics/link_block.hpp"

#include <cmath>
#include <limits>
#include <numbers>

namespace gearpod::analysis {

LinkBlock::LinkBlock(Link link, const Block& eta) {
    if (link == Link::cloglog || link == Link::loglog) {
        up.resize(eta.size());
        down.resize(eta.size());
        density.resize(eta.size());
        for (Eigen::Index i = 0; i < eta.size(); ++i) {
            const LinkValues at = link_values(link, eta[i]);
            up[i] = at.up;
            down[i] = at.down;
            density[i] = at.density;
        }
        return;
    }
    Block small;
    if (link == Link::logit) {
        const Block e = (-eta.abs()).exp();
        small = e / (1.0 + e);
        density = small / (1.0 + e);
    } else {
        small = eta.unaryExpr(
            [](double at) { return 0.5 * std::erfc(std::abs(at) / std::numbers::sqrt2); });
        density = (-0.5 * eta.square()).exp() * (std::numbers::inv_sqrtpi / std::numbers::sqrt2);
    }
    up = (eta > 0.0).select(1.0 - small, small);
    down = (eta > 0.0).select(small, 1.0 - small);
}

Block block_log(const Block& values) {
    // Eigen vectorises the logarithm only for an expression that is an array of its own.
    return values.max(std::numeric_limits<double>::min()).log();
}

}  // namespace gearpod::analysis
