#include "analysis/statistics/clopper_pearson.hpp"

#include <limits>
#include <stdexcept>

#include "analysis/statistics/distributions.hpp"

namespace gearpod::analysis {

Interval clopper_pearson_interval(long detected, long tested, double confidence) {
    if (detected < 0 || detected > tested || !(confidence > 0.0 && confidence < 1.0)) {
        throw std::invalid_argument(
            "Clopper-Pearson interval: needs 0 <= detected <= tested and a confidence");
    }
    if (tested == 0) {
        const double nan = std::numeric_limits<double>::quiet_NaN();
        return {nan, nan};
    }
    const double tail = 0.5 * (1.0 - confidence);
    const auto k = static_cast<double>(detected);
    const auto n = static_cast<double>(tested);
    Interval bounds{0.0, 1.0};
    if (detected > 0) {
        bounds.lower = beta_quantile(k, n - k + 1.0, tail);
    }
    if (detected < tested) {
        bounds.upper = beta_upper_quantile(k + 1.0, n - k, tail);
    }
    return bounds;
}

}  // namespace gearpod::analysis
