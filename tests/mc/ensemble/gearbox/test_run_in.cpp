// Checks the run-in before the first recorded mesh against a much longer run-in, and a fault of
// another size integrated from the healthy gearbox's states against integration of all meshes.
#include <fmt/format.h>

#include "lockstep/strategies/solution.hpp"
#include "mc/ensemble/gearbox/healthy_solution.hpp"
#include "mc/ensemble/gearbox/tile_random_inputs.hpp"
#include "tests/mc/study_file.hpp"

namespace gearpod::mc::test_run_in {

// Root mean square of the difference over that of the second signal.
template <class Signal>
double relative_difference(const Signal& a, const Signal& b) {
    REQUIRE(a.size() == b.size());
    double difference = 0.0, squares = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        difference += (a[i] - b[i]) * (a[i] - b[i]);
        squares += b[i] * b[i];
    }
    return std::sqrt(difference / squares);
}

// The first recorded mesh of a gearbox with real teeth after so many others.
lockstep::MeshRecord first_mesh(const Scene& scene, int run_in, bool nominal = false) {
    Realization gearbox = scene.sampler().draw({Group::test, 3});
    if (nominal) {
        gearbox.inputs = scene.gearbox().nominal;
    }
    gearbox.inputs.fault_size = 0.0;
    const dynamics::GearboxInputs inputs = scene.gearbox().inputs(gearbox.inputs);
    const auto errors =
        draw_tooth_errors(*scene.gearbox().tooth_errors, scene.draw(), std::span(&gearbox, 1));
    lockstep::FaultCurves faults{&scene.gearbox().pairs(), scene.gearbox().fault().pattern(), {}};
    faults.curve.assign(static_cast<std::size_t>(scene.gearbox().fault().curves()), {nullptr});
    const lockstep::FullSolution solution{
        .convergence = {.tolerance = 1e-10, .max_meshes = scene.solve().convergence.max_meshes},
        .span = {.meshes = 1, .run_in_meshes = run_in},
        .tooth_errors = &errors};
    const lockstep::TileResult tile =
        lockstep::run_tile<1>(scene.solve().integration(), std::span(&inputs, 1), faults, solution);
    REQUIRE(tile.status.front() == lockstep::LaneStatus::ok);
    return tile.records.at(static_cast<std::size_t>(tile.content.front()));
}

TEST_CASE("The initial transient with real teeth has decayed when recording begins") {
    const Scene scene(test::shipped_study("planet-life.toml",
                                          {"numerics.precision=\"double\"", "numerics.lanes=1"}));
    const int run_in = scene.solve().run_in_meshes;
    CHECK(run_in <= 10);
    const lockstep::MeshRecord own = first_mesh(scene, run_in), late = first_mesh(scene, 100);
    CHECK(relative_difference(own.acceleration, late.acceleration) <
          scene.solve().convergence.tolerance);
    CHECK(relative_difference(own.te, late.te) < scene.solve().convergence.tolerance);
    // The transient is large without a run-in.
    CHECK(relative_difference(first_mesh(scene, 0).acceleration, late.acceleration) > 0.01);
}

TEST_CASE("The run-in follows from the slower of gearbox and sensor, and from the tolerance") {
    const auto run_in = [](std::vector<std::string> keys) {
        keys.emplace_back("gearbox.tooth_quality=6");
        return Scene(test::shipped_study("planet-crack-ideal.toml", keys)).solve().run_in_meshes;
    };
    // Decay of the low-pass' slower section is 0.3827 2 pi 0.5 Hz = 1.2 1/s, and a mesh takes
    // 1/11.97 s: 91.7 meshes to 1e-4. Twice that is limited to half of the allowed meshes until
    // convergence.
    CHECK(run_in({"sensor.low_pass_Hz=0.5", "numerics.settle_tolerance=1e-4"}) == 100);
    // Twice the meshes to 1e-2: 45.9 / 2 at 1 Hz.
    CHECK(run_in({"sensor.low_pass_Hz=1", "numerics.settle_tolerance=1e-2"}) == 46);
    CHECK(run_in({"sensor.low_pass_Hz=1", "numerics.settle_tolerance=1e-4"}) == 92);
}

// Inertial terms make the rigid rotation grow and decay slowly, which does not affect vibration.
TEST_CASE(
    "The nominal run-in suffices at 5 to 20,000 rpm of the sun, with and without inertial terms") {
    for (const double carrier_rpm : {0.95, 57.0, 300.0, 3800.0}) {
        std::vector<int> run_ins;
        for (const bool inertial_terms : {false, true}) {
            const double mesh_Hz = 81 * carrier_rpm / 60;
            const Scene scene(
                test::shipped_study("planet-crack-ideal.toml",
                                    {"gearbox.tooth_quality=6", "numerics.lanes=1",
                                     fmt::format("effects.inertial_terms={}", inertial_terms),
                                     fmt::format("operation.carrier_speed_rpm={}", carrier_rpm),
                                     fmt::format("sensor.low_pass_Hz={}", 4 * mesh_Hz),
                                     fmt::format("sensor.sampling_Hz={}", 16 * mesh_Hz),
                                     fmt::format("sensor.encoder_sampling_Hz={}", 16 * mesh_Hz)}));
            run_ins.push_back(scene.solve().run_in_meshes);
            const lockstep::MeshRecord own = first_mesh(scene, run_ins.back(), true),
                                       late = first_mesh(scene, 2 * run_ins.back(), true);
            INFO(carrier_rpm << " rpm, run-in " << run_ins.back());
            CHECK(relative_difference(own.acceleration, late.acceleration) < 1e-9);
            CHECK(relative_difference(own.te, late.te) < 1e-9);
        }
        CHECK(run_ins[1] < 1.2 * run_ins[0]);
    }
}

Study real_teeth(const std::string& convergence_tolerance) {
    return test::shipped_study("planet-life.toml",
                               {"numerics.precision=\"double\"", "numerics.lanes=1",
                                "numerics.settle_tolerance=" + convergence_tolerance});
}

TEST_CASE("A fault changes the meshes after its passage begins, and no others") {
    const Scene scene(real_teeth("1e-8"));
    Realization gearbox = scene.sampler().draw({Group::test, 3});
    gearbox.inputs.gain = 1.0;
    gearbox.inputs.fault_size = 3e-3;
    const GearboxTile all = run_realizations(scene.tile(), {gearbox}, 1);
    const LaneSignals expected =
        lane_signals(scene.tile(), all, LaneId{0}, scene.record().span.meshes());

    const HealthySolution healthy_solution(scene.tile(), {gearbox}, 1);
    REQUIRE(healthy_solution.healthy().status.front() == Status::ok);
    const HealthySolution::Signals changed = healthy_solution.with_fault(gearbox.inputs.fault_size);
    REQUIRE(changed.status.front() == Status::ok);
    CHECK(relative_difference(changed.lane.front().sensor, expected.sensor) < 1e-6);
    CHECK(relative_difference(changed.lane.front().te_turn, expected.te_turn) < 1e-6);
    // The fault has an effect in the range where the two agree.
    CHECK(relative_difference(healthy_solution.healthy().lane.front().sensor, expected.sensor) >
          0.01);
    CHECK(relative_difference(healthy_solution.healthy().lane.front().te_turn, expected.te_turn) >
          1e-3);
}

TEST_CASE("Few meshes are integrated for a further size of a fault") {
    const Scene scene(real_teeth("1e-4"));
    Realization gearbox = scene.sampler().draw({Group::test, 5});
    gearbox.inputs.fault_size = 0.0;
    const GearboxTile healthy = run_realizations(
        scene.tile(), {gearbox}, 1, {.records = lockstep::RecordOptions{.states = true}});
    // A fault of size zero causes no change.
    const GearboxTile none =
        run_fault_perturbations(scene.tile(), {gearbox}, 1, healthy.integration.states);
    CHECK(none.integration.records.size() <=
          static_cast<std::size_t>(scene.record().span.meshes()) / 5);
    CHECK(none.status.front() == Status::ok);
    gearbox.inputs.fault_size = 4e-3;
    const GearboxTile deep =
        run_fault_perturbations(scene.tile(), {gearbox}, 1, healthy.integration.states);
    CHECK(deep.meshes < healthy.meshes / 4);
    CHECK(deep.integration.records.size() >
          static_cast<std::size_t>(scene.record().span.ring_teeth));
}

}  // namespace gearpod::mc::test_run_in
