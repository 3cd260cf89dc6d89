#include "signals/prediction/periodic_signal.hpp"

#include <algorithm>

namespace gearpod::signals {
namespace {

constexpr double kWhiteNoiseCorrection = 1e-9;

}  // namespace

PeriodicSignal::PeriodicSignal(std::span<const double> samples)
    : forward_(static_cast<int>(samples.size())),
      backward_(forward_.points(), FourierTransform::Direction::back),
      values_(samples.size()),
      product_(samples.size()) {
    transform(samples);
    spectrum_ = product_;
}

std::vector<double> PeriodicSignal::corrected_autocorrelation(std::size_t lags) {
    for (std::size_t k = 0; k < product_.size(); ++k) {
        product_[k] = std::norm(spectrum_[k]) / static_cast<double>(product_.size());
    }
    std::vector<double> r = signal(lags);
    r[0] *= 1.0 + kWhiteNoiseCorrection;
    return r;
}

std::vector<double> PeriodicSignal::filtered(std::span<const double> filter) {
    transform(filter);
    for (std::size_t k = 0; k < product_.size(); ++k) {
        product_[k] *= spectrum_[k];
    }
    return signal(product_.size());
}

std::vector<double> PeriodicSignal::correlated(std::span<const double> y, std::size_t lags) {
    transform(y);
    for (std::size_t k = 0; k < product_.size(); ++k) {
        product_[k] *= std::conj(spectrum_[k]) / static_cast<double>(product_.size());
    }
    return signal(lags);
}

void PeriodicSignal::transform(std::span<const double> values) {
    std::fill(std::copy(values.begin(), values.end(), values_.begin()), values_.end(), 0.0);
    forward_.transform(values_, product_);
}

std::vector<double> PeriodicSignal::signal(std::size_t count) {
    backward_.transform(product_, values_);
    std::vector<double> result(count);
    for (std::size_t i = 0; i < count; ++i) {
        result[i] = values_[i].real() / static_cast<double>(values_.size());
    }
    return result;
}

}  // namespace gearpod::signals
