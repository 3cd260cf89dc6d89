#include "signals/noise/sensor_noise.hpp"

#include <numeric>

#include "signals/spectra/synchronous_average.hpp"

namespace gearpod::signals {
namespace {

double dot(std::span<const double> a, std::span<const double> b) {
    return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
}

}  // namespace

void noise_of_bin(std::span<const double> samples, double along, double across,
                  std::span<const double> normals, std::span<double> noise) {
    const std::size_t turns = samples.size();
    if (turns < 2 || normals.size() != turns || noise.size() != turns) {
        throw std::invalid_argument("noise of a bin: samples and normals disagree in number");
    }
    // Direction of the samples. Any direction is valid where they are all zero.
    std::vector<double> direction(samples.begin(), samples.end());
    double length = std::sqrt(dot(direction, direction));
    if (length == 0.0) {
        direction[0] = 1.0;
        length = 1.0;
    }
    for (double& d : direction) {
        d /= length;
    }
    std::vector<double> side(normals.begin(), normals.end());
    // the second pass removes the rounding error of the first
    for (int pass = 0; pass < 2; ++pass) {
        const double parallel = dot(side, direction);
        for (std::size_t i = 0; i < turns; ++i) {
            side[i] -= parallel * direction[i];
        }
    }
    const double scale = std::sqrt(across / dot(side, side));
    for (std::size_t i = 0; i < turns; ++i) {
        noise[i] = along * direction[i] + scale * side[i];
    }
}

NoiseVariates noise_variates_of_samples(std::span<const double> signal,
                                        std::span<const double> noise, std::size_t bins) {
    const std::vector<double> squares = fold_of_squares(signal, bins);
    NoiseVariates draw{fold_of_products(signal, noise, bins), fold_of_squares(noise, bins)};
    for (std::size_t b = 0; b < bins; ++b) {
        draw.along[b] = squares[b] > 0.0 ? draw.along[b] / std::sqrt(squares[b]) : 0.0;
        draw.across[b] = std::max(0.0, draw.across[b] - draw.along[b] * draw.along[b]);
    }
    return draw;
}

}  // namespace gearpod::signals
