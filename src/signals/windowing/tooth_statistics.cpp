#include "signals/windowing/tooth_statistics.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <stdexcept>

namespace gearpod::signals {
namespace {

struct Moments {
    double rms, kurtosis, crest, m8a;
};

Moments moments_of(std::span<const double> values) {
    const auto count = static_cast<double>(values.size());
    double sum = 0.0, squares = 0.0, peak = 0.0;
    for (const double v : values) {
        sum += v;
        squares += v * v;
        peak = std::max(peak, std::abs(v));
    }
    const double mean = sum / count;
    double second = 0.0, fourth = 0.0, eighth = 0.0;
    for (const double v : values) {
        const double d2 = (v - mean) * (v - mean);
        const double d4 = d2 * d2;
        second += d2;
        fourth += d4;
        eighth += d4 * d4;
    }
    second /= count;
    const double rms = std::sqrt(squares / count);
    return {rms, fourth / count / (second * second), peak / rms,
            eighth / count / (second * second * second * second)};
}

}  // namespace

GearTurns fewest_turns(int teeth, int carrier_meshes) {
    return {teeth, carrier_meshes / std::gcd(teeth, carrier_meshes)};
}

GearTurns turns_of_span(int teeth, int carrier_meshes, int meshes) {
    const GearTurns fewest = fewest_turns(teeth, carrier_meshes);
    return {teeth, meshes / fewest.meshes() * fewest.turns};
}

ToothStatistics tooth_statistics(std::span<const double> samples, const GearTurns& gear,
                                 std::span<const double> window, int offset) {
    const std::size_t phases = window.size();
    const std::size_t all = static_cast<std::size_t>(gear.meshes()) * phases;
    if (gear.meshes() < 1 || phases < 2 || samples.size() < all || offset < 0 ||
        static_cast<std::size_t>(offset) >= phases) {
        throw std::invalid_argument("tooth signals: span, window and offset disagree");
    }
    ToothStatistics result;
    std::vector<double> tooth(static_cast<std::size_t>(gear.turns) * phases);
    for (int j = 0; j < gear.teeth; ++j) {
        auto out = tooth.begin();
        for (int i = 0; i < gear.turns; ++i) {
            const std::size_t mesh = static_cast<std::size_t>(i) * gear.teeth + j;
            const std::size_t first = mesh * phases + static_cast<std::size_t>(offset);
            for (std::size_t m = 0; m < phases; ++m) {
                const std::size_t sample = first + m < all ? first + m : first + m - all;
                *out++ = window[m] * samples[sample];
            }
        }
        const Moments moments = moments_of(tooth);
        result.rms.push_back(moments.rms);
        result.kurtosis.push_back(moments.kurtosis);
        result.crest.push_back(moments.crest);
        result.m8a.push_back(moments.m8a);
    }
    return result;
}

void remove_path_trend(std::span<double> values, int orders) {
    constexpr double kLeastShare = 0.01;
    const std::size_t teeth = values.size();
    const auto count = static_cast<double>(teeth);
    std::vector<double> trend(teeth, 0.0);
    // Orders below half the number of teeth are orthogonal, so the least-squares fit is their
    // Fourier sum.
    const int highest = std::min(orders, (static_cast<int>(teeth) - 1) / 2);
    for (int k = 0; k <= highest; ++k) {
        const auto angle = [&](std::size_t j) {
            return 2.0 * std::numbers::pi * static_cast<double>(j * k % teeth) / count;
        };
        double sine = 0.0, cosine = 0.0;
        for (std::size_t j = 0; j < teeth; ++j) {
            sine += values[j] * std::sin(angle(j));
            cosine += values[j] * std::cos(angle(j));
        }
        const double scale = (k == 0 ? 1.0 : 2.0) / count;
        for (std::size_t j = 0; j < teeth; ++j) {
            trend[j] += scale * (sine * std::sin(angle(j)) + cosine * std::cos(angle(j)));
        }
    }
    const double mean = std::accumulate(trend.begin(), trend.end(), 0.0) / count;
    for (std::size_t j = 0; j < teeth; ++j) {
        values[j] /= std::max(trend[j], kLeastShare * mean);
    }
}

}  // namespace gearpod::signals
