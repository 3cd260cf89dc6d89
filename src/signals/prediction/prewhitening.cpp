#include "signals/prediction/prewhitening.hpp"

#include <algorithm>
#include <cmath>

#include "machine/contracts.hpp"

namespace gearpod::signals {

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
