// Checks additional sensors with a sampling rate of their own: samples, folded tones, noise. The
// closed form of sampling is in tests/signals/path/test_frequency_response.cpp.
#include <fmt/format.h>

#include <cmath>
#include <complex>
#include <numbers>

#include "tests/mc/ensemble/gearbox/chain_signals.hpp"

namespace test_own_rate {

using namespace gearpod;
using namespace gearpod::test;

namespace {

constexpr double kPi = std::numbers::pi;

}  // namespace

TEST_CASE("A sampling rate of its own keeps the samples that the converter takes") {
    const Folder folder;
    const double sample_s = signals_of_small(folder, "").at("time")[1];
    const auto rate = fmt::format(", low_pass_Hz=50, sampling_Hz={}", 0.5 / sample_s);
    const std::string tone = "--set 'sensor.tones=[{frequency_Hz=61.3, amplitude_m_s2=0.7}]'";
    const auto all = signals_of_small(folder, side("noise=1, low_pass_Hz=50") + tone),
               own = signals_of_small(folder, side("noise=1" + rate) + tone);
    const std::vector<double>&before = all.at("sensor_side"), &after = own.at("sensor_side");
    REQUIRE(after.size() % 2 == 0);
    double largest_change = 0.0;
    for (std::size_t i = 0; i < after.size(); i += 2) {
        REQUIRE(after[i] == Approx(before[i]).margin(1e-9));
        largest_change = std::max(largest_change, std::abs(after[i + 1] - before[i + 1]));
    }
    CHECK(largest_change > 1e-3);  // aliases
}

TEST_CASE("A tone above half the sampling rate of a sensor has the folded frequency") {
    const Folder folder;
    const auto columns = signals_of_small(
        folder, kSilent + side("low_pass_Hz=40, sampling_Hz=100") +
                    "--set 'sensor.tones=[{frequency_Hz=61.3, amplitude_m_s2=0.7}]'");
    const std::vector<double>&own = columns.at("sensor_side"), &time = columns.at("time");
    const double length_s = time[1] * static_cast<double>(own.size());
    const double rate_Hz = std::round(100.0 * length_s) / length_s;
    const double angle = 2.0 * kPi * (rate_Hz - 61.3) * time[1];
    // x_i+1 + x_i-1 = 2 cos(angle) x_i holds for that sine alone.
    double square = 0.0;
    for (std::size_t i = 1; i + 1 < own.size(); ++i) {
        REQUIRE(own[i + 1] + own[i - 1] == Approx(2.0 * std::cos(angle) * own[i]).margin(1e-9));
        square += own[i] * own[i];
    }
    const auto gain = [](double f_Hz) { return 1.0 / std::sqrt(1.0 + std::pow(f_Hz, 8.0)); };
    CHECK(std::sqrt(2.0 * square / static_cast<double>(own.size())) ==
          Approx(0.7 * gain(61.3 / 40.0) / gain(61.3 / kLowPass_Hz)).epsilon(0.01));
}

TEST_CASE("Noise of a sensor lies below half its sampling rate, with the stated variance") {
    const Folder folder;
    const auto check = [&](const std::string& fields, const std::string& options, double rms) {
        const auto columns =
            signals_of_small(folder, side(fields + ", low_pass_Hz=40, sampling_Hz=100") + options);
        INFO(fields << options);
        CHECK(noise_rms(columns, "sensor_side") == Approx(rms).epsilon(0.08));
        std::vector<double> noise = columns.at("sensor_side_noise_1");
        for (std::size_t i = 0; i < noise.size(); ++i) {
            noise[i] -= columns.at("sensor_side")[i];
        }
        const double step_Hz = 1.0 / (columns.at("time")[1] * static_cast<double>(noise.size()));
        const auto power = [&](double from_Hz, double to_Hz) {
            double sum = 0.0;
            for (auto k = static_cast<std::size_t>(std::ceil(from_Hz / step_Hz));
                 k < static_cast<std::size_t>(to_Hz / step_Hz); ++k) {
                sum += 2.0 * std::norm(component(noise, k));
            }
            return sum;
        };
        const double below = power(1.0, 35.0);
        CHECK(power(50.2, 70.0) < 1e-15 * below);
        return below / 34.0;  // density
    };
    // White noise of the same variance in less than half the bandwidth.
    CHECK(check("noise=2", "--set sensor.noise_m_s2=0.05", 0.1) ==
          Approx(0.01 / 50.0).epsilon(0.15));
    CHECK(check("quantisation_m_s2=1", "--set sensor.noise_m_s2=0", std::sqrt(1.0 / 12.0)) ==
          Approx(1.0 / 12.0 / 50.0).epsilon(0.15));
    // Filtered noise keeps its density where the low-pass passes it.
    CHECK(check("noise=1",
                "--set sensor.noise_m_s2=0 --set sensor.noise_density_m_s2_per_sqrt_Hz=0.01",
                0.01 * std::sqrt(kBandwidth * 40.0)) == Approx(1e-4).epsilon(0.15));
}

}  // namespace test_own_rate
