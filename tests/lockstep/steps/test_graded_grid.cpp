// Checks graded grids and the pilots that choose them.
#include "lockstep/integrators/facts.hpp"
#include "lockstep/steps/graded_grid.hpp"
#include "lockstep/tile/rigid_rotation.hpp"
#include "lockstep/tile/tile_integrators.hpp"
#include "tests/lockstep/liang_train.hpp"
#include "tests/test.hpp"

namespace gearpod::lockstep::test_graded_grid {

using test::LiangTrain;

constexpr auto kFull = dynamics::Motion::translational_torsional;

std::vector<double> liang_transitions() {
    return contact_transitions(LiangTrain::instance().pairs);
}

IntegrationPlan plan_of(PhaseGrid grid, Integrator integrator) {
    const auto& train = LiangTrain::instance();
    IntegrationPlan plan = train.plan(24, 24, kFull);
    plan.integrator = integrator;
    plan.grid = std::move(grid);
    plan.nodes = tabulate(train.pairs, plan.grid, dynamics::MeshDamping::ratio);
    return plan;
}

PhaseGrid for_integrator(PhaseGrid grid, Integrator integrator) {
    grid.stage_nodes = stage_nodes(integrator);
    return grid;
}

// Checks that every sample occurs once in its stated step, and that the steps cover the mesh period
// and end on every transition. Margins: of phases, and of the lengths that steps share.
void check_grid(const PhaseGrid& grid, const std::vector<double>& transitions,
                double phase_margin = 1e-11, double length_margin = 2e-12) {
    double phase = 0.0;
    int sample = 0;
    for (const Step& step : grid.steps) {
        CHECK(step.phase == Approx(phase).margin(phase_margin));
        CHECK(step.length > 0.0);
        CHECK(grid.lengths[static_cast<std::size_t>(step.kind)] ==
              Approx(step.length).margin(length_margin));
        if (step.sample >= 0) {
            CHECK(step.sample == sample++);
            CHECK(step.phase == Approx(double(step.sample) / grid.samples)
                                    .margin(std::min(phase_margin, length_margin)));
        }
        for (int n = 0; n < step.inside; ++n) {
            CHECK(step.first_inside + n == sample);
            const double at = double(sample++) / grid.samples;
            CHECK(at > step.phase);
            CHECK(at < step.phase + step.length);
        }
        phase = step.phase + step.length;
    }
    CHECK(phase == Approx(1.0));
    CHECK(sample == grid.samples);
    for (const double t : transitions) {
        double nearest = std::min(std::abs(t), std::abs(1.0 - t));
        for (const Step& step : grid.steps) {
            nearest = std::min(nearest, std::abs(step.phase - t));
        }
        CHECK(nearest < length_margin);
    }
}

TEST_CASE("The phase grid covers a mesh period with a node on every sample and transition") {
    const std::vector<double> transitions{0.75, 0.0, 0.123456789, 0.6022, 0.123456789 + 1e-15};
    const PhaseGrid grid = make_phase_grid(7, 100, transitions);
    CHECK(grid.samples == 7);
    check_grid(grid, transitions, 1e-14, 1e-12);
    for (const Step& step : grid.steps) {
        CHECK(step.length <= 1.0 / 100 + 1e-14);
        CHECK(step.inside == 0);
    }
    CHECK_THROWS_AS(make_phase_grid(0, 100, {}), std::invalid_argument);
    CHECK_THROWS_AS(make_phase_grid(5, 0, {}), std::invalid_argument);
}

Pilot liang_pilot(Integrator integrator) {
    const auto& train = LiangTrain::instance();
    Pilot pilot;
    pilot.inputs = train.spread(2.0, kPilotLanes);
    pilot.faults = train.ring_side_cracks(std::vector<double>(kPilotLanes, 4.28e-3));
    pilot.convergence_meshes = 4;
    pilot.plan = [integrator](PhaseGrid grid) { return plan_of(std::move(grid), integrator); };
    return pilot;
}

double rms_error(const machine::AlignedVector& a, const machine::AlignedVector& b) {
    double deviation = 0.0, own = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        deviation += (a[i] - b[i]) * (a[i] - b[i]);
        own += b[i] * b[i];
    }
    return std::sqrt(deviation / own);
}

TEST_CASE("Graded steps start short after a transition, double, and end on the next one") {
    const std::vector<double> transitions = liang_transitions();
    const Grading grading{1e-4, 0.25, 4e-3};
    const PhaseGrid grid = make_graded_grid(432, transitions, grading);
    check_grid(grid, transitions);
    CHECK(grid.lengths.size() <= transitions.size() + 8);
    for (const Step& step : grid.steps) {
        const double since = since_transition(transitions, step.phase);
        CHECK(step.length < 1.5 * longest_step(grading, since) + 1e-12);
    }
    // Steps are long from the beginning if there is no transition.
    CHECK(make_graded_grid(10, {}, {1.0 / 3200, 0.25, 0.01}).steps.size() == 100);
    CHECK_THROWS_AS(make_graded_grid(0, transitions, grading), std::invalid_argument);
    CHECK_THROWS_AS(make_graded_grid(10, transitions, {0.0, 1.0, 1.0}), std::invalid_argument);
}

TEST_CASE("Samples inside steps are interpolated at the integrator's order") {
    const dynamics::GearboxInputs in = LiangTrain::instance().inputs(20.0);
    const auto record_of = [&](PhaseGrid grid, Integrator integrator) {
        const IntegrationPlan plan =
            plan_of(for_integrator(std::move(grid), integrator), integrator);
        TileState state = equilibrium_state(
            plan_of(make_phase_grid(480, 480, liang_transitions()), Integrator::rk4),
            std::span(&in, 1));
        MeshRecord record = make_record(plan, 1, true);
        const auto mesh_integrator = make_mesh_integrator<1>(plan, std::span(&in, 1));
        for (int mesh = 0; mesh < 2; ++mesh) {
            (*mesh_integrator)({}, state, record);
        }
        return record;
    };
    const MeshRecord exact =
        record_of(make_phase_grid(2400, 9600, liang_transitions()), Integrator::rk4);
    for (const auto& [integrator, order] :
         {std::pair{Integrator::sdirk3, 3.0}, std::pair{Integrator::newmark, 2.0}}) {
        std::vector<double> sensors, errors, motions;
        for (const double step : {1.0 / 600, 1.0 / 1200}) {
            const PhaseGrid grid = make_graded_grid(2400, liang_transitions(), {step, 0.0, step});
            CHECK(grid.steps[2].inside > 0);
            const MeshRecord record = record_of(grid, integrator);
            sensors.push_back(rms_error(record.acceleration, exact.acceleration));
            errors.push_back(rms_error(record.te, exact.te));
            motions.push_back(rms_error(record.motion, exact.motion));
        }
        CHECK(std::log2(sensors[0] / sensors[1]) == Approx(order).margin(0.35));
        CHECK(std::log2(errors[0] / errors[1]) > order - 0.35);
        CHECK(std::log2(motions[0] / motions[1]) > order - 0.35);
    }
}

TEST_CASE("A pilot grades implicit steps: fewer than uniform ones, within the tolerance") {
    const std::vector<double> transitions = liang_transitions();
    const Pilot pilot = liang_pilot(Integrator::sdirk3);
    const auto grid_of = [&](const Grading& grading) {
        return for_integrator(make_graded_grid(216, transitions, grading), Integrator::sdirk3);
    };
    constexpr double kTolerance = 2e-3;
    const GradedChoice choice = choose_grading(pilot, 1.0 / 4000, kTolerance, grid_of);
    REQUIRE(choice.reached);
    CHECK(choice.error <= kTolerance);
    const std::size_t uniform = grid_of({1.0 / 4000, 0.0, 1.0 / 4000}).steps.size();
    CHECK(choice.grid.steps.size() < uniform);
    // Compared with another method's fine steps, for a realization and a crack outside the pilot.
    const auto& train = LiangTrain::instance();
    const std::vector<dynamics::GearboxInputs> one{train.inputs(2.0, 1.07e8)};
    const auto faults = train.ring_side_cracks({3e-3});
    const TileResult ours =
        run_tile<1>(plan_of(choice.grid, Integrator::sdirk3), one, faults, PeriodicSolution{});
    const TileResult exact =
        run_tile<1>(plan_of(make_phase_grid(216, 8640, transitions), Integrator::rk4), one, faults,
                    PeriodicSolution{});
    REQUIRE(ours.status[0] == LaneStatus::ok);
    for (std::size_t k = 0; k < ours.content.size(); ++k) {
        const auto& a = ours.records[static_cast<std::size_t>(ours.content[k])];
        const auto& b = exact.records[static_cast<std::size_t>(exact.content[k])];
        CHECK(rms_error(a.acceleration, b.acceleration) < 3 * kTolerance);
    }
    // A tolerance that cannot be met is reported.
    CHECK(!choose_grading(pilot, 1.0 / 50, 1e-12, grid_of).reached);
}

}  // namespace gearpod::lockstep::test_graded_grid
