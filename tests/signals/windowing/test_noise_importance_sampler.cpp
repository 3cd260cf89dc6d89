// Checks means over exponentially tilted, weighted noise against the closed forms of plain noise.
#include <boost/math/distributions/non_central_chi_squared.hpp>

#include "signals/windowing/noise_importance_sampler.hpp"
#include "signals/windowing/windowing.hpp"
#include "tests/test.hpp"

namespace gearpod::signals::test_noise_importance_sampler {

constexpr SpanLayout kLayout{5, 9, 1};
constexpr int kPhases = 24;
constexpr std::size_t kBins = 5 * kPhases;
constexpr double kSigma = 0.7;

// Folded squares in which the third tooth is louder than the others by a factor.
std::vector<double> folded_of(double louder) {
    std::vector<double> folded(kBins);
    for (std::size_t b = 0; b < kBins; ++b) {
        const double wave = 1.0 + 0.5 * std::sin(0.3 * static_cast<double>(b));
        folded[b] = 9.0 * wave * wave * (b / kPhases == 2 ? 1.0 + louder : 1.0);
    }
    return folded;
}

NoiseVariates weighted_noise(const NoiseImportanceSampler& sampler, std::size_t record,
                             std::mt19937_64& engine) {
    static const SensorNoise noise(kLayout.ring_teeth);
    NoiseVariates draw;
    noise.draw(engine, kBins, draw);
    sampler.sample(record % NoiseImportanceSampler::kKinds,
                   std::uniform_real_distribution<double>()(engine), draw);
    return draw;
}

// Mean of weight x indicator and its standard error.
struct Mean {
    double mean = 0.0, error = 0.0;
};
template <class Indicator>
Mean weighted(const NoiseImportanceSampler& sampler, int records, std::uint64_t seed,
              Indicator holds) {
    std::mt19937_64 engine(seed);
    double sum = 0.0, squares = 0.0;
    for (int r = 0; r < records; ++r) {
        const NoiseVariates draw = weighted_noise(sampler, static_cast<std::size_t>(r), engine);
        const double one = holds(draw) ? sampler.weight(draw) : 0.0;
        sum += one;
        squares += one * one;
    }
    const double n = records, mean = sum / n;
    return {mean, std::sqrt((squares / n - mean * mean) / n)};
}

// Energy of a stretch of bins over sigma^2.
double energy(const std::vector<double>& folded, const NoiseVariates& draw, std::size_t first,
              std::size_t length) {
    double sum = 0.0;
    for (std::size_t i = 0; i < length; ++i) {
        const std::size_t b = (first + i) % folded.size();
        const double along = draw.along[b] + std::sqrt(folded[b]) / kSigma;
        sum += along * along + draw.across[b];
    }
    return sum;
}

TEST_CASE(
    "Weighted, exponentially tilted noise has the tail of a noncentral chi-square down to 1e-8") {
    const std::vector<double> folded = folded_of(0.5), sigmas{0.0, kSigma, 2.0 * kSigma};
    NoiseImportanceSampler sampler(kLayout, kPhases, 0.0);  // stretches of a whole mesh period
    sampler.load(folded, sigmas, NoiseImportanceSampler::TargetTail::loud);
    double lambda = 0.0;
    for (std::size_t b = 2 * kPhases; b < 3 * kPhases; ++b) {
        lambda += folded[b] / (kSigma * kSigma);
    }
    const boost::math::non_central_chi_squared law(kPhases * kLayout.ring_teeth, lambda);
    for (const double rate : {0.2, 1e-2, 1e-4, 1e-6, 1e-8}) {
        const double threshold = quantile(complement(law, rate));
        const Mean found = weighted(sampler, 20000, 3, [&](const NoiseVariates& draw) {
            return energy(folded, draw, 2 * kPhases, kPhases) > threshold;
        });
        INFO(rate << ": " << found.mean << " +- " << found.error);
        CHECK(std::abs(found.mean - rate) < 4.0 * found.error);
        CHECK(found.error < 0.15 * rate);
    }
    // The mixture of all is plain noise again.
    const Mean whole = weighted(sampler, 20000, 4, [](const NoiseVariates&) { return true; });
    CHECK(std::abs(whole.mean - 1.0) < 4.0 * whole.error);
    CHECK(whole.error < 0.02);
}

TEST_CASE("Noise exponentially tilted to low energy has the lower tail of the loudest stretch") {
    const std::vector<double> folded = folded_of(0.5), sigmas{kSigma};
    NoiseImportanceSampler sampler(kLayout, kPhases, 0.0);
    sampler.load(folded, sigmas, NoiseImportanceSampler::TargetTail::quiet);
    double lambda = 0.0;
    for (std::size_t b = 2 * kPhases; b < 3 * kPhases; ++b) {
        lambda += folded[b] / (kSigma * kSigma);
    }
    const boost::math::non_central_chi_squared law(kPhases * kLayout.ring_teeth, lambda);
    for (const double rate : {0.2, 1e-2, 1e-4, 1e-6}) {
        const double threshold = quantile(law, rate);
        const Mean found = weighted(sampler, 20000, 5, [&](const NoiseVariates& draw) {
            return energy(folded, draw, 2 * kPhases, kPhases) < threshold;
        });
        INFO(rate << ": " << found.mean << " +- " << found.error);
        CHECK(std::abs(found.mean - rate) < 4.0 * found.error);
        CHECK(found.error < 0.15 * rate);
    }
}

// Largest tooth RMS over the median one, squared, at the best first window.
double ratio(Windowing& windowing, const std::vector<double>& folded, const NoiseVariates& draw) {
    std::vector<double> rms(5);
    windowing.load(folded, draw);
    windowing.search(kSigma, rms);
    std::sort(rms.begin(), rms.end());
    return rms[4] / rms[2];
}

TEST_CASE("Rates of the largest over the median tooth agree with those of counted alarms") {
    const std::vector<double> folded = folded_of(0.0), sigmas{kSigma};
    constexpr double kTaper = 0.2;
    NoiseImportanceSampler sampler(kLayout, kPhases, kTaper);
    sampler.load(folded, sigmas, NoiseImportanceSampler::TargetTail::loud);
    Windowing windowing(kLayout, kPhases, kTaper);
    constexpr int kCounted = 100000;
    std::mt19937_64 engine(7);
    std::vector<double> counted;
    const SensorNoise noise(kLayout.ring_teeth);
    for (int r = 0; r < kCounted; ++r) {
        NoiseVariates draw;
        noise.draw(engine, kBins, draw);
        counted.push_back(ratio(windowing, folded, draw));
    }
    std::sort(counted.begin(), counted.end());
    for (const double rate : {0.05, 1e-2, 1e-3}) {
        const double threshold = counted[static_cast<std::size_t>((1.0 - rate) * kCounted)];
        const Mean found = weighted(sampler, 8000, 8, [&](const NoiseVariates& draw) {
            return ratio(windowing, folded, draw) > threshold;
        });
        INFO(rate << ": " << found.mean << " +- " << found.error);
        CHECK(std::abs(found.mean - rate) <
              4.0 * std::hypot(found.error, std::sqrt(rate / kCounted)));
        CHECK(found.error < 0.15 * rate);
    }
}

TEST_CASE("Without noise there is no tilting, and bins must match the layout") {
    NoiseImportanceSampler sampler(kLayout, kPhases, 0.1);
    const std::vector<double> folded = folded_of(0.0), none{0.0}, few(7);
    sampler.load(folded, none, NoiseImportanceSampler::TargetTail::loud);
    std::mt19937_64 engine(1);
    NoiseVariates draw;
    SensorNoise(kLayout.ring_teeth).draw(engine, kBins, draw);
    const NoiseVariates before = draw;
    sampler.sample(3, 0.5, draw);
    CHECK(draw.along == before.along);
    CHECK(sampler.weight(draw) == 1.0);
    CHECK_THROWS_AS(sampler.load(few, none, NoiseImportanceSampler::TargetTail::loud),
                    std::invalid_argument);
}

}  // namespace gearpod::signals::test_noise_importance_sampler
