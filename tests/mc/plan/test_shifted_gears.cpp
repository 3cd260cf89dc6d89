// Checks studies of gears with profile shift, and of gears with rims and webs.
#include "mc/study/gears.hpp"
#include "tests/mc/study_example.hpp"
#include "tests/mc/study_file.hpp"

namespace gearpod::test_shifted_gears {

using mc::Member;
using mc::MeshKind;
using mc::Scene;
using namespace test;

// Problems of a study of Liang's gearbox with these overrides.
mc::Problems problems_of(const std::vector<std::string>& overrides) {
    const auto reading = mc::read_study_text(tests::kExampleStudy, "study.toml", overrides);
    CHECK(!reading.study);
    return reading.problems;
}

const std::vector<std::string> kBell{"gearbox.sun.teeth=27", "gearbox.planet.teeth=35",
                                     "gearbox.ring.teeth=99", "gearbox.sun.shift=0.3",
                                     "gearbox.centre_distance_mm=100.0125"};

TEST_CASE("Shifts of zero and the standard centre distance give the bits of omitted ones") {
    const auto few =
        joined(tests::kFast, {"ensemble.instances=6", "ensemble.threshold_instances=1"});
    const auto reference = feature_bits(study_of_text(tests::kExampleStudy, few));
    for (const std::vector<std::string>& given :
         {std::vector<std::string>{"gearbox.sun.shift=0", "gearbox.planet.shift=0",
                                   "gearbox.ring.shift=0"},
          {"gearbox.planet.shift=0.0", "gearbox.centre_distance_mm=79.375"},
          {"gearbox.centre_distance_mm=79.375"}}) {
        CHECK(feature_bits(study_of_text(tests::kExampleStudy, joined(few, given))) == reference);
    }
}

TEST_CASE("A shifted gearbox works at its centre distance, its planets at assembly positions") {
    const mc::Study study = study_of_text(tests::kExampleStudy, kBell);
    const Scene scene(study);
    const auto planets = gears::planet_positions(mc::planetary_train(study));
    CHECK(planets.step == std::vector<int>{0, 32, 63, 95});
    const double distance = mc::centre_distance_m(study);
    CHECK(distance == 0.1000125);
    for (const mc::SceneMesh& mesh : scene.gearbox().stiffness->meshes()) {
        REQUIRE(mesh.geometry);
        CHECK(mesh.geometry->backlash() == Approx(0).margin(1e-12));
        CHECK(mesh.geometry->centre_distance() == distance);
        CHECK(mesh.stiffness->contact_ratio() == mesh.geometry->contact_ratio());
        CHECK(mesh.geometry->contact_ratio() > 1.2);
    }
    // The dynamic model, its forces and the teeth agree on the working angles.
    const auto& layout = std::get<dynamics::PlanetaryLayout>(scene.solve().integration().layout);
    const double angle_s =
        scene.gearbox().stiffness->meshes()[0].geometry->working_pressure_angle();
    const double angle_r =
        scene.gearbox().stiffness->meshes()[1].geometry->working_pressure_angle();
    CHECK(layout.sun_mesh_angle() == Approx(angle_s).epsilon(1e-14));
    CHECK(layout.ring_mesh_angle() == Approx(angle_r).epsilon(1e-14));
    CHECK(angle_s > study.gearbox.pressure_angle_rad);
    CHECK(angle_r < study.gearbox.pressure_angle_rad);
    const auto in = scene.gearbox().inputs(mc::nominal_inputs(study));
    const auto& forces = std::get<dynamics::PlanetaryInputs>(in).force_N;
    CHECK(forces[dynamics::carrier] ==
          Approx(-forces[dynamics::sun] * (std::cos(angle_s) + std::cos(angle_r))).epsilon(1e-12));
    // Phases repeat with the planets' positions; the phase of the ring relative to the sun follows
    // from the planet's flanks.
    const auto& drivetrain =
        dynamic_cast<const mc::PlanetaryDrivetrain&>(*scene.gearbox().drivetrain);
    for (int n = 0; n < 4; ++n) {
        const double turn = planets.step[static_cast<std::size_t>(n)] / 126.0;
        CHECK(std::cos(2 * std::numbers::pi * (drivetrain.pitch_phase(PairId{n}) - 27 * turn)) ==
              Approx(1).margin(1e-9));
        CHECK(std::cos(2 * std::numbers::pi *
                       (drivetrain.pitch_phase(PairId{4 + n}) + 99 * turn -
                        drivetrain.ring_to_sun_phase())) == Approx(1).margin(1e-9));
    }
}

TEST_CASE("Standard planets that cannot be spaced equally take the nearest positions, too") {
    const auto three =
        mc::planetary_train(study_of_text(tests::kExampleStudy, {"gearbox.planets=3"}));
    CHECK(gears::planet_positions(three).step == std::vector<int>{0, 33, 67});
    const auto four = mc::planetary_train(study_of_text(tests::kExampleStudy));
    CHECK(four.positions_rad.empty());
}

TEST_CASE("Faults of shifted teeth weaken them, up to a size that follows their shape") {
    for (const std::string profile : {"base-circle", "root-circle", "fillet"}) {
        for (const std::string where :
             {"member='sun'", "member='ring'", "member='planet'\nfault.side='sun'",
              "member='planet'\nfault.side='ring'"}) {
            auto changes = joined(kBell, {"gearbox.tooth_profile='" + profile + "'"});
            const auto side = where.find('\n');
            changes.push_back("fault." + where.substr(0, side));
            std::string text = tests::kExampleStudy;
            if (side == std::string::npos) {
                text.replace(text.find("side = \"ring\"\n"), 14, "");
            } else {
                changes.push_back(where.substr(side + 1));
            }
            changes.emplace_back("random.fault.depth_mm.values=[0, 1, 2]");
            INFO(profile << " " << where);
            const Scene scene(study_of_text(text, changes));
            CHECK(scene.gearbox().fault().largest_size() > 3e-3);
            const auto& healthy =
                *scene.gearbox()
                     .stiffness
                     ->meshes()[scene.gearbox().fault().pattern().passages[0].pair < 4 ? 0 : 1]
                     .stiffness;
            const auto cracked = scene.gearbox().fault().mesh(0, 2e-3);
            const double tau = 0.5 * healthy.contact_ratio();
            const double whole = stiffness::total_at(healthy, tau - std::floor(tau));
            CHECK(stiffness::total_at(*cracked, healthy.transitions(), tau) < 0.99 * whole);
        }
    }
    // A thicker tooth breaks at a deeper crack.
    const auto largest = [](const std::vector<std::string>& shifts) {
        return Scene(study_of_text(tests::kExampleStudy, joined({"fault.side='sun'"}, shifts)))
            .gearbox()
            .fault()
            .largest_size();
    };
    CHECK(largest({"gearbox.planet.shift=0.2", "gearbox.sun.shift=-0.2"}) > 1.02 * largest({}));
}

TEST_CASE("Impossible shifted gears are refused with the relevant numbers") {
    CHECK(has_problem(problems_of({"gearbox.ring.teeth=83"}), "gearbox.ring.teeth",
                      "or with profile shift"));
    CHECK(has_problem(problems_of({"gearbox.centre_distance_mm=73"}), "gearbox.centre_distance_mm",
                      "no more than that of the base circles, 74.5881 mm"));
    CHECK(has_problem(problems_of({"gearbox.sun.shift=0", "gearbox.planet.shift=0",
                                   "gearbox.centre_distance_mm=79"}),
                      "gearbox.centre_distance_mm", "thicker than the pitch"));
    CHECK(has_problem(problems_of({"gearbox.sun.shift=1.9", "gearbox.planet.shift=-1.9"}),
                      "gearbox.sun.teeth", "flanks of a tooth cross below the tip circle"));
    CHECK(has_problem(problems_of({"gearbox.sun.tip_mm=69"}), "gearbox.sun.tip_mm",
                      "into the root circle of 31 teeth"));
    CHECK(has_problem(problems_of({"gearbox.sun.tip_mm=55"}), "gearbox.sun.teeth",
                      "lies inside the base circle, 56.6"));
    CHECK(has_problem(problems_of({"gearbox.sun.tip_mm=51"}), "gearbox.sun.teeth",
                      "does not lie outside the root circle"));
    CHECK(
        has_problem(problems_of(joined(kBell, {"gearbox.planets=6"})), "gearbox.planets", "touch"));
    CHECK(
        has_problem(problems_of(joined(kBell, {"gearbox.planet_positions_deg=[0, 40, 180, 220]"})),
                    "gearbox.planet_positions_deg", "of planets 1 and 2 touch"));
    CHECK(has_problem(problems_of({"gearbox.pinion.shift=0.1"}), "gearbox.pinion.shift",
                      "only for gearbox.kind = \"fixed-shaft\""));
    CHECK(has_problem(problems_of({"gearbox.sun.shift=3"}), "gearbox.sun.shift",
                      "must be > -2 and < 2"));
}

// Source: the pair 17/96 of a geometry report, shifts 0.2 and 0.5 (0.5 outwards), 14 mm, 557.089
// mm, 21.125 degrees. The matching sun has 62 teeth.
TEST_CASE("The shifts of planet and ring give the centre distance and the sun's shift") {
    const mc::Study study = study_of_text(
        tests::kExampleStudy,
        {"gearbox.planets=3", "gearbox.sun.teeth=62", "gearbox.planet.teeth=17",
         "gearbox.ring.teeth=96", "gearbox.module_mm=14", "gearbox.planet.shift=0.2",
         "gearbox.ring.shift=-0.5", "gearbox.tooth_profile='fillet'", "fault.depth_mm=0"});
    CHECK(1e3 * mc::centre_distance_m(study) == Approx(557.089).margin(5e-4));
    CHECK(mc::working_angle_rad(study, MeshKind::ring_planet) * 180 / std::numbers::pi ==
          Approx(21.125).margin(5e-4));
    CHECK(mc::gear_of(study, Member::sun).profile_shift == Approx(0.1).margin(5e-4));
    const Scene scene(study);
    for (const mc::SceneMesh& mesh : scene.gearbox().stiffness->meshes()) {
        CHECK(mesh.geometry->backlash() == Approx(0).margin(1e-12));
    }
}

TEST_CASE("A ring's shift that leaves backlash is refused with the value that leaves none") {
    // Sun and planet determine the distance, which requires another shift of the ring.
    const std::string three = "gearbox.ring.shift";
    const auto loose = problems_of({"gearbox.sun.teeth=27", "gearbox.planet.teeth=35",
                                    "gearbox.ring.teeth=99", "gearbox.sun.shift=0.3",
                                    "gearbox.planet.shift=0.2286", "gearbox.ring.shift=0.1"});
    INFO(format(loose));
    CHECK(has_problem(loose, three, "of backlash between planets and ring"));
    CHECK(has_problem(loose, three, "(a shift of 0.24"));
    // An explicit distance with the planet's shift makes the ring's shift intentional.
    CHECK(mc::read_study_text(
              tests::kExampleStudy, "study.toml",
              joined(kBell, {"gearbox.planet.shift=0.2286", "gearbox.ring.shift=0.1"}))
              .study);
    CHECK(
        has_problem(problems_of(joined(kBell, {"gearbox.ring.shift=0.1"})), three, "of backlash"));
}

TEST_CASE("Real sets that standard teeth cannot form run with their windows on every gear") {
    for (const char* name : {"bell-206b.toml", "snu-rig.toml"}) {
        INFO(name);
        const auto rows =
            run(shipped_study(name, {"ensemble.instances=5", "ensemble.threshold_instances=2"}));
        std::size_t windows = 0;
        for (const auto& feature : rows.features) {
            if (feature.name.find("window_ratio") == std::string::npos) {
                continue;
            }
            ++windows;
            for (const double value : feature.values) {
                CHECK(std::isfinite(value));
                CHECK(value >= 1.0);
            }
        }
        CHECK(windows >= 3);
    }
}

const std::vector<std::string> kBodies{"effects.foundation='elastic-ring'",
                                       "gearbox.sun.bore_mm=26", "gearbox.planet.bore_mm=40",
                                       "gearbox.ring.outer_mm=310"};

Scene scene_with(const std::vector<std::string>& more) {
    return Scene(study_of_text(tests::kExampleStudy, joined(kBodies, more)));
}

double mean(const Scene& scene, std::size_t mesh) {
    return mean_total(*scene.gearbox().stiffness->meshes()[mesh].stiffness);
}

// Source: ISO 6336-1, 1 + ln(b_s / b) / (5 exp(s_R / (5 m_n))).
TEST_CASE("The meshes of planets with rims and webs have their blank factor") {
    const Scene discs = scene_with({});
    const mc::Gearbox gearbox = test::study_of_text(tests::kExampleStudy, kBodies).gearbox;
    const double face_mm = 1e3 * *gearbox.face_width_m, module_mm = 1e3 * *gearbox.module_m;
    const auto factor = [&](double web_mm, double rim_mm) {
        return 1.0 + std::log(web_mm / face_mm) / (5.0 * std::exp(rim_mm / (5.0 * module_mm)));
    };
    const Scene planets = scene_with({"gearbox.planet.rim_mm=8", "gearbox.planet.web_mm=10"});
    CHECK(mean(planets, 0) == Approx(factor(10, 8) * mean(discs, 0)).epsilon(1e-9));
    CHECK(mean(planets, 1) == Approx(factor(10, 8) * mean(discs, 1)).epsilon(1e-9));
}

TEST_CASE("A web as wide as the face changes no bit") {
    const Scene discs = scene_with({});
    const Scene webs = scene_with({"gearbox.planet.rim_mm=8", "gearbox.planet.web_mm=38.1"});
    CHECK(mean(webs, 0) == mean(discs, 0));
    CHECK(mean(webs, 1) == mean(discs, 1));
}

TEST_CASE("A crack reduces a mesh by the same fraction for any blanks") {
    const Scene discs = scene_with({});
    const Scene webs = scene_with({"gearbox.planet.rim_mm=8", "gearbox.planet.web_mm=10"});
    const double kept = mean(webs, 1) / mean(discs, 1);
    const auto faulty = [](const Scene& scene, double phase) {
        const auto mesh = scene.gearbox().fault().mesh(0, 2e-3);
        return total_at(*mesh, scene.gearbox().stiffness->meshes()[1].stiffness->transitions(),
                        phase);
    };
    for (const double phase : {0.1, 0.5, 0.9, 1.3})
        CHECK(faulty(webs, phase) == Approx(kept * faulty(discs, phase)).epsilon(1e-7));
}

TEST_CASE("Every gear has its own bore, and the ring its rim") {
    const Scene discs = scene_with({});
    const double sun = mean(discs, 0), ring = mean(discs, 1);
    const Scene thin_sun = scene_with({"gearbox.sun.bore_mm=40"}),
                thick_ring = scene_with({"gearbox.ring.outer_mm=330"}),
                thin_planets = scene_with({"gearbox.planet.bore_mm=60"});
    CHECK(mean(thin_sun, 1) == ring);
    CHECK(mean(thin_sun, 0) != Approx(sun).epsilon(1e-3));
    CHECK(mean(thick_ring, 0) == sun);
    CHECK(mean(thick_ring, 1) != Approx(ring).epsilon(1e-3));
    CHECK(mean(thin_planets, 0) != Approx(sun).epsilon(1e-3));
    CHECK(mean(thin_planets, 1) != Approx(ring).epsilon(1e-3));
}

}  // namespace gearpod::test_shifted_gears
