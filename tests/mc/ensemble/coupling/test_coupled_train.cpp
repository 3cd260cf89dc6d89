// Checks stages that elastic shafts couple with a study's gearbox: natural frequencies against
// equations written here, torques in balance, lines where the tooth numbers put them, and bits.
#include <Eigen/Dense>

#include "mc/ensemble/coupling/neighbour_stages.hpp"
#include "mc/ensemble/coupling/record_positions.hpp"
#include "mc/ensemble/gearbox/simulation.hpp"
#include "mc/plan/gearbox_plan.hpp"
#include "tests/mc/ensemble/gearbox/stage_files.hpp"
#include "tests/mc/study_file.hpp"

namespace gearpod::test_coupled_train {

using namespace test;

const std::vector<std::string> kNumerics{"numerics.integrator=central-difference",
                                         "numerics.horizon=full"};
const std::string kOptions =
    "--set numerics.integrator=central-difference --set numerics.horizon=full ";

std::string shaft(double stiffness_N_m_rad) {
    return ", shaft_stiffness_N_m_rad=" + std::to_string(stiffness_N_m_rad);
}

// Scene of the small gearbox next to the stage of that file.
mc::Scene scene_with(const std::string& path, const std::string& more,
                     std::vector<std::string> settings = {}) {
    settings.insert(settings.end(), kNumerics.begin(), kNumerics.end());
    return mc::Scene(small_study(path, more, std::move(settings)));
}

// Mass and stiffness of a torsional train: u = r theta of carrier, ring, sun and three planets. A
// sun mesh deflects by u_s + u_p - u_c cos(20 deg), a ring mesh by u_r - u_p - u_c cos(20 deg).
struct TorsionalTrain {
    static constexpr int kDegrees = 6;
    Eigen::MatrixXd mass = Eigen::MatrixXd::Zero(kDegrees, kDegrees), stiffness = mass;

    explicit TorsionalTrain(const mc::GearboxPlan& gearbox) {
        const auto in = std::get<dynamics::PlanetaryInputs>(gearbox.inputs(gearbox.nominal));
        for (int body = 0; body < kDegrees; ++body) {
            mass(body, body) = in.inertia_over_r2_kg[std::min(body, 3)];
        }
        mass(0, 0) += 3 * in.mass_kg[3];  // the planets move with the carrier
        stiffness(1, 1) = in.support_stiffness_N_m;
        for (int n = 0; n < 3; ++n) {
            Eigen::VectorXd sun = Eigen::VectorXd::Zero(kDegrees), ring = sun;
            sun(2) = sun(3 + n) = ring(1) = 1.0;
            ring(3 + n) = -1.0;
            sun(0) = ring(0) = -std::cos(std::numbers::pi / 9);
            const auto pair = static_cast<std::size_t>(n);
            stiffness += gearbox.stiffness->mean_pairs()[pair] * sun * sun.transpose() +
                         gearbox.stiffness->mean_pairs()[3 + pair] * ring * ring.transpose();
        }
    }
};

// Amplitude of a signal's line at a frequency in cycles per sample, with a Hann window.
double amplitude_at(const std::vector<double>& signal, double frequency) {
    const double mean = mean_of(signal);
    std::complex<double> sum = 0.0;
    double weights = 0.0;
    for (std::size_t i = 0; i < signal.size(); ++i) {
        const double turn = 2.0 * std::numbers::pi * static_cast<double>(i);
        const double weight = 1.0 - std::cos(turn / static_cast<double>(signal.size()));
        sum += weight * (signal[i] - mean) * std::polar(1.0, -turn * frequency);
        weights += weight;
    }
    return 2.0 * std::abs(sum) / weights;
}

std::vector<double> transmission_error(const mc::Scene& scene) {
    const mc::Simulation run = mc::simulate(scene.tile(), {mc::Group::threshold, 0}, 350);
    for (const mc::SignalColumn& column : run.columns) {
        if (column.name == "te") {
            return column.values;
        }
    }
    return {};
}

TEST_CASE("Natural frequencies of a train are those of its equations", "[coupled-train]") {
    const Folder folder;
    constexpr double kStiffness_N_m_rad = 2e4;
    const std::string path = stage_file(folder, "stage.toml");
    replace_in(path, "[sensor]", "[effects]\nmotion = \"torsional\"\n\n[sensor]");
    const mc::Scene scene =
        scene_with(path, shaft(kStiffness_N_m_rad), {"effects.motion=\"torsional\""});
    const TorsionalTrain first(scene.gearbox()), second(*scene.gearbox().stages[0].gearbox);
    constexpr int n = TorsionalTrain::kDegrees;
    Eigen::MatrixXd mass = Eigen::MatrixXd::Zero(2 * n, 2 * n), stiffness = mass;
    mass.topLeftCorner(n, n) = first.mass;
    mass.bottomRightCorner(n, n) = second.mass;
    stiffness.topLeftCorner(n, n) = first.stiffness;
    stiffness.bottomRightCorner(n, n) = second.stiffness;
    Eigen::VectorXd twist = Eigen::VectorXd::Zero(2 * n);
    twist(0) = 1.0 / (0.5 * 0.004 * (13 + 11));                                 // carrier radius
    twist(n + 2) = -1.0 / (0.5 * 0.004 * 13 * std::cos(std::numbers::pi / 9));  // sun's base circle
    stiffness += kStiffness_N_m_rad * twist * twist.transpose();
    const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> modes(stiffness, mass);
    const std::vector<double> frequencies = mc::train_frequencies_Hz(scene.gearbox());
    REQUIRE(frequencies.size() == 2 * n);
    CHECK(frequencies[0] < 1e-3 * frequencies[1]);  // the train turns freely
    for (std::size_t i = 1; i < frequencies.size(); ++i) {
        const double square = modes.eigenvalues()(static_cast<Eigen::Index>(i));
        CHECK(frequencies[i] == Approx(std::sqrt(square) / (2.0 * std::numbers::pi)).epsilon(1e-7));
    }
    // A soft shaft twists at the frequency of two rigid gearboxes.
    const mc::Scene soft = scene_with(path, shaft(10.0), {"effects.motion=\"torsional\""});
    CHECK(mc::train_frequencies_Hz(soft.gearbox())[1] ==
          Approx(soft.gearbox().stages[0].shaft->frequency_Hz).epsilon(1e-3));
}

TEST_CASE("An elastic shaft bears the same torque at both ends", "[coupled-train]") {
    const Folder folder;
    const mc::Scene scene = scene_with(stage_file(folder, "stage.toml"), shaft(2e4));
    mc::Realization gearbox = scene.sampler().draw({mc::Group::threshold, 1});
    gearbox.inputs.torque_N_m *= 0.83;
    const mc::Realization stage =
        mc::stage_gearbox(scene.gearbox(), scene.gearbox().stages[0], gearbox);
    // Ring fixed: the carrier bears 1 + 35/13 of the sun's torque.
    const double here = mc::shaft_torque_N_m(scene.gearbox(), mc::Member::carrier, gearbox.inputs);
    CHECK(here == Approx(-0.83 * 200.0 * 48 / 13).epsilon(1e-12));
    CHECK(mc::shaft_torque_N_m(*scene.gearbox().stages[0].gearbox, mc::Member::sun, stage.inputs) ==
          Approx(-here).epsilon(1e-12));
    CHECK(stage.inputs.torque_N_m == Approx(-here).epsilon(1e-12));
}

TEST_CASE("A stage whose study drives from the other side turns the other way", "[coupled-train]") {
    // Both suns are driven, so that one of the studies describes the mirrored train.
    const Folder folder;
    check_mentions(require_success("describe " + kSmall + " " + kOptions +
                                   "--set 'sensor.stages=[{name=\"a\", study=\"" +
                                   stage_file(folder, "stage.toml") +
                                   "\", shaft=\"sun\", stage_shaft=\"sun\"" + shaft(2e3) + "}]'"),
                   {"its study is mirrored"});
}

TEST_CASE("A shaft carries lines of the stage to the transmission error", "[coupled-train]") {
    const Folder folder;
    const std::string path = stage_file(folder, "stage.toml");
    const auto coupled = transmission_error(scene_with(path, shaft(2e4)));
    const auto alone = transmission_error(scene_with(path, shaft(0)));
    REQUIRE(coupled.size() == alone.size());
    // Mesh frequency of the stage over that of the gearbox: 13/48, the speed of the carrier over
    // that of the sun. The torques of its three planets add up in every third harmonic.
    const double line = 3.0 * 13.0 / 48.0 / 8.0;
    CHECK(amplitude_at(coupled, line) > 100.0 * amplitude_at(alone, line));
    CHECK(amplitude_at(coupled, line) > 20.0 * amplitude_at(coupled, 1.1 * line));
    CHECK(amplitude_at(coupled, 3.0 / 8.0) == Approx(amplitude_at(alone, 1.0 / 8.0)).epsilon(0.2));
}

TEST_CASE("A shaft without stiffness leaves all bits as they are", "[coupled-train]") {
    const Folder folder;
    const std::string path = stage_file(folder, "stage.toml");
    const mc::Results none = run_small(folder, "none.h5", kOptions + stages(path, "")),
                      zero = run_small(folder, "zero.h5", kOptions + stages(path, shaft(0)));
    for (std::size_t f = 0; f < none.features.size(); ++f) {
        CHECK(bits_of(none.features[f].values) == bits_of(zero.features[f].values));
    }
}

TEST_CASE("Rows of coupled gearboxes keep their bits over threads, parts and merging",
          "[coupled-train]") {
    const Folder folder;
    const std::string path = stage_file(folder, "stage.toml");
    check_equal_bits_over_parts(kOptions + stages(path, ", role=\"other_fault\"" + shaft(2e4)) +
                                "--set 'features.use=[\"fm4\",\"change_sensor_rms\"]' ");
}

TEST_CASE("The fault of a coupled stage raises gear alarms of its own", "[coupled-train]") {
    const Folder folder;
    const std::string path = stage_file(folder, "stage.toml");
    const mc::Results results = run_small(
        folder, "other.h5", kOptions + stages(path, ", role=\"other_fault\"" + shaft(2e4)));
    REQUIRE(results.variants.size() == 1);
    for (std::size_t row = 0; row < 20; ++row) {
        CHECK(results.variants[0].features[4].values[row] != results.features[4].values[row]);
        CHECK(results.variants[0].features[4].values[row] ==
              Approx(results.features[4].values[row]).epsilon(0.5));
    }
}

// A stage that is as loud as the gearbox. Records at the same positions of its teeth and carrier
// would differ from their baselines by nothing.
TEST_CASE("Coupled stages have other positions in every record", "[coupled-train]") {
    const Folder folder;
    const mc::Results results =
        run_small(folder, "r.h5",
                  kOptions + stages(stage_file(folder, "stage.toml"), shaft(2e3)) +
                      "--set 'features.use=[\"sensor_rms\",\"change_sensor_rms\"]' ");
    const auto& all = results.features[0].values;
    const auto& changes = results.features[1].values;
    for (std::size_t row = 0; row < 20; ++row) {  // healthy gearboxes
        CHECK(changes[row] > 0.2 * all[row]);
    }
    CHECK(std::abs(changes[0] / changes[8] - 1.0) > 0.02);
    const mc::GearboxId first{mc::Group::test, 7};
    CHECK(mc::share_positions(first, {mc::Group::test, 0}, 8));
    CHECK(!mc::share_positions(first, {mc::Group::test, 8}, 8));
    CHECK(!mc::share_positions(first, {mc::Group::test, 7, mc::Record::baseline}, 8));
}

TEST_CASE("Shafts that cannot be computed are refused with what would be right",
          "[coupled-train]") {
    const Folder folder;
    const std::string path = stage_file(folder, "stage.toml");
    const auto refused = [&](const std::string& options) {
        return check_refused("describe " + kSmall + " " + options);
    };
    CHECK(refused(stages(path, shaft(2e4)) + "--set numerics.integrator=central-difference")
              .mentions("numerics.horizon"));
    CHECK(refused(stages(path, shaft(2e4)) + "--set numerics.horizon=full")
              .mentions("give numerics.integrator = \"central-difference\""));
    CHECK(refused(kOptions + stages(path, shaft(1e12))).mentions("steps per mesh period"));
    CHECK(refused(kOptions + stages(path, shaft(1e7))).mentions("steps per mesh period"));
    CHECK(refused(kOptions + stages(path, shaft(1e-4))).mentions("to decay"));
    CHECK(refused(kOptions + "--set 'sensor.stages=[{name=\"a\", study=\"" + path +
                  "\", shaft=\"carrier\", stage_shaft=\"sun\"" + shaft(2e3) +
                  "}, {name=\"b\", study=\"" + path + "\", shaft=\"carrier\", stage_shaft=\"sun\"" +
                  shaft(2e3) + "}]'")
              .mentions("two elastic shafts end at the carrier"));
    CHECK(refused(stages(path, "") +
                  "--set 'operation.carrier_speed_rpm={distribution=\"uniform\", low=5, high=70}'")
              .mentions("next to the slowest gearbox"));
    CHECK(refused(kOptions + stages(path, ", shaft_damping_ratio=0.1"))
              .mentions("has no effect without shaft_stiffness_N_m_rad"));
    CHECK(refused(kOptions + stages(path, shaft(2e4)) + "--set effects.gravity=true")
              .mentions("steady"));
    CHECK(refused("--set numerics.tolerance=1e-3 --set numerics.horizon=full " +
                  stages(path, shaft(2e4)))
              .mentions("numerics.tolerance"));
    CHECK(refused(kOptions + "--set 'sensor.stages=[{name=\"a\", study=\"" + path +
                  "\", shaft=\"carrier\", stage_shaft=\"sun\"}, {name=\"b\", study=\"" + path +
                  "\", of=\"a\", shaft=\"carrier\", stage_shaft=\"sun\"" + shaft(2e4) + "}]'")
              .mentions("the shaft of stage \"a\" has none"));
    CHECK(program("accuracy " + kSmall + " " + kOptions + stages(path, shaft(2e4)))
              .mentions("integrated by one method only"));
}

}  // namespace gearpod::test_coupled_train
