// Checks the response of the housing against closed forms: a sensor on a resonant mounting, a
// measured response, and loads that move along an elastic ring.
#include "signals/path/frequency_response.hpp"
#include "signals/path/transmission_path.hpp"
#include "signals/sensor/sensor_signal.hpp"
#include "tests/numbers.hpp"
#include "tests/signals/butterworth.hpp"

namespace gearpod::signals::test_housing_response {

constexpr double kPi = std::numbers::pi;

std::vector<double> cosine(int samples, int cycles) {
    return test::tabulated(samples,
                           [&](int i) { return std::cos(2.0 * kPi * cycles * i / samples); });
}

std::vector<double> response_to(const std::vector<double>& signal, double sampling_Hz,
                                const HousingResponse& response) {
    PeriodicResponse periodic(static_cast<int>(signal.size()));
    periodic.add(signal, sampling_Hz, response);
    return periodic.take();
}

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
    const auto signal = test::tabulated(kSamples, [](int i) { return i * i % 17 - 8.0; });
    const auto out = response_to(signal, kSamples, response);
    for (std::size_t i = 0; i < signal.size(); ++i) {
        REQUIRE(out[(i + kDelay) % kSamples] == Approx(signal[i]).margin(1e-10));
    }
}

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

    std::vector<double> response(int nodal_diameters, const SensorPosition& sensor,
                                 CarrierSense sense, const HousingResponse& of_ring) const {
        PeriodicResponse sum(kLayout.meshes() * kPhases);
        for (const auto axis : {RingLoad::Axis::x, RingLoad::Axis::y}) {
            const PathGrid grid(RingLoad{nodal_diameters, axis},
                                gears::planet_positions({.planets = kPlanets}), kPhases, kLayout,
                                sense, sensor);
            sum.add(synthesize(tile, LaneId{0}, {0}, kLayout, grid, 0.0, 0, kLayout.meshes()),
                    kMeshSampling_Hz, of_ring);
        }
        return sum.take();
    }
};

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

}  // namespace gearpod::signals::test_housing_response

// Checks the measuring chain of a sensor against closed forms: its low-pass in place of another
// one, a resonant mounting, and a delay.

namespace gearpod::signals::test_measuring_chain {

using Complex = std::complex<double>;

constexpr double kPi = std::numbers::pi;
constexpr double kSampling_Hz = 2000.0;
constexpr int kSamples = 2000;  // one second: harmonics at whole Hz

using test::butterworth;

// Sine of that frequency with a complex amplitude.
std::vector<double> sine(double f_Hz, Complex amplitude) {
    return test::tabulated(kSamples, [&](int i) {
        return (amplitude * std::polar(1.0, 2.0 * kPi * f_Hz * i / kSampling_Hz)).imag();
    });
}

std::vector<double> measured_by(const MeasuringChain& chain, const std::vector<double>& signal) {
    PeriodicResponse response(static_cast<int>(signal.size()));
    response.add(signal, kSampling_Hz, {.modes = {}, .measured = {}, .chain = chain});
    return response.take(chain, kSampling_Hz);
}

TEST_CASE("A low-pass of its own takes the place of the one that was applied") {
    constexpr double kOwn_Hz = 150.0, kApplied_Hz = 600.0;
    const MeasuringChain chain{.low_pass = {{kOwn_Hz, kApplied_Hz}}, .mounting = {}};
    for (const int f_Hz : {1, 20, 150, 300, 700, 990}) {
        INFO(f_Hz);
        // Sine of amplitude 1 before any low-pass.
        const auto out = measured_by(chain, sine(f_Hz, butterworth(f_Hz / kApplied_Hz)));
        const Complex expected = butterworth(f_Hz / kOwn_Hz);
        CHECK(std::abs(expected) == Approx(1.0 / std::sqrt(1.0 + std::pow(f_Hz / kOwn_Hz, 8.0))));
        const auto reference = sine(f_Hz, expected);
        CHECK(test::largest_difference(out, reference) < 1e-9 * std::abs(expected));
        // The ratio of both Butterworth gains is the amplitude of the chain.
        CHECK(std::abs(chain.at(f_Hz)) ==
              Approx(std::sqrt((1.0 + std::pow(f_Hz / kApplied_Hz, 8.0)) /
                               (1.0 + std::pow(f_Hz / kOwn_Hz, 8.0))))
                  .epsilon(1e-9));
    }
    CHECK(chain.at(0.0) == 1.0);
}

TEST_CASE("A delay of whole samples shifts them, and one of half a sample shifts a sine") {
    const auto signal = test::tabulated(kSamples, [](int i) { return i * i % 17 - 8.0; });
    for (const int shift : {7, -3, 0}) {
        const auto out =
            measured_by({.low_pass = {}, .mounting = {}, .delay_s = shift / kSampling_Hz}, signal);
        for (int i = 0; i < kSamples; ++i) {
            const int late = (i + shift + kSamples) % kSamples;
            REQUIRE(out[static_cast<std::size_t>(late)] ==
                    Approx(signal[static_cast<std::size_t>(i)]).margin(1e-9));
        }
    }
    const auto half = measured_by({.low_pass = {}, .mounting = {}, .delay_s = 0.5 / kSampling_Hz},
                                  sine(90.0, 1.0));
    for (int i = 0; i < kSamples; ++i) {
        REQUIRE(half[static_cast<std::size_t>(i)] ==
                Approx(std::sin(2.0 * kPi * 90.0 * (i - 0.5) / kSampling_Hz)).margin(1e-9));
    }
}

TEST_CASE("A mounting responds as one mode with participation 1") {
    const MeasuringChain chain{.low_pass = {}, .mounting = {{320.0, 0.04}}};
    const HousingResponse mode{.modes = {{320.0, 0.04, 1.0}}, .measured = {}};
    for (const double f_Hz : {0.0, 10.0, 250.0, 320.0, 500.0, 5000.0}) {
        INFO(f_Hz);
        CHECK(std::abs(chain.at(f_Hz) - mode.at(f_Hz)) < 1e-12 * std::abs(mode.at(f_Hz)));
    }
    CHECK(std::abs(chain.at(320.0)) == Approx(std::hypot(1.0, 1.0 / 0.08)).epsilon(1e-12));
}

TEST_CASE("A sampling rate of its own keeps its samples and no frequency above half of it") {
    for (const int count : {60, 45}) {
        std::vector<double> signal =
            test::tabulated(count, [&](int i) { return static_cast<double>(i * i % 23) - 9.0; });
        for (const int own : {1, 7, 8, 15, 22, 30, 44}) {
            INFO(count << " " << own);
            const double rate = kSampling_Hz * own / count;
            const auto out =
                measured_by({.low_pass = {}, .mounting = {}, .sampling_Hz = rate}, signal);
            // Discrete spectra of both; between the samples they are trigonometric polynomials.
            const auto spectrum = [&](const std::vector<double>& x) {
                std::vector<Complex> values;
                for (int k = 0; k <= count / 2; ++k) {
                    Complex sum = 0.0;
                    for (int i = 0; i < count; ++i) {
                        sum += x[static_cast<std::size_t>(i)] *
                               std::polar(1.0, -2.0 * kPi * (k * i % count) / count);
                    }
                    const bool once = k == 0 || 2 * k == count;
                    values.push_back(sum * ((once ? 1.0 : 2.0) / count));
                }
                return values;
            };
            const auto before = spectrum(signal), after = spectrum(out);
            const auto at = [&](const std::vector<Complex>& x, double turn) {
                double sum = 0.0;
                for (std::size_t k = 0; k < x.size(); ++k) {
                    sum +=
                        (x[k] * std::polar(1.0, 2.0 * kPi * static_cast<double>(k) * turn)).real();
                }
                return sum;
            };
            for (int m = 0; m < own; ++m) {
                const double turn = static_cast<double>(m) / own;
                CHECK(at(after, turn) == Approx(at(before, turn)).margin(1e-10));
            }
            for (int k = own / 2 + 1; k <= count / 2; ++k) {
                CHECK(std::abs(after[static_cast<std::size_t>(k)]) < 1e-12);
            }
        }
    }
    // A rate above that of the samples changes nothing.
    const MeasuringChain faster{.low_pass = {}, .mounting = {}, .sampling_Hz = 2.0 * kSampling_Hz};
    CHECK(faster.own_samples(60, kSampling_Hz) == 60);
}

TEST_CASE("The measuring chain multiplies the response of the housing and of the ring") {
    const MeasuringChain chain{
        .low_pass = {{90.0, 200.0}}, .mounting = {{320.0, 0.04}}, .delay_s = 1e-3};
    const HousingResponse housing{.modes = {{100.0, 0.02, 0.7}}, .measured = {}};
    const HousingResponse ring{.stiff_path = false, .modes = housing.modes, .measured = {}};
    HousingResponse measured;
    measured.measured = {{0.0, 1000.0}, {1.0, {0.0, 2.0}}};
    for (const HousingResponse& without : {housing, ring, measured}) {
        HousingResponse with = without;
        with.chain = chain;
        for (const double f_Hz : {5.0, 100.0, 340.0}) {
            CHECK(std::abs(with.at(f_Hz) - without.at(f_Hz) * chain.at(f_Hz)) < 1e-13);
        }
    }
}

}  // namespace gearpod::signals::test_measuring_chain
