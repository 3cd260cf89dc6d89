#include "stiffness/growth/paris_growth.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

namespace gearpod::stiffness {
namespace {

constexpr int kPanels = 64;
// Gauss-Legendre rule of five points on [-1, 1].
constexpr std::array<double, 5> kNodes{-0.906179845938664, -0.5384693101056831, 0.0,
                                       0.5384693101056831, 0.906179845938664};
constexpr std::array<double, 5> kWeights{0.23692688505618908, 0.47862867049936647,
                                         0.5688888888888889, 0.47862867049936647,
                                         0.23692688505618908};

}  // namespace

ParisLaw paris_law_mm_MPa(double factor, double exponent) {
    return {1e-3 * factor * std::pow(1e-6, exponent), exponent};
}

ParisGrowth::ParisGrowth(const ParisLaw& law, std::function<double(double)> range, double first,
                         double last)
    : law_(law), range_(std::move(range)) {
    if (!(first > 0.0 && last > first && law.factor > 0.0)) {
        throw std::invalid_argument("crack growth: needs 0 < first depth < last depth and C > 0");
    }
    for (int i = 0; i <= kPanels; ++i) {
        depth_.push_back(first * std::pow(last / first, static_cast<double>(i) / kPanels));
        if (!(range_(depth_.back()) > 0.0)) {
            throw std::invalid_argument("crack growth: the load does not open the crack");
        }
        damage_.push_back(i == 0 ? 0.0 : damage_.back() + between(depth_[i - 1U], depth_.back()));
    }
}

double ParisGrowth::rate_inverse(double depth) const {
    return 1.0 / (law_.factor * std::pow(range_(depth), law_.exponent));
}

double ParisGrowth::between(double from, double to) const {
    const double half = 0.5 * (to - from), middle = 0.5 * (to + from);
    double sum = 0.0;
    for (std::size_t i = 0; i < kNodes.size(); ++i) {
        sum += kWeights[i] * rate_inverse(middle + half * kNodes[i]);
    }
    return half * sum;
}

double ParisGrowth::damage_to(double depth) const {
    const double a = std::clamp(depth, depth_.front(), depth_.back());
    const auto next = std::upper_bound(depth_.begin() + 1, depth_.end() - 1, a);
    const auto panel = static_cast<std::size_t>(next - depth_.begin()) - 1;
    return damage_[panel] + between(depth_[panel], a);
}

double ParisGrowth::depth_after(double damage) const {
    if (std::isnan(damage)) {
        return damage;
    }
    if (damage <= 0.0) {
        return depth_.front();
    }
    if (damage >= damage_.back()) {
        return depth_.back();
    }
    const auto next = std::upper_bound(damage_.begin(), damage_.end(), damage);
    const auto panel = static_cast<std::size_t>(next - damage_.begin()) - 1;
    const double remaining_damage = damage - damage_[panel];
    double low = depth_[panel], high = depth_[panel + 1];
    double a = low + (high - low) * remaining_damage / (damage_[panel + 1] - damage_[panel]);
    // Newton's method, with bisection where a step leaves the bracket.
    constexpr int kSteps = 60;
    for (int step = 0; step < kSteps; ++step) {
        const double miss = between(depth_[panel], a) - remaining_damage;
        (miss > 0.0 ? high : low) = a;
        const double newton = a - miss / rate_inverse(a);
        const double better = newton > low && newton < high ? newton : 0.5 * (low + high);
        if (std::abs(better - a) <= 1e-14 * a) {
            return better;
        }
        a = better;
    }
    return a;
}

double ParisGrowth::damage_of(double load, double cycles) const {
    return cycles * std::pow(load, law_.exponent);
}

}  // namespace gearpod::stiffness
