#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "signals/noise/low_pass_noise.hpp"
#include "signals/noise/sensor_noise.hpp"

namespace test_low_pass_noise {

using namespace gearpod;
using namespace gearpod::signals;

namespace {

using std::numbers::pi;

// Integral over f from 0 of cos(2 pi f tau) / (1 + f^8), f in corner frequencies, by the
// trapezoidal rule, which converges exponentially for an even analytic function. The part beyond 20
// corner frequencies is 1e-10.
double spectrum_integral(double tau) {
    constexpr double kStep = 0.02;
    double sum = 0.5;
    for (int i = 1; i <= 1000; ++i) {
        const double f = i * kStep, square = f * f;
        sum += std::cos(2.0 * pi * f * tau) / (1.0 + square * square * square * square);
    }
    return sum * kStep;
}

// Response of each sample to each independent normal: [normal][sample].
std::vector<std::vector<double>> responses(const LowPassNoise& noise, std::size_t samples) {
    std::vector<std::vector<double>> all;
    for (std::size_t i = 0; i < samples; ++i) {
        std::vector<double> one(samples, 0.0);
        one[i] = 1.0;
        noise.colour(one);
        all.push_back(std::move(one));
    }
    return all;
}

std::vector<double> normals(std::size_t count, unsigned seed) {
    std::mt19937_64 engine(seed);
    std::vector<double> values(count);
    draw_normals(engine, values);
    return values;
}

TEST_CASE("The noise bandwidth of the low-pass is the integral of its squared gain") {
    CHECK(low_pass_noise_bandwidth_Hz(800.0) ==
          Approx(800.0 * spectrum_integral(0.0)).epsilon(1e-9));
}

// The covariance of any two samples, including the first ones, is the spectrum's transform (Wiener,
// Khinchin). The sampled spectrum therefore has its aliases like a sampled signal.
TEST_CASE("Samples of low-pass noise have the covariance of the filtered white noise") {
    constexpr std::size_t kSamples = 130;
    for (const double per_sample : {0.45, 800.0 / 2048.0, 0.16, 0.06, 0.02}) {
        INFO(per_sample);
        const auto response = responses(LowPassNoise(per_sample), kSamples);
        double worst = 0.0;
        for (const std::size_t first : {0u, 1u, 5u, 47u, 60u}) {
            for (std::size_t lag = 0; lag < 40; ++lag) {
                double covariance = 0.0;
                for (const auto& of_normal : response) {
                    covariance += of_normal[first] * of_normal[first + lag];
                }
                const double expected = spectrum_integral(per_sample * static_cast<double>(lag)) /
                                        spectrum_integral(0.0);
                worst = std::max(worst, std::abs(covariance - expected));
            }
        }
        CHECK(worst < 2e-8);
    }
}

TEST_CASE("Low-pass noise begins with the same values for any length") {
    const LowPassNoise noise(0.16);
    std::mt19937_64 one(3), other(3);
    std::vector<double> shorter(1003), longer(5000);
    noise.draw(one, shorter);
    noise.draw(other, longer);
    CHECK(std::equal(shorter.begin(), shorter.end(), longer.begin()));
}

TEST_CASE("Low-pass noise at too high a sampling rate is refused") {
    CHECK_THROWS_AS(LowPassNoise(0.001), std::invalid_argument);
    CHECK_THROWS_AS(LowPassNoise(0.0), std::invalid_argument);
}

TEST_CASE("Random noise of any colour folds as the noisy signal does, at every level") {
    constexpr std::size_t kBins = 24, kTurns = 17;
    std::vector<double> signal = normals(kBins * kTurns, 1), noise = normals(kBins * kTurns, 2);
    LowPassNoise(0.1).colour(noise);
    for (std::size_t i = 0; i < signal.size(); i += kBins) {
        signal[i] = 0.0;  // a bin without signal
    }
    const NoiseVariates draw = noise_variates_of_samples(signal, noise, kBins);
    for (const double sigma : {0.0, 0.3, 2.0}) {
        for (std::size_t b = 0; b < kBins; ++b) {
            double clean = 0.0, noisy = 0.0;
            for (std::size_t i = b; i < signal.size(); i += kBins) {
                clean += signal[i] * signal[i];
                noisy += (signal[i] + sigma * noise[i]) * (signal[i] + sigma * noise[i]);
            }
            const double along = sigma * draw.along[b] + std::sqrt(clean);
            CHECK(along * along + sigma * sigma * draw.across[b] ==
                  Approx(noisy).epsilon(1e-12).margin(1e-12));
        }
    }
}

}  // namespace

}  // namespace test_low_pass_noise
