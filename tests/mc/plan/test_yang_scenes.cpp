// Checks further scenes after Yang et al. (2022): tooth separation, his test rig, and pitch errors;
// and the tones of Liang's test rig.
#include "dynamics/gearbox.hpp"
#include "dynamics/gearbox_matrices.hpp"
#include "tests/mc/liang_signals.hpp"
#include "tests/test.hpp"

namespace gearpod::test_yang_scenes {

using namespace test;

// Results for the mesh of ring and planet 1, over one mesh period of the healthy periodic orbit.
struct RingMesh {
    double vibration_m = 0.0;   // rms of its compression d - e about the mean
    double apart = 0.0;         // share of the time out of contact
    double deepest_m = 0.0;     // minimum of d - e
    double mean_force_N = 0.0;  // mean of k (d - e) on the front flanks
};

RingMesh ring_mesh(int number, const std::vector<std::string>& overrides = {}) {
    const mc::Scene scene(shipped_study("published/yang-separation.toml", overrides));
    const auto tile = run_one(scene, true, static_cast<std::uint64_t>(number));
    REQUIRE(tile.integration.status[0] == lockstep::LaneStatus::ok);
    const int pair = scene.gearbox().drivetrain->pairs_per_mesh();
    const Eigen::VectorXd row =
        dynamics::mesh_row(scene.solve().integration().layout, PairId{pair});
    const auto& motion = tile.integration.records[0].motion;
    const int samples = scene.record().samples;
    std::vector<double> pressed;
    RingMesh result;
    for (int i = 0; i < samples; ++i) {
        const double phase = static_cast<double>(i) / samples;
        const Eigen::Map<const Eigen::VectorXd> q(motion.data() + i * row.size(), row.size());
        // Error with amplitude 0.4 um, phase 180 degrees.
        const double error =
            -0.4e-6 * std::sin(2.0 * std::numbers::pi *
                               (phase - scene.gearbox().drivetrain->pitch_phase(PairId{pair})));
        pressed.push_back(row.dot(q) - error);
        result.mean_force_N += std::max(pressed.back(), 0.0) *
                               scene.gearbox().pairs().total(PairId{pair}, phase) / samples;
        result.apart += pressed.back() <= 0.0 ? 1.0 / samples : 0.0;
    }
    double mean = 0.0, square = 0.0;
    for (const double value : pressed) {
        mean += value / samples;
        square += value * value / samples;
    }
    result.vibration_m = std::sqrt(square - mean * mean);
    result.deepest_m = *std::min_element(pressed.begin(), pressed.end());
    return result;
}

// Line spacing of the test rig's sensor signal is f_mp / kRigMeshes: carrier (112 meshes), sun (32)
// and planets (40) repeat in this span.
constexpr int kRigMeshes = 1120, kRigCarrier = 10, kRigSun = 35;

// Signal of the first test gearbox, whose teeth are the same at any depth of the crack.
std::vector<double> rig_signal(double depth_mm, bool alike) {
    mc::Study study =
        shipped_study("published/yang-test-rig.toml",
                      {"random.fault.depth_mm={ distribution = \"levels\", values = [" +
                       std::to_string(depth_mm) + "] }"});
    if (alike) {
        study.errors.pitch_error_m = 0.0;
        study.numerics.horizon = mc::Horizon::periodic;
    }
    return sensor_signal(mc::Scene(study), kRigMeshes, 0);
}

struct RigLines {
    std::vector<double> healthy, change;  // change due to a crack of 0.2 mm
};
RigLines rig_lines(bool alike) {
    const auto healthy = rig_signal(0.0, alike);
    return {lines(healthy), lines(difference(rig_signal(0.2, alike), healthy))};
}

// Change due to the crack at 2 f_mp + k f_rs, k from -6 to 6: the mean over those k where three
// equal planets leave the line, and over the others.
std::pair<double, double> sun_sidebands(const std::vector<double>& change) {
    double left = 0.0, gone = 0.0;
    for (int k = -6; k <= 6; ++k) {
        const double line = change[static_cast<std::size_t>(2 * kRigMeshes + k * kRigSun)];
        ((64 + k) % 3 == 0 ? left : gone) += line;
    }
    return {left / 4, gone / 9};
}

TEST_CASE(
    "Separating teeth: the response jumps below the linear resonance, and the mean force carries "
    "the load") {
    const RingMesh before = ring_mesh(1), after = ring_mesh(2);
    // Softening: 25 rpm of 5250 increase the vibration fivefold; without separation by 2 %.
    CHECK(after.vibration_m > 4.0 * before.vibration_m);
    CHECK(before.apart < 0.2);
    CHECK(after.apart > 0.4);
    const std::vector<std::string> linear{"effects.separation=\"none\""};
    CHECK(ring_mesh(2, linear).vibration_m < 1.1 * ring_mesh(1, linear).vibration_m);
    CHECK(ring_mesh(0, linear).vibration_m ==
          Approx(ring_mesh(0).vibration_m).epsilon(0.05));  // contact is hardly lost there

    // Teeth in contact half of the time still carry the whole load: T / (N r_s), for any damping.
    const double force = 4.0 / (4 * 28e-3 * std::cos(20 * std::numbers::pi / 180));
    for (const RingMesh& mesh : {before, after}) {
        CHECK(mesh.mean_force_N == Approx(force).epsilon(0.02));
    }
    // Back flanks come into contact once the backlash is used up.
    const RingMesh both =
        ring_mesh(3, {"effects.separation=\"two-sided\"", "gearbox.backlash_mm=0.001"});
    const RingMesh front = ring_mesh(3);
    CHECK(front.deepest_m < -1.3e-6);
    CHECK(both.deepest_m < -1e-6);
    CHECK(both.deepest_m > front.deepest_m);
    const RingMesh wide =
        ring_mesh(3, {"effects.separation=\"two-sided\"", "gearbox.backlash_mm=0.02"});
    CHECK(wide.deepest_m == Approx(front.deepest_m).epsilon(1e-9));
}

TEST_CASE("Separating teeth that never repeat are integrated mesh by mesh, and only then") {
    const auto status = [](const char* horizon) {
        const mc::Scene scene(shipped_study(
            "published/yang-separation.toml",
            {"operation.sun_speed_rpm=5750", std::string("numerics.horizon=\"") + horizon + "\"",
             "numerics.max_meshes=400"}));
        return run_one(scene, false, 0);
    };
    CHECK(status("periodic").integration.status[0] == lockstep::LaneStatus::not_converged);
    const auto full_status = status("full");
    CHECK(full_status.integration.status[0] == lockstep::LaneStatus::ok);
    const auto& records = full_status.integration.records;
    const double largest = largest_magnitude(records[1].te);
    CHECK(largest_difference(records[1].te, records[2].te) > 1e-5 * largest);
    CHECK(std::isfinite(largest));
}

TEST_CASE("Yang, section 4.3: frequencies of the test rig") {
    const mc::Scene scene(shipped_study("published/yang-test-rig.toml"));
    const auto inputs = scene.gearbox().inputs(scene.gearbox().nominal);
    const double mesh = 1.0 / dynamics::mesh_period_s(inputs);
    CHECK(mesh == Approx(248.89).margin(0.005));
    CHECK(dynamics::frame_speed_rad_s(inputs) / (2.0 * std::numbers::pi) ==
          Approx(2.22).margin(0.005));
    CHECK(mesh / scene.gearbox().fault().pattern().length == Approx(7.78).margin(0.005));
    CHECK(mesh * 3 / scene.gearbox().fault().pattern().length == Approx(23.33).margin(0.005));
}

TEST_CASE(
    "Yang, Fig. 23: a crack of 0.2 mm has little effect; different planets make it repeat with "
    "f_rs") {
    const RigLines alike = rig_lines(true);
    const RigLines unlike = rig_lines(false);
    for (const RigLines* lines : {&alike, &unlike}) {
        CHECK(*std::max_element(lines->change.begin(), lines->change.end()) <
              1e-4 * *std::max_element(lines->healthy.begin(), lines->healthy.end()));
    }
    // The path produces 2 f_mp +- k f_c; three equal planets leave k = 1, -2, 4, ... and not 2
    // f_mp.
    const auto main = static_cast<std::size_t>(2 * kRigMeshes);
    for (int k = -6; k <= 6; ++k) {
        INFO(k);
        const double line = alike.healthy[main + static_cast<std::size_t>(k * kRigCarrier)];
        const double largest = alike.healthy[main + kRigCarrier];
        CHECK(((k - 1) % 3 == 0 ? line > 1e-4 * largest : line < kNothing * largest));
    }
    // Three equal planets leave those lines 2 f_mp + k f_rs that are multiples of f_fs; different
    // ones leave all.
    const auto [left, gone] = sun_sidebands(alike.change);
    CHECK(gone < 0.05 * left);
    const auto [unlike_left, unlike_gone] = sun_sidebands(unlike.change);
    CHECK(unlike_gone > 0.2 * unlike_left);
}

TEST_CASE("Pitch errors of healthy teeth have a larger effect than a crack of 2 mm") {
    const auto ratios = [](const std::vector<std::string>& overrides) {
        mc::Study study = shipped_study("published/yang-pitch-errors.toml", overrides);
        study.ensemble.threshold_instances = 1;
        study.ensemble.instances = 3;
        const mc::Results results = run(study);
        return results.features[feature_index(results, "window_ratio")].values;
    };
    // One healthy gearbox for the threshold, then cracks of 0, 1 and 2 mm.
    const auto without = ratios({"gearbox.pitch_error_um=0"});
    CHECK(without[1] == Approx(1.0).margin(1e-3));
    CHECK(without[3] > without[2]);
    const auto with = ratios({});
    for (const double ratio : {with[0], with[1]}) {
        CHECK(ratio - 1.0 > 5.0 * (without[3] - 1.0));
    }
}

TEST_CASE("Tones of the drive reduce the contrast of the cracked tooth's windows slightly") {
    const auto ratios = [](const char* name) {
        const mc::Results results = run(shipped_study(name));
        const auto values = [&](const char* feature) {
            return results.features[feature_index(results, feature)].values;
        };
        return std::pair{values("window_ratio").back(), values("sensor_rms").back()};
    };
    const auto [quiet, quiet_rms] = ratios("published/liang-fig-5-8.toml");
    const auto [signal_ratio, signal_rms] = ratios("published/liang-test-rig.toml");
    CHECK(signal_ratio < quiet);
    CHECK(signal_ratio - 1.0 > 0.8 * (quiet - 1.0));
    // Power adds: half the sum of the squared amplitudes below the low-pass.
    double power = 0.0;
    for (const mc::Tone& tone : shipped_study("published/liang-test-rig.toml").sensor.tones) {
        power += 0.5 * tone.amplitude_m_s2 * tone.amplitude_m_s2;
    }
    CHECK(signal_rms * signal_rms - quiet_rms * quiet_rms == Approx(power).epsilon(0.1));
}

}  // namespace gearpod::test_yang_scenes
