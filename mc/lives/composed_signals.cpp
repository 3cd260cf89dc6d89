#include "mc/lives/composed_signals.hpp"

#include <algorithm>

#include "signals/spectra/synchronous_average.hpp"

namespace gearpod::mc {
namespace {

void add(std::span<const double> values, double factor, std::vector<double>& sum) {
    if (factor == 0.0 || values.empty()) {
        return;
    }
    sum.resize(values.size(), 0.0);
    for (std::size_t i = 0; i < values.size(); ++i) {
        sum[i] += factor * values[i];
    }
}

}  // namespace

ComposedSignals::ComposedSignals(std::span<const LaneSignals* const> basis, std::size_t bins)
    : count_(basis.size()) {
    for (std::size_t k = 0; k < count_; ++k) {
        te_turns_.push_back(basis[k]->te_turn);
        for (std::size_t l = k; l < count_; ++l) {
            products_.push_back(
                signals::fold_of_products(basis[k]->sensor, basis[l]->sensor, bins));
        }
    }
}

LaneSignals ComposedSignals::at(std::span<const double> coefficients) const {
    LaneSignals sum;
    sum.folded.assign(products_.front().size(), 0.0);
    std::size_t product = 0;
    for (std::size_t k = 0; k < count_; ++k) {
        add(te_turns_[k], coefficients[k], sum.te_turn);
        for (std::size_t l = k; l < count_; ++l, ++product) {
            const double twice = k == l ? 1.0 : 2.0;
            add(products_[product], twice * coefficients[k] * coefficients[l], sum.folded);
        }
    }
    // Squares, but for the rounding of terms that cancel.
    for (double& value : sum.folded) {
        value = std::max(0.0, value);
    }
    return sum;
}

}  // namespace gearpod::mc
