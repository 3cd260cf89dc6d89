// Checks scenes of every kind of gearbox and degrees of freedom, from study text to recorded
// response.
#include "dynamics/gearbox_matrices.hpp"
#include "lockstep/steps/stability.hpp"
#include "tests/mc/scene_examples.hpp"
#include "tests/mc/study_example.hpp"
#include "tests/mc/study_file.hpp"

namespace gearpod::test_scenes {

using namespace tests;
using mc::Scene;

mc::GearboxTile run_one(const Scene& scene) {
    const mc::GearboxId id{mc::Group::test, 0};
    return mc::run_gearboxes(scene.tile(), std::span(&id, 1), 1,
                             {.records = lockstep::RecordOptions{.motion_meshes = 1}});
}

// Text without the line that begins with `key`.
std::string without(const std::string& text, const std::string& key) {
    const std::size_t begin = text.find("\n" + key);
    REQUIRE(begin != std::string::npos);
    return text.substr(0, begin) + text.substr(text.find('\n', begin + 1));
}

TEST_CASE("An explicit integrator on a stiff gearbox is refused with the stiff part") {
    const std::string integrator =
        GENERATE("numerics.integrator=rk4", "numerics.integrator=central-difference");
    const mc::Study study = test::study_of_text(kFixedShaftStudy, {integrator});
    // Rate of the coupling's damper between motor and pinion: c (1 / I_m + 1 / I_1).
    const double rate = 5e5 * (1.0 / 0.0021 + 1.0 / 4.3659e-4);
    const std::string what = test::check_scene_refused(
        study, "numerics.integrator", {"the damper of the motor coupling", "sdirk3"});
    const std::size_t at = what.find("at a rate of ");
    REQUIRE(at != std::string::npos);
    CHECK(std::stod(what.substr(at + 13)) == Approx(rate).epsilon(0.01));
    CHECK(Scene(test::study_of_text(kFixedShaftStudy)).solve().integration().integrator ==
          lockstep::Integrator::sdirk3);
    const Scene newmark(test::study_of_text(
        kFixedShaftStudy, {"numerics.integrator=newmark", "numerics.steps_per_mesh=77"}));
    CHECK(newmark.solve().integration().integrator == lockstep::Integrator::newmark);
    CHECK(newmark.solve().integration().grid.steps.size() >= 77);
}

TEST_CASE("Unstable steps of central differences are refused, their default steps are stable") {
    const std::string by = "numerics.integrator=central-difference";
    const Scene own(test::shipped_study("published/liang-fig-5-8.toml", {by}));
    CHECK(own.solve().integration().integrator == lockstep::Integrator::central_difference);
    const int least = own.solve().stepping().least;
    CHECK(static_cast<int>(own.solve().integration().grid.steps.size()) >= 1.04 * least);
    CHECK(run_one(own).status[0] == mc::Status::ok);
    const auto with_steps = [&](int steps) {
        return test::shipped_study("published/liang-fig-5-8.toml",
                                   {by, "numerics.steps_per_mesh=" + std::to_string(steps)});
    };
    CHECK(run_one(Scene(with_steps(least))).status[0] == mc::Status::ok);
    test::check_scene_refused(with_steps(least - 1), "numerics.steps_per_mesh",
                              {"central-difference is unstable"});
}

TEST_CASE(
    "Central differences' default steps are stable outside the pilot, and not larger than "
    "necessary") {
    const Scene scene(test::shipped_study("planet-life.toml"));
    double most = 0.0;
    for (std::uint64_t i = 1000; i < 4000; ++i) {
        const auto inputs =
            scene.gearbox().inputs(scene.sampler().draw({mc::Group::threshold, i}).inputs);
        const double limit = lockstep::longest_stable_step(
            dynamics::assemble(scene.solve().integration().layout, inputs,
                               scene.gearbox().stiffness->stiffest_pairs()),
            lockstep::Integrator::central_difference);
        most = std::max(most, dynamics::mesh_period_s(inputs) / limit);
    }
    const double longest = *std::max_element(scene.solve().integration().grid.lengths.begin(),
                                             scene.solve().integration().grid.lengths.end());
    CHECK(1.0 / longest > 1.02 * most);
    CHECK(1.0 / longest < 1.1 * most);
}

TEST_CASE(
    "Single precision on a gearbox too stiff for explicit steps is refused with the stiff part") {
    test::check_scene_refused(test::study_of_text(kFixedShaftStudy, {"numerics.precision=single"}),
                              "numerics.precision", {"the damper of the motor coupling"});
}

TEST_CASE("A pilot grades the steps of a study, the same in every run") {
    const auto graded = [](const std::string& tolerance) {
        return Scene(test::study_of_text(
                         kFixedShaftStudy,
                         {"numerics.grid=graded", "numerics.grid_tolerance=" + tolerance}))
            .solve()
            .integration()
            .grid;
    };
    const auto loose = graded("1e-2"), tight = graded("1e-3");
    CHECK(loose.steps.size() < tight.steps.size());
    CHECK(tight.steps.size() <
          Scene(test::study_of_text(kFixedShaftStudy)).solve().integration().grid.steps.size());
    const auto again = graded("1e-3");
    REQUIRE(again.steps.size() == tight.steps.size());
    for (std::size_t i = 0; i < again.steps.size(); ++i) {
        CHECK(again.steps[i].phase == tight.steps[i].phase);
    }
    test::check_scene_refused([&] { graded("1e-14"); }, "numerics.grid_tolerance");
    test::check_scene_refused(
        test::study_of_text(kExampleStudy, {"numerics.integrator=rk4", "numerics.grid=graded"}),
        "numerics.grid", {"sdirk3"});
}

TEST_CASE("Scenes of other numerics share unchanged parts, and integrate as if built anew") {
    const Scene scene(test::study_of_text(kFixedShaftStudy, {"numerics.grid=graded"}));
    const auto study_with = [&](const std::vector<std::string>& overrides) {
        return test::study_of_text(kFixedShaftStudy, overrides);
    };
    const std::vector<std::string> tolerance{"numerics.grid=graded",
                                             "numerics.settle_tolerance=1e-4"};
    const Scene other_tolerance = scene.with_numerics_of(study_with(tolerance));
    CHECK(&other_tolerance.solve().integration() == &scene.solve().integration());
    CHECK(other_tolerance.solve().convergence.tolerance == 1e-4);
    const Scene uniform = scene.with_numerics_of(study_with({}));
    CHECK(&uniform.gearbox().stiffness->meshes() == &scene.gearbox().stiffness->meshes());
    CHECK(uniform.solve().integration().grid.steps.size() >
          scene.solve().integration().grid.steps.size());
    const std::vector<std::string> coarse{"numerics.stiffness_tolerance=1e-3"};
    const Scene thin = scene.with_numerics_of(study_with(coarse));
    CHECK(&thin.gearbox().stiffness->meshes() != &scene.gearbox().stiffness->meshes());
    CHECK(thin.gearbox().stiffness->mean_pairs() != scene.gearbox().stiffness->mean_pairs());
    for (const auto& [other, overrides] :
         {std::pair(&other_tolerance, tolerance), std::pair(&uniform, std::vector<std::string>{}),
          std::pair(&thin, coarse)}) {
        const auto here = run_one(*other).integration,
                   anew = run_one(Scene(study_with(overrides))).integration;
        REQUIRE(here.records.size() == anew.records.size());
        for (std::size_t i = 0; i < here.records.size(); ++i) {
            CHECK(here.records[i].acceleration == anew.records[i].acceleration);
        }
    }
    CHECK_THROWS_AS(scene.with_numerics_of(study_with({"numerics.integrator=rk4"})),
                    mc::SceneError);
}

TEST_CASE("The plan of a tile that records less is otherwise the same") {
    const Scene scene(test::study_of_text(kFixedShaftStudy));
    const mc::TilePlan less = scene.tile().recording_at_most(3);
    CHECK(less.record.recorded_meshes == 3);
    CHECK(less.record.signal_meshes == scene.record().signal_meshes);
    CHECK(&less.solve->integration() == &scene.solve().integration());
    CHECK(scene.record().recorded_meshes == scene.record().signal_meshes);
}

TEST_CASE(
    "The static deflection of a fixed-shaft gearbox is that of its mesh and bearings in series") {
    std::string text = kFixedShaftStudy;
    for (const char* key : {"sampling_Hz", "low_pass_Hz", "load_torque_N_m"}) {
        text = without(text, key);
    }
    const mc::Study study =
        test::study_of_text(text, {"effects.motion=quasi-static", "fault.kind=none"});
    const Scene scene(study);
    const auto tile = run_one(scene);
    REQUIRE(tile.integration.status[0] == lockstep::LaneStatus::ok);
    const double cosine = std::cos(M_PI / 9);
    const double r1 = 0.5 * 3.175e-3 * 19 * cosine, r2 = 0.5 * 3.175e-3 * 48 * cosine;
    const double force = 11.9 / r1;
    const std::vector<double> transitions = scene.gearbox().stiffness->transitions();
    const auto& te = tile.integration.records[0].te;
    for (std::size_t i = 0; i < te.size(); ++i) {
        const double phase = static_cast<double>(i) / static_cast<double>(te.size());
        if (std::ranges::any_of(transitions,
                                [&](double t) { return std::abs(t - phase) < 1e-6; })) {
            continue;
        }
        const double k = scene.gearbox().stiffness->pairs().total(PairId{0}, phase);
        const double slack = force / k + 2.0 * force / 6.56e7;
        CHECK(te[i] == Approx(-slack / r2).epsilon(1e-6));
    }
    // The couplings twist by T / k_c, in u by the base radii.
    const auto& q = tile.integration.records[0].motion;
    CHECK(q[dynamics::u_m] - q[dynamics::u_1] == Approx(11.9 / 4.4e4 * r1).epsilon(1e-9));
}

TEST_CASE(
    "The deflection of a planetary train driven by its carrier is that of sun, ring and support in "
    "series") {
    // Equal levels: constant stiffness along the normal of helical teeth, Park (2016), Eq. A1.
    const mc::Study study = test::study_of_text(
        without(kQuasiStaticStudy, "operation.torque_N_m"),
        {"gearbox.sun_planet.low_stiffness_N_m=2e9", "gearbox.ring_planet.low_stiffness_N_m=2.4e9",
         "gearbox.support_stiffness_N_m=1e10", "fault.kind=none"});
    const auto tile = run_one(Scene(study));
    REQUIRE(tile.integration.status[0] == lockstep::LaneStatus::ok);
    const double a = M_PI / 9, b = 7 * M_PI / 180;
    const double squared = std::pow(std::sin(a), 2) + std::pow(std::cos(a) * std::cos(b), 2);
    const double sun_radius = 0.5 * 0.010 * 16 * std::cos(std::atan(std::tan(a) / std::cos(b)));
    const double force = 180e3 * 16.0 / (16 + 68) / 3.0 / sun_radius;
    const double slack = force / (2e9 * squared) + force / (2.4e9 * squared) + 3.0 * force / 1e10;
    CHECK(std::abs(tile.integration.records[0].te[0]) == Approx(slack / sun_radius).epsilon(1e-6));
}

TEST_CASE("A planet tooth weakened on both sides meets sun and ring half a turn apart") {
    const Scene scene(test::study_of_text(kQuasiStaticStudy));
    REQUIRE(scene.gearbox().fault().curves() == 2);
    REQUIRE(scene.gearbox().fault().pattern().passages.size() == 2);
    CHECK(scene.gearbox().fault().pattern().length == 26);
    double sun = 0.0, ring = 0.0;
    for (const auto& passage : scene.gearbox().fault().pattern().passages) {
        (passage.pair < 3 ? sun : ring) = passage.start;
    }
    // The pitch points are (26 - 1) / 2 meshes apart; the engagements' starts and the phase of ring
    // and sun mesh add less than a mesh each.
    CHECK(std::abs(std::abs(ring - sun) - 13.0) < 2.0);
    const auto te = run_one(scene);
    CHECK(te.folded.empty());
}

TEST_CASE(
    "Fixed-shaft, quasi-static and pitch-error scenes give the same bits in 1, 4 and 8 lanes") {
    const std::vector<std::vector<std::string>> changes{
        {},
        {"random.gearbox.gear.mass_kg={distribution='uniform', low=2.5, high=3}",
         "sensor.tones=[{frequency_Hz=360, amplitude_m_s2=2}, {frequency_Hz=20.5, "
         "amplitude_m_s2=0.3}]"}};
    for (const auto& change : changes) {
        const auto eight = test::feature_bits(test::study_of_text(kFixedShaftStudy, change));
        for (const char* lanes : {"numerics.lanes=4", "numerics.lanes=1"}) {
            CHECK(test::feature_bits(test::study_of_text(kFixedShaftStudy,
                                                         test::joined(change, {lanes}))) == eight);
        }
    }
    const std::vector<std::string> pitch{"numerics.horizon=full", "gearbox.pitch_error_um=3"};
    const auto perfect = test::feature_bits(test::study_of_text(kQuasiStaticStudy));
    const auto eight = test::feature_bits(test::study_of_text(kQuasiStaticStudy, pitch));
    for (const char* lanes : {"numerics.lanes=4", "numerics.lanes=1"}) {
        CHECK(test::feature_bits(
                  test::study_of_text(kQuasiStaticStudy, test::joined(pitch, {lanes}))) == eight);
        CHECK(test::feature_bits(test::study_of_text(kQuasiStaticStudy, {lanes})) == perfect);
    }
    CHECK(eight != perfect);
}

TEST_CASE("The features of a fixed-shaft gearbox identify the broken tooth's revolution") {
    const std::string broken = replaced(kFixedShaftStudy,
                                        "kind = \"chip\"\nmember = \"pinion\"\nchip_mm = 8\n"
                                        "chip_height_mm = 2",
                                        "kind = \"broken\"\nmember = \"gear\"\nbroken = 1");
    const mc::Study study = test::study_of_text(broken);
    const Scene scene(study);
    CHECK(scene.record().span.planet_teeth == 48);
    CHECK(scene.record().span.meshes() == 48 * 19);
    CHECK(scene.gearbox().fault().pattern().length == 48);
    CHECK(scene.gearbox().fault().largest_size() == 1.0);
    const auto results = test::run(study);
    const auto ratio = test::feature_index(results, "window_ratio");
    CHECK(results.features[ratio].values[0] == Approx(1.0).epsilon(1e-6));  // healthy
    CHECK(results.features[ratio].values[2] > 2.0);
}

TEST_CASE("A scene of spatial cracks, coupled teeth and separation is built from its study") {
    const Scene scene(test::study_of_text(kSpatialCrackStudy));
    CHECK(scene.solve().integration().mesh_law == dynamics::MeshLaw::unilateral);
    CHECK(scene.solve().integration().nodes.tooth_pairs == 2);
    CHECK(scene.gearbox().fault().largest_size() == 5.0);
    const auto inputs =
        std::get<dynamics::PlanetaryInputs>(scene.gearbox().inputs(scene.gearbox().nominal));
    CHECK(inputs.backlash_m == Approx(1e-4));
    // Every stage reduces the stiffness more than the one before it (Yang, Fig. 15).
    double last = stiffness::total_at(scene.gearbox().pairs().curve(PairId{0}), 0.3);
    for (const double stage : {1.0, 2.0, 3.0, 4.0, 5.0}) {
        const auto mesh = scene.gearbox().fault().mesh(0, stage);
        const double now =
            total_at(*mesh, scene.gearbox().pairs().curve(PairId{0}).transitions(), 0.3);
        CHECK(now < last);
        last = now;
    }
}

}  // namespace gearpod::test_scenes
