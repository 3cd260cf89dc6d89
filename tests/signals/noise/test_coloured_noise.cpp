#include "signals/noise/coloured_noise.hpp"
#include "signals/noise/sensor_noise.hpp"
#include "signals/spectra/fourier_transform.hpp"
#include "tests/numbers.hpp"

namespace gearpod::signals::test_low_pass_noise {

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

}  // namespace gearpod::signals::test_low_pass_noise

// Checks noise of a given spectrum: its density in and out of band, its variance, and its prefixes.

namespace gearpod::signals::test_shaped_noise {

constexpr double kLowPass_Hz = 800.0;

// Flat from 50 to 300 Hz, then falling as the square of the frequency up to 2400 Hz.
const NoiseSpectrum kSpectrum{{50.0, 300.0, 2400.0}, {0.02, 0.02, 0.02 / 64.0}};

double passed(double f) {
    return 1.0 / (1.0 + std::pow(f / kLowPass_Hz, 8.0));
}

// Mean one-sided density of the samples between two frequencies, (m/s^2)^2 / Hz, from periodograms
// under Hann windows.
double measured_density(double sampling_Hz, double from_Hz, double to_Hz) {
    constexpr int kPoints = 8192, kRecords = 60;
    const ShapedNoise noise(kSpectrum, kLowPass_Hz, sampling_Hz);
    std::mt19937_64 engine(5);
    std::vector<double> samples(static_cast<std::size_t>(kPoints) * kRecords);
    noise.draw(engine, std::span(samples));
    FourierTransform transform(kPoints);
    std::vector<std::complex<double>> record(kPoints), spectrum(kPoints);
    const double rms = kSpectrum.rms_m_s2(kLowPass_Hz);
    double sum = 0.0;
    long lines = 0;
    for (int r = 0; r < kRecords; ++r) {
        for (int i = 0; i < kPoints; ++i) {
            const double hann = 0.5 - 0.5 * std::cos(2.0 * std::numbers::pi * i / kPoints);
            record[static_cast<std::size_t>(i)] =
                hann * rms * samples[static_cast<std::size_t>(r * kPoints + i)];
        }
        transform.transform(record, spectrum);
        for (int k = 1; k < kPoints / 2; ++k) {
            const double f = k * sampling_Hz / kPoints;
            if (f >= from_Hz && f <= to_Hz) {
                constexpr double kWindowPower = 3.0 / 8.0;
                sum += 2.0 * std::norm(spectrum[static_cast<std::size_t>(k)]) /
                       (kWindowPower * kPoints * sampling_Hz);
                ++lines;
            }
        }
    }
    return sum / static_cast<double>(lines);
}

// Mean of the stated density in the band; no frequency folds back into it at these rates.
double stated_density(double from_Hz, double to_Hz) {
    double sum = 0.0;
    constexpr int kParts = 2000;
    for (int i = 0; i < kParts; ++i) {
        const double f = from_Hz + (i + 0.5) / kParts * (to_Hz - from_Hz);
        sum += std::pow(kSpectrum.at(f), 2) * passed(f) / kParts;
    }
    return sum;
}

TEST_CASE("The density of the samples is the stated one in band at any sampling rate") {
    for (const double sampling_Hz : {5000.0, 12'800.0}) {
        for (const auto& [from, to] : {std::pair{60.0, 280.0}, {320.0, 700.0}, {850.0, 1600.0}}) {
            INFO(sampling_Hz << " Hz, " << from << " to " << to << " Hz");
            CHECK(measured_density(sampling_Hz, from, to) ==
                  Approx(stated_density(from, to)).epsilon(0.04));
        }
    }
}

TEST_CASE("There is no noise outside of the given frequencies") {
    const double in_band = stated_density(60.0, 280.0);
    CHECK(measured_density(5000.0, 5.0, 40.0) < 1e-4 * in_band);
    CHECK(measured_density(12'800.0, 3000.0, 6000.0) < 1e-6 * in_band);
}

// At 3 kHz, frequencies from 1.5 to 2.4 kHz fold back onto 1.5 to 0.6 kHz.
TEST_CASE("Frequencies above half the sampling rate fold back") {
    double sum = 0.0;
    constexpr int kParts = 2000;
    for (int i = 0; i < kParts; ++i) {
        const double f = 1200.0 + (i + 0.5) / kParts * 250.0;
        for (const double folded : {f, 3000.0 - f}) {
            sum += std::pow(kSpectrum.at(folded), 2) * passed(folded) / kParts;
        }
    }
    CHECK(measured_density(3000.0, 1200.0, 1450.0) == Approx(sum).epsilon(0.04));
}

TEST_CASE("Samples have variance 1, and the rms is the root of the integrated density") {
    const ShapedNoise noise(kSpectrum, kLowPass_Hz, 5000.0);
    std::mt19937_64 engine(9);
    std::vector<double> samples(1 << 19);
    noise.draw(engine, std::span(samples));
    CHECK(test::sum_of_squares(samples) / static_cast<double>(samples.size()) ==
          Approx(1.0).epsilon(0.02));
    // Without a low-pass: 0.02^2 (250 + 300 (1 - 1/512) / 3).
    CHECK(kSpectrum.rms_m_s2(1e9) ==
          Approx(0.02 * std::sqrt(250.0 + 100.0 * (1.0 - 1.0 / 512.0))).epsilon(1e-9));
}

TEST_CASE("The first samples do not depend on the number of samples") {
    const ShapedNoise noise(kSpectrum, kLowPass_Hz, 5000.0);
    std::vector<double> whole(20'000), part(9'001);
    std::mt19937_64 one(3), other(3);
    noise.draw(one, std::span(whole));
    noise.draw(other, std::span(part));
    CHECK(std::equal(part.begin(), part.end(), whole.begin()));
}

TEST_CASE("Invalid spectra of noise are refused") {
    const auto refuses = [](const NoiseSpectrum& spectrum) {
        CHECK_THROWS_AS(ShapedNoise(spectrum, kLowPass_Hz, 5000.0), std::invalid_argument);
    };
    refuses({{50.0}, {0.1}});
    refuses({{50.0, 40.0}, {0.1, 0.1}});
    refuses({{50.0, 60.0}, {0.1, 0.0}});
    refuses({{50.0, 60.0}, {0.1}});
    CHECK_THROWS_AS(ShapedNoise(kSpectrum, 0.0, 5000.0), std::invalid_argument);
}

}  // namespace gearpod::signals::test_shaped_noise
