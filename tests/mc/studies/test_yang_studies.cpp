// Checks the shipped study of Yang et al. (2022): frequencies, phases, stiffness and the
// displacements of sun and fourth planet, sections 4.1 and 4.2.
#include "tests/mc/liang_signals.hpp"
#include "tests/test.hpp"

namespace gearpod::test_yang_studies {

using namespace gearpod::test;

constexpr const char* kStudy = "published/yang-fig-15.toml";
constexpr int kSunTeeth = 28, kPlanets = 4;
constexpr int kPassage = kSunTeeth / kPlanets;  // meshes from one planet's impulse to the next
constexpr int kMeshes = 10 * kSunTeeth;  // length of a spectrum: line i lies at i f_m / kMeshes
constexpr int kSunTurn = kMeshes / kSunTeeth, kFault = kMeshes / kPassage;  // f_rs, f_fs in lines

// Torsional displacements of case `number`, 0 healthy, over kMeshes meshes, in m.
struct Motions {
    std::vector<double> sun, planet4;
    int samples = 0;  // per mesh period
};

Motions motions(const mc::Scene& scene, int number) {
    const auto& layout = std::get<dynamics::PlanetaryLayout>(scene.solve().integration().layout);
    const auto motion = motion_of(
        scene, static_cast<std::uint64_t>(number), kMeshes,
        {layout.rotation_index(dynamics::sun), layout.rotation_index(dynamics::planet + 3)});
    return {motion[0], motion[1], scene.record().samples};
}

// Response of planet 4 in case 5.
std::vector<double> heavy_damage(const std::vector<std::string>& overrides) {
    return motions(mc::Scene(shipped_study(kStudy, overrides)), 5).planet4;
}

double range(const std::vector<double>& values) {
    const auto [low, high] = std::minmax_element(values.begin(), values.end());
    return *high - *low;
}

// The largest line within half a mesh frequency of f_m, except f_m itself, over the line at f_m.
double sideband(const std::vector<double>& lines) {
    double side = 0.0;
    for (std::size_t i = kMeshes / 2; i <= 3 * kMeshes / 2; ++i) {
        side = i == kMeshes ? side : std::max(side, lines[i]);
    }
    return side / lines[kMeshes];
}

// The largest line at no multiple of `spacing`, over the line at f_m.
double off_multiples(const std::vector<double>& lines, int spacing) {
    double off = 0.0;
    for (std::size_t i = 1; i < lines.size(); ++i) {
        off = i % static_cast<std::size_t>(spacing) == 0 ? off : std::max(off, lines[i]);
    }
    return off / lines[kMeshes];
}

// Position, in mesh periods, and height of the largest value of each stretch of `meshes` meshes.
struct Impulse {
    double at, height;
};
std::vector<Impulse> impulses(const std::vector<double>& values, int meshes, int samples) {
    std::vector<Impulse> result;
    const auto stretch = static_cast<std::size_t>(meshes * samples);
    for (std::size_t first = 0; first + stretch <= values.size(); first += stretch) {
        std::size_t peak = first;
        for (std::size_t i = first; i < first + stretch; ++i) {
            peak = std::abs(values[i]) > std::abs(values[peak]) ? i : peak;
        }
        result.push_back({static_cast<double>(peak) / samples, std::abs(values[peak])});
    }
    return result;
}

TEST_CASE("Yang, sections 4.1 and 4.2: frequencies, mesh phases, 7 and 28 meshes") {
    const mc::Scene scene(shipped_study(kStudy));
    const auto inputs = scene.gearbox().inputs(scene.gearbox().nominal);
    const double turn = 2.0 * std::numbers::pi;
    const double mesh = 1.0 / dynamics::mesh_period_s(inputs);
    const double carrier = dynamics::frame_speed_rad_s(inputs) / turn;
    CHECK(scene.gearbox().mesh_frequency_Hz == Approx(541.94).margin(0.005));
    CHECK(mesh == Approx(541.94).margin(0.005));
    CHECK(carrier == Approx(5.65).margin(0.005));
    CHECK(mesh / kSunTeeth + carrier == Approx(25.0));          // f_s
    CHECK(mesh / 34 - carrier == Approx(10.29).margin(0.005));  // f_p

    // Frequencies f_rs and f_fs from the faulty tooth's passages.
    const auto& pattern = scene.gearbox().fault().pattern();
    CHECK(mesh / pattern.length == Approx(19.35).margin(0.005));
    REQUIRE(pattern.passages.size() == kPlanets);
    CHECK(mesh * kPlanets / pattern.length == Approx(77.42).margin(0.005));
    for (std::size_t i = 1; i < kPlanets; ++i) {
        CHECK(pattern.passages[i].start - pattern.passages[i - 1].start == Approx(kPassage));
        CHECK(pattern.passages[i].pair != pattern.passages[i - 1].pair);
    }

    // Source: Table 3, beta_s = beta_r = 0, beta_rs = 1/2.
    for (int n = 0; n < kPlanets; ++n) {
        const auto phase = [&](int pair) {
            return scene.gearbox().drivetrain->pitch_phase(PairId{pair});
        };
        CHECK(std::remainder(phase(n) - phase(0), 1.0) == Approx(0.0).margin(1e-12));
        CHECK(std::remainder(phase(kPlanets + n) - phase(n) - 0.5, 1.0) ==
              Approx(0.0).margin(1e-12));
    }
}

TEST_CASE("Yang, Fig. 15: the stiffness decreases from case to case, very little in 1 and 2") {
    const mc::Scene scene(shipped_study(kStudy));
    const auto& healthy =
        scene.gearbox().pairs().curve(scene.gearbox().fault().pattern().passages[0].pair);
    constexpr int kPoints = 400;
    std::vector<double> mean_loss, largest_loss;
    for (int number = 1; number <= 5; ++number) {
        const auto cracked = scene.gearbox().fault().mesh(0, number);
        double sum = 0.0, most = 0.0;
        for (int i = 0; i < kPoints; ++i) {
            const double tau = healthy.contact_ratio() * (i + 0.5) / kPoints;
            const double left =
                total_at(*cracked, healthy.transitions(), tau) / total_at(healthy, tau);
            CHECK(left <= 1.0);
            sum += 1.0 - left;
            most = std::max(most, 1.0 - left);
        }
        mean_loss.push_back(sum / kPoints);
        largest_loss.push_back(most);
    }
    for (std::size_t i = 1; i < 5; ++i) {
        CHECK(mean_loss[i] > 1.5 * mean_loss[i - 1]);
    }
    CHECK(largest_loss[0] < 0.005);
    CHECK(largest_loss[1] < 0.025);
    CHECK(largest_loss[4] > 0.15);
}

TEST_CASE("Yang, Figs. 20-21: sidebands f_fs apart on the sun, f_rs on planet 4, none in case 1") {
    const mc::Scene scene(shipped_study(kStudy));
    const Motions healthy = motions(scene, 0);
    for (const auto* motion : {&healthy.sun, &healthy.planet4}) {
        CHECK(off_multiples(test::lines(*motion), kMeshes) < kNothing);
    }
    const std::vector<int> numbers{1, 3, 5};
    std::vector<double> sun_sides, planet_sides;
    for (const int number : numbers) {
        INFO("case " << number);
        const Motions cracked = motions(scene, number);
        const auto sun = test::lines(cracked.sun), planet4 = test::lines(cracked.planet4);
        sun_sides.push_back(sideband(sun));
        planet_sides.push_back(sideband(planet4));
        // Four equal planets in phase leave only f_fs on the sun, within the convergence tolerance.
        CHECK(off_multiples(sun, kFault) < kNothing);
        CHECK(off_multiples(planet4, kSunTurn) < kNothing);
        CHECK(off_multiples(planet4, kFault) > 0.1 * sideband(planet4));
    }
    // Limit of visibility in a plot on a linear scale: a five-hundredth of the mesh line.
    constexpr double kOutOfSight = 1.0 / 500;
    CHECK(sun_sides[0] < kOutOfSight);
    CHECK(planet_sides[0] < kOutOfSight);
    CHECK(sun_sides[1] > 3 * kOutOfSight);
    CHECK(planet_sides[1] > 3 * kOutOfSight);
    for (std::size_t i = 1; i < 3; ++i) {
        CHECK(sun_sides[i] > 3.0 * sun_sides[i - 1]);
        CHECK(planet_sides[i] > 3.0 * planet_sides[i - 1]);
        CHECK(planet_sides[i] > sun_sides[i]);  // more distinct on the planet
    }
}

TEST_CASE("Yang, Figs. 17-19: impulses every 7 meshes on the sun and every 28 on planet 4") {
    const mc::Scene scene(shipped_study(kStudy));
    const Motions healthy = motions(scene, 0), cracked = motions(scene, 5);
    const Motions slight = motions(scene, 1);
    const auto sun = difference(cracked.sun, healthy.sun);
    const auto planet4 = difference(cracked.planet4, healthy.planet4);
    const double sample = 1.0 / healthy.samples;

    const auto on_sun = impulses(sun, kPassage, healthy.samples);
    for (std::size_t i = 1; i < on_sun.size(); ++i) {
        CHECK(on_sun[i].at - on_sun[i - 1].at == Approx(kPassage).margin(1.5 * sample));
        CHECK(on_sun[i].height == Approx(on_sun[0].height).epsilon(1e-6));
    }
    const auto on_planet = impulses(planet4, kSunTeeth, healthy.samples);
    for (std::size_t i = 1; i < on_planet.size(); ++i) {
        CHECK(on_planet[i].at - on_planet[i - 1].at == Approx(kSunTeeth).margin(1.5 * sample));
    }
    // Passages of the other planets have a smaller effect on planet 4.
    const auto all = impulses(planet4, kPassage, healthy.samples);
    for (std::size_t i = 0; i < 4; ++i) {
        CHECK((all[i].height == on_planet[0].height || all[i].height < 0.5 * on_planet[0].height));
    }
    // Case 5 is distinct, on the planet more than on the sun; case 1 is hard to observe.
    const double of_sun = largest_magnitude(sun) / range(healthy.sun);
    const double of_planet = largest_magnitude(planet4) / range(healthy.planet4);
    CHECK(of_sun > 0.05);
    CHECK(of_planet > 1.5 * of_sun);
    CHECK(largest_magnitude(difference(slight.planet4, healthy.planet4)) <
          0.005 * range(healthy.planet4));
}

TEST_CASE(
    "Newmark's method at T_m / 300 agrees with Yang's gearbox within a percent, with order 2") {
    const auto planet4 = [](const char* integrator, int steps) {
        return heavy_damage({"numerics.integrator=\"" + std::string(integrator) + "\"",
                             "numerics.steps_per_mesh=" + std::to_string(steps)});
    };
    const auto exact = planet4("rk4", 600);
    const auto error = [&](const char* integrator, int steps) {
        return largest_magnitude(difference(planet4(integrator, steps), exact)) / range(exact);
    };
    const double printed = error("newmark", 300);
    CHECK(printed < 0.01);
    CHECK(printed > 0.001);
    CHECK(printed / error("newmark", 1200) == Approx(16).epsilon(0.5));
    CHECK(error("sdirk3", 300) < 0.2 * printed);
}

TEST_CASE("At Yang's load no tooth loses contact, with a transmission error of 0 or 5 um") {
    for (const std::string error : {"0", "5"}) {
        const auto planet4 = [&](const std::string& separation) {
            return heavy_damage({"effects.separation=\"" + separation + "\"",
                                 "gearbox.sun_planet.error_um=[" + error + "]",
                                 "gearbox.ring_planet.error_um=[" + error + "]"});
        };
        const auto held = planet4("none");
        CHECK(largest_magnitude(difference(planet4("one-sided"), held)) < 1e-9 * range(held));
    }
}

}  // namespace gearpod::test_yang_studies
