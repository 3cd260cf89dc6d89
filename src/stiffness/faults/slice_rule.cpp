#include "stiffness/faults/slice_rule.hpp"

#include <algorithm>
#include <array>
#include <boost/math/quadrature/gauss.hpp>

namespace gearpod::stiffness {

namespace {

constexpr int kSlicePoints = 8;
using Rule = boost::math::quadrature::gauss<double, kSlicePoints>;

// Gauss abscissas on [-1, 1], ascending, and weights.
struct GaussPoints {
    std::array<double, kSlicePoints> at, weight;
    GaussPoints() {
        for (int i = 0; i < kSlicePoints / 2; ++i) {
            at[kSlicePoints / 2 + i] = Rule::abscissa()[i];
            at[kSlicePoints / 2 - 1 - i] = -Rule::abscissa()[i];
            weight[kSlicePoints / 2 + i] = weight[kSlicePoints / 2 - 1 - i] = Rule::weights()[i];
        }
    }
};
const GaussPoints kGauss;

// Legendre polynomials P_0 .. P_n at x.
std::array<double, kSlicePoints + 1> legendre(double x) {
    std::array<double, kSlicePoints + 1> p{1, x};
    for (int k = 1; k < kSlicePoints; ++k)
        p[k + 1] = ((2 * k + 1) * x * p[k] - k * p[k - 1]) / (k + 1);
    return p;
}

double zero_between(const std::function<double(double)>& f, double low, double high) {
    const bool rises = f(high) > 0;
    for (int halving = 0; halving < 50; ++halving) {
        const double middle = 0.5 * (low + high);
        ((f(middle) > 0) == rises ? high : low) = middle;
    }
    return 0.5 * (low + high);
}

}  // namespace

SliceRule::SliceRule(int slices) : panels_((slices + kSlicePoints - 1) / kSlicePoints) {
    for (std::size_t panel = 0; panel < panels_; ++panel)
        for (const double x : kGauss.at)
            points_.push_back((static_cast<double>(panel) + 0.5 * (1 + x)) /
                              static_cast<double>(panels_));
}

void SliceRule::whole(std::span<double> weights) const {
    for (std::size_t i = 0; i < points_.size(); ++i)
        weights[i] = 0.5 * kGauss.weight[i % kSlicePoints] / static_cast<double>(panels_);
}

void SliceRule::where(const std::function<double(double)>& seen, int samples,
                      std::span<double> weights) const {
    std::fill(weights.begin(), weights.end(), 0.0);
    const int per_panel = std::max(1, samples / static_cast<int>(panels_));
    for (std::size_t panel = 0; panel < panels_; ++panel) {
        double here = static_cast<double>(panel) / static_cast<double>(panels_);
        double value = seen(here);
        for (int sample = 1; sample <= per_panel; ++sample) {
            const double next =
                (static_cast<double>(panel) + static_cast<double>(sample) / per_panel) /
                static_cast<double>(panels_);
            const double following = seen(next);
            const double cut =
                (value > 0) != (following > 0) ? zero_between(seen, here, next) : next;
            if (value > 0)
                add_part(panel, here, cut, weights);
            else if (following > 0)
                add_part(panel, cut, next, weights);
            here = next;
            value = following;
        }
    }
}

void SliceRule::add_part(std::size_t panel, double from, double to,
                         std::span<double> weights) const {
    const double scale = static_cast<double>(panels_), first = static_cast<double>(panel);
    const auto low = legendre(2 * (from * scale - first) - 1);
    const auto high = legendre(2 * (to * scale - first) - 1);
    for (int i = 0; i < kSlicePoints; ++i) {
        // Coefficient k of the interpolant is (2 k + 1) / 2 sum_i weight P_k f. The integral of P_k
        // is (P_(k+1) - P_(k-1)) / (2 k + 1).
        const auto at = legendre(kGauss.at[i]);
        double sum = high[1] - low[1];
        for (int k = 1; k < kSlicePoints; ++k)
            sum += at[k] * ((high[k + 1] - high[k - 1]) - (low[k + 1] - low[k - 1]));
        weights[panel * kSlicePoints + i] += 0.5 * kGauss.weight[i] * sum / (2 * scale);
    }
}

}  // namespace gearpod::stiffness
