// Checks a fault of another size integrated from the healthy gearbox's states against integration
// of all meshes with it.
#include "mc/ensemble/gearbox/healthy_solution.hpp"
#include "tests/mc/ensemble/gearbox/relative_difference.hpp"
#include "tests/mc/study_file.hpp"

namespace gearpod::mc::test_healthy_solution {

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
    CHECK(test::relative_difference(changed.lane.front().sensor, expected.sensor) < 1e-6);
    CHECK(test::relative_difference(changed.lane.front().te_turn, expected.te_turn) < 1e-6);
    // The fault has an effect in the range where the two agree.
    CHECK(test::relative_difference(healthy_solution.healthy().lane.front().sensor,
                                    expected.sensor) > 0.01);
    CHECK(test::relative_difference(healthy_solution.healthy().lane.front().te_turn,
                                    expected.te_turn) > 1e-3);
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

}  // namespace gearpod::mc::test_healthy_solution
