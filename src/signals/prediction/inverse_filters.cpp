#include "signals/prediction/inverse_filters.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "machine/contracts.hpp"

namespace gearpod::signals {

std::vector<double> solve_toeplitz(std::span<const double> r, std::span<const double> b) {
    EXPECTS(!r.empty() && r.size() == b.size());
    // `predictor`: 1, a_1, ..., a_m of the prediction error filter of order m.
    std::vector<double> predictor{1.0}, solution{b[0] / r[0]};
    double error = r[0];
    for (std::size_t m = 1; m < r.size(); ++m) {
        double mismatch = 0.0;
        for (std::size_t j = 0; j < m; ++j) {
            mismatch += predictor[j] * r[m - j];
        }
        const double reflection = -mismatch / error;
        std::vector<double> next(m + 1, 0.0);
        for (std::size_t j = 0; j <= m; ++j) {
            next[j] = (j < m ? predictor[j] : 0.0) + (j > 0 ? reflection * predictor[m - j] : 0.0);
        }
        predictor = std::move(next);
        error *= 1.0 - reflection * reflection;
        double remainder = b[m];
        for (std::size_t j = 0; j < m; ++j) {
            remainder -= r[m - j] * solution[j];
        }
        const double step = remainder / error;
        solution.push_back(0.0);
        for (std::size_t j = 0; j <= m; ++j) {
            solution[j] += step * predictor[m - j];
        }
    }
    return solution;
}

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
    EXPECTS(y.size() == values_.size());
    transform(y);
    for (std::size_t k = 0; k < product_.size(); ++k) {
        product_[k] *= std::conj(spectrum_[k]) / static_cast<double>(product_.size());
    }
    return signal(lags);
}

void PeriodicSignal::transform(std::span<const double> values) {
    EXPECTS(values.size() <= values_.size());
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

namespace {

void scale_to_unit_rms(std::vector<double>& values) {
    const double sum = std::inner_product(values.begin(), values.end(), values.begin(), 0.0);
    const double rms = std::sqrt(sum / static_cast<double>(values.size()));
    for (double& value : values) {
        value /= rms;
    }
}

}  // namespace

std::vector<double> deconvolve(std::span<const double> x, std::size_t length, int iterations) {
    EXPECTS(length > 0 && std::ranges::any_of(x, [](double value) { return value != 0.0; }));
    PeriodicSignal signal(x);
    const std::vector<double> r = signal.corrected_autocorrelation(length);
    std::vector<double> impulse(length, 0.0);
    impulse[length / 2] = 1.0;
    std::vector<double> y = signal.filtered(impulse);
    for (int round = 0; round < iterations; ++round) {
        scale_to_unit_rms(y);
        for (double& value : y) {
            value = value * value * value;
        }
        y = signal.filtered(solve_toeplitz(r, signal.correlated(y, length)));
    }
    return y;
}

Prewhitening::Prewhitening(int points)
    : forward_(points),
      backward_(points, FourierTransform::Direction::back),
      spectrum_(static_cast<std::size_t>(points)) {
    EXPECTS(points >= 1);
}

std::vector<double> Prewhitening::whitened(std::span<const double> samples) {
    constexpr double kRoundingPower = 1e-24;  // of the largest squared magnitude
    values_.assign(samples.begin(), samples.end());
    forward_.transform(values_, spectrum_);
    double largest = 0.0;
    for (const auto& value : spectrum_) {
        largest = std::max(largest, std::norm(value));
    }
    const auto scale = 1.0 / static_cast<double>(samples.size());
    spectrum_[0] = 0.0;
    for (auto& value : spectrum_) {
        const double square = std::norm(value);
        value = square > kRoundingPower * largest ? scale / std::sqrt(square) * value : 0.0;
    }
    backward_.transform(spectrum_, values_);
    std::vector<double> white(samples.size());
    for (std::size_t i = 0; i < white.size(); ++i) {
        white[i] = values_[i].real();
    }
    return white;
}

}  // namespace gearpod::signals
