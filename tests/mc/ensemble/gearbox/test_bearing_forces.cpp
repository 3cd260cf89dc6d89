// Checks what the forces in the bearings of sun and carrier add to the sensors' signals: against an
// oscillator driven by the force of the recorded motion, and over strategies, lanes and threads.
#include <fmt/format.h>

#include "mc/ensemble/gearbox/simulation.hpp"
#include "tests/mc/ensemble/gearbox/small_runs.hpp"
#include "tests/mc/ensemble/gearbox/stage_files.hpp"
#include "tests/mc/liang_signals.hpp"
#include "tests/mc/study_file.hpp"
#include "tests/numbers.hpp"
#include "tests/signals/butterworth.hpp"

namespace gearpod::test_bearing_forces {

using namespace test;
using Complex = std::complex<double>;

constexpr double kPi = std::numbers::pi;
constexpr double kFrequency_Hz = 71.0, kDamping = 0.03, kPerKg = 0.2, kSide = -0.07;
constexpr int kEvery = 15;  // samples between those that are compared
constexpr double kSide_rad = 0.5 * kPi, kLowPass_Hz = 120.0;

// One mode of the housing with these participations of the bearings at the first sensor and at a
// tangential one 90 degrees from it.
std::vector<std::string> one_mode(double sun, double carrier, double side) {
    return {fmt::format("sensor.housing_modes=[{{frequency_Hz={}, damping={}, participation=0.5, "
                        "sun_bearing_per_kg={}, carrier_bearing_per_kg={}}}]",
                        kFrequency_Hz, kDamping, sun, carrier),
            fmt::format("sensor.additional=[{{name=\"side\", angle_deg=90, "
                        "direction=\"tangential\", {}=[{}]}}]",
                        sun != 0.0 ? "sun_bearing_per_kg" : "carrier_bearing_per_kg", side)};
}

mc::Study small_study(std::vector<std::string> settings) {
    for (const char* setting : {"sensor.sampling_Hz=84000", "numerics.integrator=\"rk4\"",
                                "gearbox.sun.bearing_damping_N_s_m=2e4"}) {
        settings.emplace_back(setting);
    }
    return valid_study(mc::read_study(kSmall, settings));
}

// Signals of both sensors of the nominal gearbox over one carrier turn.
struct TwoSignals {
    std::vector<double> first, side;
};

TwoSignals signals_of(const mc::Scene& scene, const mc::GearboxTile& tile) {
    const mc::LaneSignals all =
        mc::lane_signals(scene.tile(), tile, LaneId{0}, scene.record().span.carrier_meshes);
    return {all.sensor, all.additional.front().sensor};
}

// Filter of the study.
Complex low_pass(double f_Hz) {
    return butterworth(f_Hz / kLowPass_Hz);
}

// Acceleration of a damped oscillator of unit mass under a unit force.
Complex accelerance(double f_Hz) {
    const double w = 2.0 * kPi * f_Hz, natural = 2.0 * kPi * kFrequency_Hz;
    return -w * w / Complex(natural * natural - w * w, 2.0 * kDamping * natural * w);
}

// Complex lines of a motion that repeats each mesh period.
Complex line(const lockstep::MeshRecord& record, std::size_t degrees, std::size_t lanes,
             std::size_t degree, int k) {
    const std::size_t samples = record.motion.size() / degrees / lanes;
    Complex sum = 0.0;
    for (std::size_t p = 0; p < samples; ++p) {
        sum +=
            record.motion[(p * degrees + degree) * lanes] *
            std::polar(1.0, -2.0 * kPi * k * static_cast<double>(p) / static_cast<double>(samples));
    }
    return sum / static_cast<double>(samples);
}

// Force of a bearing on the housing along a sensor, as lines at the harmonics k of the mesh plus or
// minus the carrier's rotation, and the acceleration of the sensor.
struct BearingForce {
    const mc::Scene& scene;
    const mc::GearboxTile& tile;
    int degree = 0;  // x motion of its shaft
    double stiffness = 0.0, damping = 0.0;

    // Acceleration at the times of the samples per force response and low-pass.
    template <class Response>
    std::vector<double> acceleration(double sensor_rad, Response response) const {
        constexpr int kHarmonics = 20;
        const auto degrees = static_cast<std::size_t>(
            dynamics::degrees_of_freedom(scene.solve().integration().layout));
        const auto lanes = static_cast<std::size_t>(tile.views.lanes);
        const double mesh_Hz = scene.gearbox().mesh_frequency_Hz;
        const int turn = scene.record().span.carrier_meshes, per_mesh = scene.record().samples;
        std::vector<double> sum(static_cast<std::size_t>(turn * per_mesh / kEvery), 0.0);
        for (int k = -kHarmonics; k <= kHarmonics; ++k) {
            const Complex x = line(tile.integration.records[0], degrees, lanes,
                                   static_cast<std::size_t>(degree), k),
                          y = line(tile.integration.records[0], degrees, lanes,
                                   static_cast<std::size_t>(degree) + 1, k);
            // sin(a) x + cos(a) y = Re of both with exp(i a) and exp(-i a), a = theta - sensor_rad.
            for (const int sense : {-1, 1}) {
                const double f_Hz = mesh_Hz * (k + static_cast<double>(sense) / turn);
                const Complex half =
                    0.5 * (y + Complex(0.0, -sense) * x) * std::polar(1.0, -sense * sensor_rad);
                const Complex force = half * Complex(stiffness, 2.0 * kPi * f_Hz * damping);
                const Complex at_sensor = force * response(f_Hz) * low_pass(mesh_Hz * k);
                for (std::size_t i = 0; i < sum.size(); ++i) {
                    const double periods = (k + static_cast<double>(sense) / turn) *
                                           static_cast<double>(i * kEvery) / per_mesh;
                    sum[i] += std::real(at_sensor * std::polar(1.0, 2.0 * kPi * periods));
                }
            }
        }
        return sum;
    }
};

// Largest difference of two signals' difference from a third one, over the largest of the third.
double error_of(const std::vector<double>& with, const std::vector<double>& without,
                const std::vector<double>& expected) {
    REQUIRE(with.size() == kEvery * expected.size());
    double error = 0.0, largest = 0.0;
    for (std::size_t i = 0; i < expected.size(); ++i) {
        error = std::max(error, std::abs(with[kEvery * i] - without[kEvery * i] - expected[i]));
        largest = std::max(largest, std::abs(expected[i]));
    }
    CHECK(largest > 0.0);
    return error / largest;
}

BearingForce force_of(const mc::Scene& scene, const mc::GearboxTile& tile, int body) {
    const auto& bodies = tile.realizations[0].inputs.bodies;
    const mc::BodyInstance& own =
        bodies[body == dynamics::sun ? mc::Member::sun : mc::Member::carrier];
    return {scene, tile, dynamics::motion_index(body), own.bearing_stiffness_N_m,
            own.bearing_damping_N_s_m};
}

const std::string kModesOfBearings =
    "sensor.housing_modes=[{frequency_Hz=70, damping=0.03, participation=0.8, "
    "sun_bearing_per_kg=0.02}, {frequency_Hz=90, damping=0.02, participation=0.5, "
    "nodal_diameters=2, carrier_bearing_per_kg=-0.03}]";
const std::string kBearings = " --set '" + kModesOfBearings + "' ";

TEST_CASE("A bearing adds the acceleration of an oscillator under the force of the motion") {
    const mc::Scene without(small_study(one_mode(0.0, 0.0, 0.0)));
    const TwoSignals before = signals_of(without, run_one(without));
    for (const int body : {dynamics::sun, dynamics::carrier}) {
        INFO(body);
        const bool sun = body == dynamics::sun;
        const mc::Scene scene(small_study(one_mode(sun ? kPerKg : 0.0, sun ? 0.0 : kPerKg, kSide)));
        const mc::GearboxTile tile = run_one(scene, true);
        const TwoSignals after = signals_of(scene, tile);
        const BearingForce force = force_of(scene, tile, body);
        const auto first =
            force.acceleration(0.0, [](double f) { return kPerKg * accelerance(f); });
        CHECK(error_of(after.first, before.first, first) < 1e-3);
        // Tangential: the direction is a quarter of a turn ahead.
        const auto side = force.acceleration(kSide_rad - 0.5 * kPi,
                                             [](double f) { return kSide * accelerance(f); });
        CHECK(error_of(after.side, before.side, side) < 1e-3);
    }
}

TEST_CASE("A measured response of a bearing multiplies the force of the motion") {
    const std::vector<std::string> housing{
        "sensor.response_Hz=[20, 1000]", "sensor.response_gain=[0.3, 0.3]",
        "sensor.response_phase_deg=[0, 0]", "sensor.additional=[{name=\"side\", angle_deg=90}]"};
    std::vector<std::string> both = housing;
    both.back() =
        "sensor.additional=[{name=\"side\", angle_deg=90, "
        "carrier_response_gain=[0.02, 0.02], carrier_response_phase_deg=[0, 0]}]";
    both.emplace_back("sensor.carrier_response_gain=[0.01, 0.01]");
    both.emplace_back("sensor.carrier_response_phase_deg=[90, 90]");
    const mc::Scene without(small_study(housing)), scene(small_study(both));
    const TwoSignals before = signals_of(without, run_one(without));
    const mc::GearboxTile tile = run_one(scene, true);
    const TwoSignals after = signals_of(scene, tile);
    const BearingForce force = force_of(scene, tile, dynamics::carrier);
    const auto passes = [](double f) { return std::abs(f) > 20.0; };
    const auto first = force.acceleration(0.0, [&](double f) {
        return passes(f) ? Complex(0.0, f > 0.0 ? 0.01 : -0.01) : Complex(0.0);
    });
    CHECK(error_of(after.first, before.first, first) < 1e-3);
    const auto side = force.acceleration(
        kSide_rad, [&](double f) { return passes(f) ? Complex(0.02) : Complex(0.0); });
    CHECK(error_of(after.side, before.side, side) < 1e-3);
}

TEST_CASE("A mode without a force in a bearing keeps the bits of the features") {
    const Folder folder;
    const std::string mode =
        " --set 'sensor.housing_modes=[{frequency_Hz=70, damping=0.03, "
        "participation=0.8";
    const mc::Results plain = run_small(folder, "plain.h5", mode + "}]'"),
                      zero = run_small(folder, "zero.h5", mode + ", sun_bearing_per_kg=0}]'"),
                      some = run_small(folder, "some.h5", mode + ", sun_bearing_per_kg=0.02}]'");
    for (std::size_t f = 0; f < plain.features.size(); ++f) {
        INFO(plain.features[f].name);
        const auto bits = bits_of(plain.features[f].values);
        CHECK(bits_of(zero.features[f].values) == bits);
        const bool of_te = plain.features[f].name.starts_with("te_");
        CHECK((bits_of(some.features[f].values) == bits) == of_te);
    }
}

TEST_CASE("All strategies and kinds of excitation carry the forces in bearings") {
    const Folder folder;
    const std::string quiet = kBearings + " --set sensor.noise_levels=[0] ";
    const mc::Results periodic = run_small(folder, "periodic.h5", quiet);
    const auto& expected = values(periodic.features, "sensor_rms");
    const mc::Results without = run_small(
        folder, "without.h5",
        " --set 'sensor.housing_modes=[{frequency_Hz=70, damping=0.03, participation=0.8}, "
        "{frequency_Hz=90, damping=0.02, participation=0.5, nodal_diameters=2}]'"
        " --set sensor.noise_levels=[0]");
    CHECK(std::abs(values(without.features, "sensor_rms")[0] / expected[0] - 1.0) > 0.05);
    for (const char* other :
         {"--set numerics.horizon=full",
          "--set numerics.integrator=newmark --set numerics.horizon=full",
          "--set operation.torque_noise=1e-9 --set operation.torque_noise_band_Hz=5",
          "--set operation.speed_fluctuation=1e-9 --set operation.speed_fluctuation_order=1"}) {
        INFO(other);
        const mc::Results results = run_small(folder, "other.h5", quiet + "--force " + other);
        const auto& computed = values(results.features, "sensor_rms");
        test::check_close(computed, expected, 5e-3);
    }
}

// An elastic shaft couples the rotations, so that the forces in the bearings hardly change.
TEST_CASE("Gearboxes coupled by an elastic shaft have forces in bearings, too") {
    const Folder folder;
    const std::string path = stage_file(folder, "stage.toml");
    const auto rms = [&](const std::string& shaft) {
        const auto sensor = [&](const std::string& modes) {
            const mc::Scene scene(test::small_study(
                path, shaft,
                {modes, "numerics.integrator=central-difference", "numerics.horizon=full"}));
            const mc::Simulation run = mc::simulate(scene.tile(), {mc::Group::threshold, 0}, 350);
            return std::ranges::find(run.columns, "sensor", &mc::SignalColumn::name)->values;
        };
        const auto with = sensor(kModesOfBearings);
        const auto without = sensor(
            "sensor.housing_modes=[{frequency_Hz=70, damping=0.03, "
            "participation=0.8}, {frequency_Hz=90, damping=0.02, "
            "participation=0.5, nodal_diameters=2}]");
        return rms_of(difference(with, without));
    };
    const double alone = rms("");
    CHECK(alone > 0.0);
    CHECK(rms(", shaft_stiffness_N_m_rad=2e4") == Approx(alone).epsilon(0.1));
}

TEST_CASE("Problems of forces in bearings are all reported") {
    check_refused(
        "describe " + kSmall + kBearings + " --set 'effects.motion=\"torsional\"'",
        {"mode 1: sun_bearing_per_kg needs the force in the bearing of the sun, which is rigid",
         "mode 2: carrier_bearing_per_kg needs the force in the bearing of the carrier"});
    const auto loose = check_refused(
        "describe " + kSmall + kBearings +
        " --set gearbox.sun.bearing_stiffness_N_m=0"
        " --set gearbox.sun.bearing_damping_N_s_m=0"
        " --set 'sensor.additional=[{name=\"a\", angle_deg=1, sun_bearing_per_kg=[1], "
        "carrier_response_gain=[1]}]'");
    CHECK(
        loose.mentions("sensor 1: sun_bearing_per_kg needs the force in the bearing of the sun, "
                       "which has neither"));
    CHECK(
        loose.mentions("sensor 1: sun_bearing_per_kg has 1 values, but "
                       "sensor.housing_modes has 2"));
    CHECK(
        loose.mentions("sensor 1: carrier_response_gain has 1 values, but sensor.response_Hz "
                       "has 0"));
    check_refused("describe " + study_path("tip-relief.toml") + kBearings,
                  {"mode 1: sun_bearing_per_kg needs a sun"});
    check_refused("describe " + kSmall + " --set sensor.sun_response_gain=[1]",
                  {"only with sensor.response_Hz"});
    check_refused("describe " + kSmall +
                      " --set sensor.response_Hz=[1,2] --set sensor.response_gain=[1,1]"
                      " --set sensor.response_phase_deg=[0,0]"
                      " --set sensor.sun_response_gain=[1]",
                  {"sensor.sun_response_gain: has 1 values, but sensor.response_Hz has 2",
                   "sensor.sun_response_phase_deg: missing"});
    const auto described = require_success("describe " + kSmall + kBearings);
    check_mentions(described, {"70 Hz: a force of 1 N in the bearing of the sun gives 0.333 m/s^2",
                               "a force of 1 N in the bearing of the carrier gives 0.75 m/s^2"});
}

}  // namespace gearpod::test_bearing_forces
