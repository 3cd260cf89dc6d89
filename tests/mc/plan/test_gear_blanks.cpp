// Checks gears with rims and webs in a study.
#include "mc/study/gears.hpp"
#include "tests/mc/study_example.hpp"
#include "tests/mc/study_file.hpp"

namespace gearpod::test_gear_blanks {

using mc::Scene;

const std::vector<std::string> kBodies{"effects.foundation='elastic-ring'",
                                       "gearbox.sun.bore_mm=26", "gearbox.planet.bore_mm=40",
                                       "gearbox.ring.outer_mm=310"};

Scene scene_with(std::vector<std::string> more) {
    more.insert(more.end(), kBodies.begin(), kBodies.end());
    return Scene(test::study_of_text(tests::kExampleStudy, more));
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
    // Later overrides take precedence.
    const auto with = [](const char* key, const char* value) {
        std::vector<std::string> all = kBodies;
        all.push_back(std::string(key) + "=" + value);
        return Scene(test::study_of_text(tests::kExampleStudy, all));
    };
    const Scene thin_sun = with("gearbox.sun.bore_mm", "40");
    const Scene thick_ring = with("gearbox.ring.outer_mm", "330");
    const Scene thin_planets = with("gearbox.planet.bore_mm", "60");
    CHECK(mean(thin_sun, 1) == ring);
    CHECK(mean(thin_sun, 0) != Approx(sun).epsilon(1e-3));
    CHECK(mean(thick_ring, 0) == sun);
    CHECK(mean(thick_ring, 1) != Approx(ring).epsilon(1e-3));
    CHECK(mean(thin_planets, 0) != Approx(sun).epsilon(1e-3));
    CHECK(mean(thin_planets, 1) != Approx(ring).epsilon(1e-3));
}

}  // namespace gearpod::test_gear_blanks
