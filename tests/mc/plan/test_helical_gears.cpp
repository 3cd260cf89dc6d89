// Checks studies of helical gears whose stiffness is computed from their teeth.
#include "gears/mesh_geometry.hpp"
#include "mc/study/gears.hpp"
#include "tests/mc/scene_examples.hpp"
#include "tests/mc/study_example.hpp"
#include "tests/mc/study_file.hpp"

namespace gearpod::test_helical_gears {

using mc::Member;
using mc::Scene;
using mc::Study;
using namespace test;

constexpr double kDegree = std::numbers::pi / 180.0;

double relative_range(const mc::SceneMesh& mesh) {
    double least = INFINITY, largest = 0.0;
    for (int i = 0; i < 200; ++i) {
        const double k = total_at(*mesh.stiffness, (i + 0.5) / 200.0);
        least = std::min(least, k);
        largest = std::max(largest, k);
    }
    return (largest - least) / mean_total(*mesh.stiffness);
}

TEST_CASE("A helix angle of zero gives the bits of an omitted one") {
    const auto few =
        joined(tests::kFast, {"ensemble.instances=4", "ensemble.threshold_instances=1"});
    const auto reference = feature_bits(study_of_text(tests::kExampleStudy, few));
    CHECK(feature_bits(study_of_text(tests::kExampleStudy,
                                     joined(few, {"gearbox.helix_angle_deg=0"}))) == reference);
}

TEST_CASE("Helical gears are the gears of their normal module in the transverse plane") {
    const mc::Study study = shipped_study("wind-turbine-helical.toml", {});
    const gears::Gear sun = gear_of(study, Member::sun);
    const double c = std::cos(8.0 * kDegree);
    CHECK(sun.module_m == Approx(0.012 / c).epsilon(1e-14));
    CHECK(std::tan(sun.pressure_angle_rad) == Approx(std::tan(20.0 * kDegree) / c));
    // Tooth heights follow the normal module.
    CHECK(sun.tip_radius() - sun.pitch_radius() == Approx(0.012));
    CHECK(sun.pitch_radius() - sun.root_radius() == Approx(0.015));
    CHECK(overlap_ratio(study) ==
          Approx(0.28 * std::sin(8.0 * kDegree) / (std::numbers::pi * 0.012)));
    // A shift moves the rack by normal modules, as in drawings and ISO 21771.
    const mc::Study shifted = shipped_study("wind-turbine-helical.toml", {"gearbox.sun.shift=0.3"});
    CHECK(gear_of(shifted, Member::sun).root_radius() - sun.root_radius() == Approx(0.3 * 0.012));
}

TEST_CASE("The stiffness of a helical set with an overlap of about one is nearly constant") {
    const mc::Study study =
        shipped_study("wind-turbine-helical.toml", {"effects.contact_onset=abrupt"});
    const Scene helical(study);
    const Scene spur(shipped_study("wind-turbine-helical.toml",
                                   {"effects.contact_onset=abrupt", "gearbox.helix_angle_deg=0",
                                    "gearbox.tooth_quality=5", "gearbox.normal_module_mm=12"}));
    for (const std::size_t mesh : {0u, 1u}) {
        const mc::SceneMesh& one = helical.gearbox().stiffness->meshes()[mesh];
        CHECK(one.stiffness->contact_ratio() ==
              Approx(one.geometry->contact_ratio() + overlap_ratio(study)));
        CHECK(relative_range(one) < 0.1 * relative_range(spur.gearbox().stiffness->meshes()[mesh]));
    }
}

// A crack's passage covers contact ratio and overlap, equally in recorded meshes that are reused
// and in meshes that are integrated one by one.
TEST_CASE("Reused and integrated meshes of a cracked helical gearbox agree") {
    const auto features = [](const std::vector<std::string>& overrides) {
        Study study = shipped_study(
            "planet-crack-ideal.toml",
            joined(overrides, {"gearbox.helix_angle_deg=12", "operation.carrier_speed_rpm=60",
                               "sensor.sampling_Hz=20000", "sensor.encoder_sampling_Hz=20000",
                               "sensor.noise_levels=[0]"}));
        study.ensemble.threshold_instances = 1;
        study.ensemble.instances = 7;
        return run(study);
    };
    const mc::Results reused = features({}), full_horizon = features({"numerics.horizon=full"});
    for (std::size_t f = 0; f < reused.features.size(); ++f) {
        INFO(reused.features[f].name);
        // The score of healthy, equal teeth is one of rounding.
        const double margin = reused.features[f].name == "window_z" ? 1e-4 : 1e-6;
        for (std::size_t row = 0; row < reused.status.size(); ++row) {
            CHECK(reused.features[f].values[row] ==
                  Approx(full_horizon.features[f].values[row]).epsilon(1e-6).margin(margin));
        }
    }
    // The last of the sizes, each used once, is the deepest; the first row is healthy.
    const auto& ratio = reused.features[feature_index(reused, "window_ratio")].values;
    CHECK(ratio.front() == Approx(1.0).epsilon(1e-5));
    CHECK(*std::max_element(ratio.begin(), ratio.end()) > 1.05);
}

// A tooth in reversed contact engages first with its other end.
TEST_CASE("A chip of helical teeth is at the end of the face that engages first") {
    // Mean time of the loss after the first contact of the tooth, in mesh periods.
    const auto loss_time = [](const char* helix, const std::vector<std::string>& more) {
        std::string text = tests::kExampleStudy;
        for (const std::string line :
             {"side = \"ring\"\n",
              "fault.depth_mm = { distribution = \"levels\", values = [0, 1, 2, 3, 4.3] }\n"}) {
            text.erase(text.find(line), line.size());
        }
        const Scene scene(study_of_text(
            text,
            joined({"fault.kind='chip'", "fault.member='sun'", "fault.chip_mm=4", helix}, more)));
        const auto mesh = scene.gearbox().fault().mesh(0, 4e-3);
        const auto& healthy = *scene.gearbox().stiffness->meshes()[0].stiffness;
        double lost = 0.0, moment = 0.0;
        for (int i = 0; i < 400; ++i) {
            const double tau = (i + 0.5) / 400.0 * mesh->duration();
            const double here =
                total_at(healthy, tau) - total_at(*mesh, healthy.transitions(), tau);
            lost += here;
            moment += here * tau;
        }
        CHECK(lost > 0.0);
        return moment / lost;
    };
    constexpr const char *kHelical = "gearbox.helix_angle_deg=20",
                         *kSpur = "gearbox.helix_angle_deg=0";
    const double overlap = overlap_ratio(study_of_text(tests::kExampleStudy, {kHelical}));
    const double from_end = 2.0 / 38.1;
    CHECK(loss_time(kHelical, {}) ==
          Approx(loss_time(kSpur, {}) + from_end * overlap).margin(0.25 * overlap));
    // The curve of reversed contact runs backwards.
    const std::vector<std::string> reversed{"operation.fixed='sun'", "operation.input='ring'",
                                            "fault.member='planet'", "fault.side='sun'"};
    CHECK(loss_time(kHelical, reversed) ==
          Approx(loss_time(kSpur, reversed) + (1.0 - from_end) * overlap).margin(0.25 * overlap));
}

TEST_CASE("A module is given in one plane only") {
    const auto problems =
        mc::read_study_text(tests::kExampleStudy, "study.toml",
                            {"gearbox.helix_angle_deg=8", "gearbox.normal_module_mm=3"})
            .problems;
    REQUIRE(problems.size() == 1);
    CHECK(problems[0].key == "gearbox.module_mm");
    CHECK(contains(problems[0].what, "gearbox.normal_module_mm is given"));
}

TEST_CASE("Relief and crowning of helical teeth change the approach under load alone") {
    const Scene plain(shipped_study("wind-turbine-helical.toml", {"effects.contact_onset=abrupt"}));
    const Scene ground(shipped_study(
        "wind-turbine-helical.toml",
        {"effects.contact_onset=abrupt", "gearbox.sun.crowning_um=10",
         "gearbox.planet.tip_relief_um=20", "gearbox.planet.tip_relief_length_mm=10"}));
    CHECK(mean_total(*ground.gearbox().stiffness->meshes()[0].stiffness) <
          mean_total(*plain.gearbox().stiffness->meshes()[0].stiffness));
    const double before = plain.gearbox().stiffness->meshes()[0].loaded->range().mean;
    CHECK(ground.gearbox().stiffness->meshes()[0].loaded->range().mean > before + 10e-6 / 3.0);
    CHECK(ground.gearbox().stiffness->meshes()[0].loaded->range().mean < before + 30e-6);
}

}  // namespace gearpod::test_helical_gears
