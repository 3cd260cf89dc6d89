// Checks the spectral kurtosis of noise, tones and impulses against closed forms.
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "features/feature.hpp"
#include "features/spectral_kurtosis.hpp"

namespace test_spectral_kurtosis {

using namespace gearpod;
using namespace gearpod::features;

namespace {

double kurtosis_of(const std::vector<double>& residual, int teeth) {
    SensorTurn sensor;
    sensor.residual = residual;
    sensor.mesh_order = teeth;
    return spectral_kurtosis(sensor);
}

std::vector<double> noise(std::size_t points) {
    std::mt19937_64 engine(21);
    std::normal_distribution<double> normal(0.0, 3.0);
    std::vector<double> values(points);
    for (double& value : values) {
        value = normal(engine);
    }
    return values;
}

TEST_CASE("Stationary Gaussian noise has a spectral kurtosis of 0") {
    // 20000 frames: a band scatters by 0.014; the largest of 15 bands is less than 4 of these off.
    CHECK(kurtosis_of(noise(10000 * 32), 10000) == Approx(0.0).margin(0.06));
}

TEST_CASE("A tone has a spectral kurtosis of -1") {
    constexpr int kTeeth = 20, kPoints = 32;
    std::vector<double> tone;
    for (int i = 0; i < kTeeth * kPoints; ++i) {
        tone.push_back(1e-3 * std::cos(2.0 * std::numbers::pi * 5.0 * i / kPoints + 0.3));
    }
    CHECK(kurtosis_of(tone, kTeeth) == Approx(-1.0).epsilon(1e-9));
}

TEST_CASE("A train of impulses has the ratio of frames to impulses, less 2") {
    constexpr std::size_t kTeeth = 20, kPoints = 16;
    for (const std::size_t impulses : {1U, 2U, 10U}) {
        std::vector<double> train(kTeeth * kPoints, 0.0);
        for (std::size_t j = 0; j < impulses; ++j) {  // in the middle of a frame, at the window's 1
            train[j * train.size() / impulses + kPoints / 2] = -7.0;
        }
        const double frames = 2.0 * kTeeth;
        CHECK(kurtosis_of(train, kTeeth) == Approx(frames / static_cast<double>(impulses) - 2.0));
    }
}

TEST_CASE("An impulse in noise raises the spectral kurtosis, whatever the scale") {
    std::vector<double> signal = noise(40 * 32);
    const double healthy = kurtosis_of(signal, 40);
    signal[333] += 60.0;
    const double faulty = kurtosis_of(signal, 40);
    CHECK(faulty > healthy + 5.0);
    for (double& value : signal) {
        value *= 1e4;
    }
    CHECK(kurtosis_of(signal, 40) == Approx(faulty));
}

TEST_CASE("An odd number of samples per mesh period gives frames of this length") {
    using std::numbers::pi;
    std::vector<double> train(21 * 7, 0.0);
    train[4] = 1.0;  // sample 4 of frame 0, and sample 1 of frame 1, which starts at 3
    const double first = std::pow(0.5 + 0.5 * std::cos(pi / 7), 2);  // power in each frame
    const double second = std::pow(0.5 - 0.5 * std::cos(2 * pi / 7), 2);
    CHECK(kurtosis_of(train, 21) ==
          Approx(42.0 * (first * first + second * second) / std::pow(first + second, 2) - 2.0));
}

TEST_CASE("Spectral kurtosis needs the averaged sensor signal and is not a default feature") {
    const Feature& feature = *find_feature("spectral_kurtosis");
    CHECK(feature.needs.has<SensorTurn>());
    CHECK(feature.from_sensor);
    CHECK(!feature.basic());
    CHECK(std::isnan(kurtosis_of(std::vector<double>(640, 0.0), 20)));
}

}  // namespace

}  // namespace test_spectral_kurtosis
