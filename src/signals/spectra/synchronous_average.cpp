#include "signals/spectra/synchronous_average.hpp"

#include <cmath>
#include <stdexcept>

namespace gearpod::signals {
namespace {

std::size_t whole_turns(std::span<const double> samples, std::size_t bins) {
    if (bins == 0 || samples.size() < bins) {
        throw std::invalid_argument("synchronous average: the signal is shorter than a turn");
    }
    return samples.size() / bins;
}

}  // namespace

std::vector<double> synchronous_average(std::span<const double> samples, std::size_t bins) {
    const std::size_t turns = whole_turns(samples, bins);
    std::vector<double> mean(bins, 0.0);
    for (std::size_t i = 0; i < turns; ++i) {
        const double* turn = samples.data() + i * bins;
        for (std::size_t b = 0; b < bins; ++b) {
            mean[b] += turn[b];
        }
    }
    for (double& value : mean) {
        value /= static_cast<double>(turns);
    }
    return mean;
}

std::vector<double> fold_of_products(std::span<const double> a, std::span<const double> b,
                                     std::size_t bins) {
    const std::size_t turns = whole_turns(a, bins);
    if (b.size() != a.size()) {
        throw std::invalid_argument("fold of products: the signals differ in length");
    }
    std::vector<double> sum(bins, 0.0);
    for (std::size_t i = 0; i < turns; ++i) {
        for (std::size_t k = 0; k < bins; ++k) {
            sum[k] += a[i * bins + k] * b[i * bins + k];
        }
    }
    return sum;
}

std::vector<double> fold_of_squares(std::span<const double> samples, std::size_t bins) {
    return fold_of_products(samples, samples, bins);
}

double rms_without_average(std::span<const double> samples, std::size_t bins) {
    const std::size_t turns = whole_turns(samples, bins);
    const std::vector<double> mean = synchronous_average(samples, bins);
    double sum = 0.0;
    for (std::size_t i = 0; i < turns; ++i) {
        const double* turn = samples.data() + i * bins;
        double of_turn = 0.0;
        for (std::size_t b = 0; b < bins; ++b) {
            of_turn += (turn[b] - mean[b]) * (turn[b] - mean[b]);
        }
        sum += of_turn;
    }
    return std::sqrt(sum / static_cast<double>(turns * bins));
}

}  // namespace gearpod::signals
