#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/normal.hpp>

#include "signals/noise/sensor_noise.hpp"
#include "tests/numbers.hpp"
#include "tests/signals/noise/kolmogorov.hpp"

namespace gearpod::signals::test_sensor_noise {

struct Moments {
    double mean, variance;
};

Moments moments(const std::vector<double>& sample) {
    const double mean = test::mean_of(sample);
    const auto deviations = test::difference(sample, std::vector<double>(sample.size(), mean));
    return {mean, test::sum_of_squares(deviations) / static_cast<double>(sample.size() - 1)};
}

double transformed(const ChiSquaredTransform& transform, double z) {
    transform.from_normal({&z, 1});
    return z;
}

TEST_CASE("The chi-squared transform gives the quantile of the normal distribution's probability") {
    const boost::math::normal normal;
    for (const int degrees : {2, 3, 17, 80, 111}) {
        const ChiSquaredTransform transform(degrees);
        const boost::math::chi_squared chi(degrees);
        double worst_quantile = 0.0;
        double worst_probability = 0.0;
        for (int i = 0; i <= 4000; ++i) {
            const double z = -9.45 + 18.9 * i / 4000.0;
            const double g = transformed(transform, z);
            const double expected = z < 0.0 ? quantile(chi, cdf(normal, z))
                                            : quantile(complement(chi, cdf(complement(normal, z))));
            worst_quantile = std::max(worst_quantile, std::abs(g / expected - 1.0));
            // Inverse check by the incomplete gamma function itself.
            const double ratio = z < 0.0 ? cdf(chi, g) / cdf(normal, z)
                                         : cdf(complement(chi, g)) / cdf(complement(normal, z));
            worst_probability = std::max(worst_probability, std::abs(ratio - 1.0));
        }
        INFO(degrees << " degrees: quantile " << worst_quantile << ", probability "
                     << worst_probability);
        CHECK(worst_quantile < 1e-10);
        CHECK(worst_probability < 1e-8);
    }
    const ChiSquaredTransform transform(80);
    CHECK(transformed(transform, 10.0) == transformed(transform, 9.5));
    CHECK(transformed(transform, -10.0) == transformed(transform, -9.5));
}

double noisy_bin(double folded, const NoiseVariates& draw, std::size_t b, double sigma) {
    const double along = sigma * draw.along[b] + std::sqrt(folded);
    return along * along + sigma * sigma * draw.across[b];
}

TEST_CASE("A noisy folded bin is distributed as the sum of its noisy samples' squares") {
    constexpr int kTurns = 81;
    constexpr int kSamples = 20000;
    std::mt19937_64 engine(5);
    std::normal_distribution<double> normal;
    std::vector<double> samples(kTurns);
    double folded = 0.0;
    for (double& y : samples) {
        y = 0.3 * normal(engine);
        folded += y * y;
    }
    const double sigma = 0.2;

    std::vector<double> direct(kSamples, 0.0);
    for (double& sum : direct) {
        for (const double y : samples) {
            const double noisy = y + sigma * normal(engine);
            sum += noisy * noisy;
        }
    }
    const SensorNoise noise(kTurns);
    NoiseVariates draw;
    noise.draw(engine, kSamples, draw);
    std::vector<double> shortcut =
        test::tabulated(kSamples, [&](std::size_t b) { return noisy_bin(folded, draw, b, sigma); });

    // Closed forms of mean and variance of the noncentral chi-square law.
    const double mean = folded + kTurns * sigma * sigma;
    const double variance = 2.0 * sigma * sigma * (kTurns * sigma * sigma + 2.0 * folded);
    for (const auto& sample : {direct, shortcut}) {
        CHECK(moments(sample).mean == Approx(mean).margin(4.0 * std::sqrt(variance / kSamples)));
        CHECK(moments(sample).variance ==
              Approx(variance).epsilon(4.5 * std::sqrt(2.0 / kSamples)));
    }
    CHECK(kolmogorov_two(direct, shortcut) < 1.95);
}

TEST_CASE("A reconstructed noisy signal folds to the noisy bins and its noise is white") {
    constexpr int kTurns = 81;
    constexpr std::size_t kBins = 500;
    std::mt19937_64 engine(17);
    std::normal_distribution<double> normal;
    auto signal = test::tabulated(kTurns * kBins, [&](std::size_t) { return normal(engine); });
    for (int i = 0; i < kTurns; ++i) {
        signal[i * kBins] = 0.0;  // a silent bin
    }
    const std::vector<double> folded = test::folded_squares(signal, kBins);
    NoiseVariates draw;
    SensorNoise(kTurns).draw(engine, kBins, draw);
    const double sigma = 0.5;
    std::vector<double> expected =
        test::tabulated(kBins, [&](std::size_t b) { return noisy_bin(folded[b], draw, b, sigma); });
    const std::vector<double> unit = unit_noise(signal, kBins, draw, engine);
    std::vector<double> noisy(signal);
    for (std::size_t i = 0; i < noisy.size(); ++i) {
        noisy[i] += sigma * unit[i];
    }

    CHECK(test::largest_error(test::folded_squares(noisy, kBins), expected) < 1e-12);
    std::vector<double> noise = test::difference(noisy, signal);
    for (double& value : noise) {
        value /= sigma;
    }

    const boost::math::normal standard;
    CHECK(kolmogorov(noise, [&](double x) { return cdf(standard, x); }) < 1.95);
    // Correlations with itself at any lag and with the signal are zero: 4 standard errors of
    // 1/sqrt(n).
    const double limit = 4.0 / std::sqrt(static_cast<double>(noise.size()));
    for (const std::size_t lag : {std::size_t{1}, std::size_t{2}, kBins, 2 * kBins}) {
        double sum = 0.0;
        for (std::size_t i = 0; i + lag < noise.size(); ++i) {
            sum += noise[i] * noise[i + lag];
        }
        CHECK(std::abs(sum / static_cast<double>(noise.size())) < limit);
    }
    const double with_signal = std::inner_product(noise.begin(), noise.end(), signal.begin(), 0.0);
    CHECK(std::abs(with_signal / static_cast<double>(noise.size())) < limit);
}

}  // namespace gearpod::signals::test_sensor_noise
