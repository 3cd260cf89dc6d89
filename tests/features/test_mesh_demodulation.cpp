// Checks FM0 and the demodulation of the strongest mesh harmonic against known modulations.
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <vector>

#include "features/feature.hpp"
#include "features/modulation_indicators.hpp"
#include "features/vibration_statistics.hpp"
#include "signals/spectra/order_spectrum.hpp"

namespace test_mesh_demodulation {

using namespace gearpod;
using namespace gearpod::features;

namespace {

constexpr int kTeeth = 31, kPerMesh = 16, kPoints = kTeeth * kPerMesh;

// Averaged turn x(angle), angle from 0 to 2 pi, with the parts that features use.
struct Turn {
    template <class Function>
    explicit Turn(const Function& x) {
        for (int i = 0; i < kPoints; ++i) {
            samples.push_back(x(2.0 * std::numbers::pi * i / kPoints));
        }
        parts.load(samples);
        sensor.turn = samples;
        sensor.amplitude = parts.amplitude();
        sensor.mesh_order = kTeeth;
    }
    std::vector<double> samples;
    signals::MeshSeparation parts{kPoints, kTeeth};
    SensorTurn sensor;
};

TEST_CASE("FM0 of one mesh line is 2, and a shock of 3 amplitudes at its peak adds 3") {
    const auto mesh = [](double t) { return 0.4 * std::cos(kTeeth * t); };
    CHECK(fm0(Turn(mesh).sensor) == Approx(2.0));
    // The shock raises every mesh line by up to 2/n of itself.
    const Turn shock([&](double t) { return mesh(t) + (t == 0.0 ? 1.2 : 0.0); });
    const double lines = 0.4 + 7.0 * 2.0 / kPoints * 1.2;
    CHECK(fm0(shock.sensor) == Approx(2.0 / lines));
}

TEST_CASE("Known amplitude and phase modulations of the strongest harmonic are recovered") {
    // Band-limited amplitude modulation of depth 0.3, and phase modulation of 0.2 rad, of the third
    // mesh harmonic; the weaker first harmonic has none.
    constexpr double kDepth = 0.3, kPhase = 0.2;
    for (const double gain : {1e-6, 1.0, 1e6}) {
        const Turn amplitude([&](double t) {
            return gain * ((1.0 + kDepth * std::cos(2.0 * t)) * std::cos(3 * kTeeth * t + 0.7) +
                           0.5 * std::cos(kTeeth * t) + 4.0);
        });
        CHECK(amplitude_modulation(amplitude.sensor) == Approx(kDepth).epsilon(1e-9));
        CHECK(phase_modulation(amplitude.sensor) == Approx(0.0).margin(1e-9));
        const Turn phase([&](double t) {
            return gain * (std::cos(3 * kTeeth * t + kPhase * std::cos(2.0 * t)) +
                           0.5 * std::cos(kTeeth * t));
        });
        CHECK(amplitude_modulation(phase.sensor) == Approx(0.0).margin(1e-9));
        CHECK(phase_modulation(phase.sensor) == Approx(2.0 * kPhase).epsilon(1e-9));
    }
}

TEST_CASE("Phases beyond pi are unwrapped") {
    const Turn wide([](double t) { return std::cos(kTeeth * t + 2.5 * std::cos(t)); });
    // The Bessel sidebands beyond order 15 are below 1e-10.
    CHECK(phase_modulation(wide.sensor) == Approx(5.0).epsilon(1e-8));
}

TEST_CASE("Signals without mesh lines have no FM0 and no modulation") {
    const Turn other([](double t) { return 7.0 + std::cos(5.0 * t); });
    const Turn zero([](double) { return 0.0; });
    for (const SensorTurn* turn : {&other.sensor, &zero.sensor}) {
        CHECK(std::isnan(fm0(*turn)));
        CHECK(std::isnan(amplitude_modulation(*turn)));
        CHECK(std::isnan(phase_modulation(*turn)));
    }
    for (const char* name : {"fm0", "amplitude_modulation", "phase_modulation"}) {
        CHECK(find_feature(name)->from_sensor);
        CHECK(!find_feature(name)->basic());
    }
}

}  // namespace

}  // namespace test_mesh_demodulation
