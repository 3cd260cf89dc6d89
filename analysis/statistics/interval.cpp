#include "analysis/statistics/interval.hpp"

#include <cmath>
#include <stdexcept>

#include "analysis/statistics/distributions.hpp"
#include "machine/no_value.hpp"

namespace gearpod::analysis {

Interval wilson_interval(long detected, long tested, double confidence) {
    if (detected < 0 || detected > tested || !(confidence > 0.0 && confidence < 1.0)) {
        throw std::invalid_argument(
            "Wilson interval: needs 0 <= detected <= tested and a confidence");
    }
    if (tested == 0) {
        return {kNan, kNan};
    }
    const double z = normal_upper_quantile(0.5 * (1.0 - confidence));
    const auto n = static_cast<double>(tested);
    const double p = static_cast<double>(detected) / n;
    const double z2 = z * z;
    const double centre = (p + z2 / (2.0 * n)) / (1.0 + z2 / n);
    const double half = z / (1.0 + z2 / n) * std::sqrt(p * (1.0 - p) / n + z2 / (4.0 * n * n));
    // Exactly 0 and 1 at the ends, where rounding would leave a residue.
    return {detected == 0 ? 0.0 : centre - half, detected == tested ? 1.0 : centre + half};
}

Interval clopper_pearson_interval(long detected, long tested, double confidence) {
    if (detected < 0 || detected > tested || !(confidence > 0.0 && confidence < 1.0)) {
        throw std::invalid_argument(
            "Clopper-Pearson interval: needs 0 <= detected <= tested and a confidence");
    }
    if (tested == 0) {
        return {kNan, kNan};
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
