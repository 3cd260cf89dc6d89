#include "mc/lives/superposition.hpp"

#include <algorithm>

#include "signals/spectra/synchronous_average.hpp"

namespace gearpod::mc {

ComparedNeeds superposed_needs(std::span<const features::Feature* const> features) {
    using features::BaselineUse;
    ComparedNeeds needs;
    for (const features::Feature* feature : features) {
        const BaselineUse use = feature->baseline_use;
        const bool changes = use == BaselineUse::change || use == BaselineUse::record_and_change;
        if (use != BaselineUse::change) {
            needs.record |= feature->needs;
        }
        if (changes) {
            needs.change |= feature->needs;
        }
        if (use == BaselineUse::baseline || (changes && feature->external)) {
            needs.baseline |= feature->needs;
        }
    }
    return needs;
}

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

SuperposedSignals::SuperposedSignals(std::span<const LaneSignals* const> basis, std::size_t bins,
                                     bool folds)
    : bins_(bins), count_(basis.size()) {
    for (std::size_t k = 0; k < count_; ++k) {
        samples_.emplace_back(basis[k]->sensor);
        te_turns_.push_back(basis[k]->te_turn);
        for (std::size_t l = k; folds && l < count_; ++l) {
            products_.push_back(
                signals::fold_of_products(basis[k]->sensor, basis[l]->sensor, bins));
        }
    }
}

LaneSignals SuperposedSignals::at(std::span<const double> coefficients) const {
    LaneSignals sum;
    sum.folded.assign(products_.empty() ? 0 : bins_, 0.0);
    std::size_t product = 0;
    for (std::size_t k = 0; k < count_; ++k) {
        add(te_turns_[k], coefficients[k], sum.te_turn);
        for (std::size_t l = k; product < products_.size() && l < count_; ++l, ++product) {
            const double twice = k == l ? 1.0 : 2.0;
            add(products_[product], twice * coefficients[k] * coefficients[l], sum.folded);
        }
    }
    // The sum of squares may become negative by rounding.
    for (double& value : sum.folded) {
        value = std::max(0.0, value);
    }
    return sum;
}

// The turns continue periodically.
std::vector<double> SuperposedSignals::turn(std::span<const double> coefficients,
                                            std::size_t number) const {
    const std::size_t begin = number % (samples_.front().size() / bins_) * bins_;
    std::vector<double> sum(bins_, 0.0);
    for (std::size_t k = 0; k < count_; ++k) {
        add(samples_[k].subspan(begin, bins_), coefficients[k], sum);
    }
    return sum;
}

void SuperposedSignals::add_turns(std::span<const double> coefficients, std::size_t first,
                                  std::size_t turns, std::vector<double>& folded) const {
    folded.resize(bins_, 0.0);
    for (std::size_t i = 0; i < turns; ++i) {
        const std::vector<double> one = turn(coefficients, first + i);
        for (std::size_t b = 0; b < bins_; ++b) {
            folded[b] += one[b] * one[b];
        }
    }
}

void SuperposedSignals::append_turns(std::span<const double> coefficients, std::size_t first,
                                     std::size_t turns, std::vector<double>& samples) const {
    samples.reserve(samples.size() + turns * bins_);
    for (std::size_t i = 0; i < turns; ++i) {
        const std::vector<double> one = turn(coefficients, first + i);
        samples.insert(samples.end(), one.begin(), one.end());
    }
}

}  // namespace gearpod::mc
