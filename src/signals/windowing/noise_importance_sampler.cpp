#include "signals/windowing/noise_importance_sampler.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include "signals/windowing/windowing.hpp"

namespace gearpod::signals {
namespace {

constexpr int kStartsPerMesh = 8;

// Smallest target energy of a quiet stretch, as a fraction of its mean energy.
constexpr double kLeastShare = 0.05;

// Exponents below this add nothing to a density.
constexpr double kNegligibleExponent = -45.0;

}  // namespace

NoiseImportanceSampler::NoiseImportanceSampler(const SpanLayout& layout, int phases, double taper) {
    const std::vector<double> window = tukey_window(phases, taper);
    if (layout.meshes() < 1) {
        throw std::invalid_argument("importance sampling of noise: the span has no meshes");
    }
    const double energy = std::inner_product(window.begin(), window.end(), window.begin(), 0.0);
    length_ = static_cast<std::size_t>(std::max(1L, std::lround(energy)));
    bins_ = static_cast<std::size_t>(layout.planet_teeth) * static_cast<std::size_t>(phases);
    degrees_ = static_cast<double>(length_) * layout.ring_teeth;
    const int spacing = std::max(1, phases / kStartsPerMesh);
    for (int tooth = 0; tooth < layout.planet_teeth; ++tooth) {
        for (int start = 0; start < phases; start += spacing) {
            starts_.push_back(static_cast<std::size_t>(tooth) * static_cast<std::size_t>(phases) +
                              static_cast<std::size_t>(start));
        }
    }
}

std::vector<double> NoiseImportanceSampler::stretch_sums(std::span<const double> bins) const {
    std::vector<double> until(bins_ + 1, 0.0);
    std::partial_sum(bins.begin(), bins.end(), until.begin() + 1);
    std::vector<double> sums;
    sums.reserve(starts_.size());
    for (const std::size_t start : starts_) {
        const std::size_t end = start + length_;
        sums.push_back(end <= bins_ ? until[end] - until[start]
                                    : until[bins_] - until[start] + until[end - bins_]);
    }
    return sums;
}

void NoiseImportanceSampler::load(std::span<const double> folded, std::span<const double> sigmas,
                                  TargetTail towards) {
    if (folded.size() != bins_) {
        throw std::invalid_argument(
            "importance sampling of noise: bins and layout disagree in number");
    }
    squares_ = stretch_sums(folded);
    root_.assign(folded.begin(), folded.end());
    for (double& bin : root_) {
        bin = std::sqrt(bin);
    }
    levels_.clear();
    for (const double sigma : sigmas) {
        if (sigma > 0.0) {
            levels_.push_back(make_level(sigma, towards));
        }
    }
}

NoiseImportanceSampler::Level NoiseImportanceSampler::make_level(double sigma,
                                                                 TargetTail towards) const {
    Level level;
    level.sigma = sigma;
    const std::size_t loudest = static_cast<std::size_t>(
        std::max_element(squares_.begin(), squares_.end()) - squares_.begin());
    const bool loud = towards == TargetTail::loud;
    const double most = squares_[loudest] / (sigma * sigma);
    const double mean = degrees_ + most, deviation = std::sqrt(2.0 * degrees_ + 4.0 * most);
    for (std::size_t s = 0; s < kStrengths.size(); ++s) {
        const double u = loud ? mean + kStrengths[s] * deviation
                              : std::max(kLeastShare * mean, mean - kStrengths[s] * deviation);
        level.energy[s] = u;
        std::vector<Stretch>& stretches = level.stretches[s];
        stretches.resize(squares_.size());
        for (std::size_t c = 0; c < squares_.size(); ++c) {
            if (!loud && c != loudest) {
                continue;
            }
            // u is the mean of the exponentially tilted energy, degrees x + lambda x^2.
            const double lambda = squares_[c] / (sigma * sigma);
            const double x =
                2.0 * u / (degrees_ + std::sqrt(degrees_ * degrees_ + 4.0 * lambda * u));
            const double half = 0.5 * (1.0 - 1.0 / x);
            const double log_moment = 0.5 * degrees_ * std::log(x) + half * x * lambda;
            stretches[c] = {half, x, std::exp(log_moment - half * u)};
            level.bounds[s] += stretches[c].share;
        }
        for (Stretch& stretch : stretches) {
            stretch.share /= level.bounds[s];
        }
    }
    return level;
}

void NoiseImportanceSampler::sample(std::size_t kind, double pick, NoiseVariates& draw) const {
    if (kind == 0 || levels_.empty()) {
        return;
    }
    const double position = pick * static_cast<double>(levels_.size());
    const std::size_t index = std::min(levels_.size() - 1, static_cast<std::size_t>(position));
    const Level& level = levels_[index];
    const std::vector<Stretch>& stretches = level.stretches[kind - 1];
    double left = position - static_cast<double>(index);
    std::size_t c = 0;
    for (std::size_t i = 0; i < stretches.size(); ++i) {
        if (stretches[i].share > 0.0) {
            c = i;
            if (left < stretches[i].share) {
                break;
            }
            left -= stretches[i].share;
        }
    }
    const double x = stretches[c].growth, root = std::sqrt(x);
    for (std::size_t i = 0; i < length_; ++i) {
        const std::size_t b = (starts_[c] + i) % bins_;
        draw.along[b] = (x - 1.0) * root_[b] / level.sigma + root * draw.along[b];
        draw.across[b] *= x;
    }
}

double NoiseImportanceSampler::weight(const NoiseVariates& draw) const {
    if (levels_.empty()) {
        return 1.0;
    }
    std::vector<double> cross(bins_), noise(bins_);
    for (std::size_t b = 0; b < bins_; ++b) {
        cross[b] = draw.along[b] * root_[b];
        noise[b] = draw.along[b] * draw.along[b] + draw.across[b];
    }
    const std::vector<double> crosses = stretch_sums(cross), noises = stretch_sums(noise);
    const double each = 1.0 / static_cast<double>(kKinds);
    double density = each;
    for (const Level& level : levels_) {
        const double of_level = each / static_cast<double>(levels_.size());
        for (std::size_t s = 0; s < kStrengths.size(); ++s) {
            double sum = 0.0;
            for (std::size_t c = 0; c < squares_.size(); ++c) {
                const Stretch& stretch = level.stretches[s][c];
                if (stretch.share > 0.0) {
                    const double q = squares_[c] / (level.sigma * level.sigma) +
                                     2.0 * crosses[c] / level.sigma + noises[c];
                    const double exponent = stretch.tilting_parameter * (q - level.energy[s]);
                    sum += exponent > kNegligibleExponent ? std::exp(exponent) : 0.0;
                }
            }
            density += of_level * sum / level.bounds[s];
        }
    }
    return 1.0 / density;
}

}  // namespace gearpod::signals
