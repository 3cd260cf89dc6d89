// Checks the response of the housing against closed forms: a sensor on a resonant mounting, a
// measured response, and loads that move along an elastic ring.
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <vector>

#include "signals/path/housing_response.hpp"
#include "signals/path/transmission_path.hpp"
#include "signals/sensor/sensor.hpp"

namespace test_housing_response {

using namespace gearpod;
using namespace gearpod::signals;

namespace {

constexpr double kPi = std::numbers::pi;

std::vector<double> cosine(int samples, int cycles) {
    std::vector<double> signal;
    for (int i = 0; i < samples; ++i) {
        signal.push_back(std::cos(2.0 * kPi * cycles * i / samples));
    }
    return signal;
}

std::vector<double> response_to(const std::vector<double>& signal, double sampling_Hz,
                                const HousingResponse& response) {
    PeriodicResponse periodic(static_cast<int>(signal.size()));
    periodic.add(signal, sampling_Hz, response);
    return periodic.take();
}

}  // namespace

// S. S. Rao, Mechanical Vibrations: displacement transmissibility of a damped oscillator.
TEST_CASE("A mode with participation 1 has the transmissibility of a damped oscillator") {
    constexpr double kDamping = 0.04, kNatural_Hz = 100.0, kSampling_Hz = 2000.0;
    constexpr int kSamples = 2000;
    for (const int f_Hz : {10, 80, 100, 141, 400, 900}) {
        const auto out = response_to(cosine(kSamples, f_Hz), kSampling_Hz,
                                     {.modes = {{kNatural_Hz, kDamping, 1.0}}, .measured = {}});
        const double r = f_Hz / kNatural_Hz, d = 2.0 * kDamping * r;
        const double gain = std::sqrt((1.0 + d * d) / ((1.0 - r * r) * (1.0 - r * r) + d * d)),
                     phase = std::atan2(-d * r * r, 1.0 - r * r + d * d);
        INFO(f_Hz);
        for (int i = 0; i < kSamples; i += 7) {
            const double t = i / kSampling_Hz;
            REQUIRE(out[static_cast<std::size_t>(i)] ==
                    Approx(gain * std::cos(2.0 * kPi * f_Hz * t + phase)).margin(1e-10 * gain));
        }
    }
}

TEST_CASE("Modes add, and without a stiff path only they respond") {
    const HousingResponse both{.modes = {{100.0, 0.02, 0.7}, {250.0, 0.05, -1.5}}, .measured = {}};
    const HousingResponse first{.stiff_path = false, .modes = {both.modes[0]}, .measured = {}},
        second{.stiff_path = false, .modes = {both.modes[1]}, .measured = {}};
    CHECK(both.at(0.0) == 1.0);
    for (const double f_Hz : {20.0, 100.0, 230.0, 700.0}) {
        CHECK(std::abs(both.at(f_Hz) - 1.0 - first.at(f_Hz) - second.at(f_Hz)) < 1e-12);
    }
    // At its natural frequency a mode adds phi / (2 zeta), a quarter of a period late.
    CHECK(std::abs(first.at(100.0) - std::complex(0.0, -0.7 / 0.04)) < 1e-12);
}

TEST_CASE("An impulse reproduces a measured response at its frequencies and in between") {
    constexpr int kSamples = 1200;
    constexpr double kSampling_Hz = 1200.0;
    HousingResponse response;
    response.measured = {{50.0, 100.0, 300.0}, {0.5, {0.0, -4.0}, -1.0}};
    std::vector<double> impulse(kSamples, 0.0);
    impulse[0] = 1.0;
    const auto out = response_to(impulse, kSampling_Hz, response);
    const auto spectrum_at = [&](int f_Hz) {
        std::complex<double> sum = 0.0;
        for (int i = 0; i < kSamples; ++i) {
            sum += out[static_cast<std::size_t>(i)] *
                   std::polar(1.0, -2.0 * kPi * f_Hz * i / kSampling_Hz);
        }
        return sum;
    };
    CHECK(std::abs(spectrum_at(50) - 0.5) < 1e-11);
    CHECK(std::abs(spectrum_at(100) - std::complex(0.0, -4.0)) < 1e-11);
    CHECK(std::abs(spectrum_at(300) + 1.0) < 1e-11);
    CHECK(std::abs(spectrum_at(75) - std::complex(0.25, -2.0)) < 1e-11);
    CHECK(std::abs(spectrum_at(200) - std::complex(-0.5, -2.0)) < 1e-11);
    CHECK(std::abs(spectrum_at(49)) < 1e-11);
    CHECK(std::abs(spectrum_at(301)) < 1e-11);
}

TEST_CASE("A response of gain 1 and linear phase delays a signal") {
    constexpr int kSamples = 999;  // odd: no harmonic at half the sampling rate
    constexpr int kDelay = 13;
    HousingResponse response;
    response.measured = MeasuredResponse{};
    for (int k = 0; k < kSamples; ++k) {
        response.measured->frequency_Hz.push_back(k);
        response.measured->value.push_back(std::polar(1.0, -2.0 * kPi * k * kDelay / kSamples));
    }
    std::vector<double> signal(kSamples);
    for (std::size_t i = 0; i < signal.size(); ++i) {
        signal[i] = static_cast<double>(i * i % 17) - 8.0;
    }
    const auto out = response_to(signal, kSamples, response);
    for (std::size_t i = 0; i < signal.size(); ++i) {
        REQUIRE(out[(i + kDelay) % kSamples] == Approx(signal[i]).margin(1e-10));
    }
}

namespace {

constexpr int kPlanets = 3, kPhases = 40, kOrder = 4;
constexpr SpanLayout kLayout{5, 7, 7};  // five turns of a carrier with seven mesh periods each
constexpr double kMeshSampling_Hz = 4000.0;

// Planets in the sense of the carrier's turn, of which `loaded` has an acceleration of amplitude 1
// at kOrder cycles per mesh period, at the angle `direction` from the radial direction.
struct TravellingLoad {
    std::vector<double> accel, te = std::vector<double>(kPhases);
    TileSignals tile{1, kPlanets, kPhases, {}, {}};

    TravellingLoad(int loaded, double direction) : accel(kPhases * 2 * kPlanets, 0.0) {
        const double psi = 2.0 * kPi * loaded / kPlanets;
        for (int p = 0; p < kPhases; ++p) {
            const double value = std::cos(2.0 * kPi * kOrder * p / kPhases);
            const auto at = static_cast<std::size_t>(p * 2 * kPlanets + 2 * loaded);
            accel[at] = value * std::cos(psi + direction);
            accel[at + 1] = value * std::sin(psi + direction);
        }
        tile.accel.push_back(accel.data());
        tile.te.push_back(te.data());
    }

    std::vector<double> response(int nodal_diameters, const SensorPlace& sensor, CarrierSense sense,
                                 const HousingResponse& of_ring) const {
        PeriodicResponse sum(kLayout.meshes() * kPhases);
        for (const auto axis : {RingLoad::Axis::x, RingLoad::Axis::y}) {
            const PathGrid grid(RingLoad{nodal_diameters, axis},
                                gears::planet_places({.planets = kPlanets}), kPhases, kLayout,
                                sense, sensor);
            sum.add(synthesize(tile, 0, {0}, kLayout, grid, 0.0, 0, kLayout.meshes()),
                    kMeshSampling_Hz, of_ring);
        }
        return sum.take();
    }
};

}  // namespace

// The modal load of a moving force is the sum of two travelling lines, of order kOrder x meshes +-
// n per carrier turn, and each has its own response.
TEST_CASE("A load that moves along an elastic ring has the response of the analytic series") {
    const double mesh_Hz = kMeshSampling_Hz / kPhases, carrier_Hz = mesh_Hz / 7.0;
    const HousingResponse ring{
        .stiff_path = false, .modes = {{390.0, 0.03, 1.3}, {800.0, 0.02, -0.4}}, .measured = {}};
    for (const int n : {0, 1, 2, 5}) {
        for (const int planet : {0, 1}) {
            for (const auto sense : {CarrierSense::positive, CarrierSense::negative}) {
                for (const bool tangential_load : {false, true}) {
                    for (const bool tangential_sensor : {false, true}) {
                        const double beta = 40.0 * kPi / 180.0,
                                     way = sense == CarrierSense::positive ? 1.0 : -1.0;
                        const TravellingLoad load(planet, tangential_load ? kPi / 2.0 : 0.0);
                        const auto out = load.response(
                            n, {.angle_deg = 40.0, .tangential = tangential_sensor, .gain = 2.0},
                            sense, ring);
                        // The load's angle from the sensor is d = start + way Omega t. Its weight
                        // is share cos(n d - lag).
                        const double start = 2.0 * kPi * planet / kPlanets - beta - kPi;
                        const double share = (tangential_load ? (n > 0 ? 1.0 / n : 0.0) : 1.0) *
                                             (tangential_sensor ? (n > 0 ? 1.0 / n : 0.0) : 1.0);
                        const double lag = (tangential_load ? -kPi / 2.0 : 0.0) +
                                           (tangential_sensor ? kPi / 2.0 : 0.0);
                        const double f_up = kOrder * mesh_Hz + way * n * carrier_Hz,
                                     f_down = kOrder * mesh_Hz - way * n * carrier_Hz;
                        INFO(n << " " << planet << " " << way << tangential_load
                               << tangential_sensor);
                        for (std::size_t i = 0; i < out.size(); i += 3) {
                            const double t = static_cast<double>(i) / kMeshSampling_Hz;
                            const std::complex<double> up = ring.at(f_up) *
                                                            std::polar(1.0, 2.0 * kPi * f_up * t +
                                                                                n * start - lag),
                                                       down =
                                                           ring.at(f_down) *
                                                           std::polar(1.0, 2.0 * kPi * f_down * t -
                                                                               n * start + lag);
                            REQUIRE(out[i] == Approx(share * (up + down).real()).margin(1e-9));
                        }
                    }
                }
            }
        }
    }
}

TEST_CASE("A signal of another length than the response's is refused") {
    PeriodicResponse response(10);
    CHECK_THROWS_AS(response.add(std::vector<double>(9), 1.0, {}), std::invalid_argument);
}

}  // namespace test_housing_response
