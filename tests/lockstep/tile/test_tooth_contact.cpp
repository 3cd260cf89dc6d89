// Checks contact of single tooth pairs at the steps of a mesh period: bounds that hold between
// samples, and the share of time out of contact.
#include "dynamics/gearbox.hpp"
#include "dynamics/gearbox_matrices.hpp"
#include "lockstep/integrators/facts.hpp"
#include "lockstep/plan/tooth_pairs.hpp"
#include "lockstep/strategies/solution.hpp"
#include "lockstep/tile/mesh_forces.hpp"
#include "lockstep/tile/rigid_rotation.hpp"
#include "lockstep/tile/tile_integrators.hpp"
#include "lockstep/tile/tooth_contact.hpp"
#include "stiffness/square_wave_mesh.hpp"
#include "tests/lockstep/liang_train.hpp"
#include "tests/lockstep/tian_gearbox.hpp"
#include "tests/test.hpp"

namespace gearpod::lockstep::test_tooth_contact {

using test::LiangTrain;

constexpr double kSpeedup = 10.0;

IntegrationPlan unilateral_plan(Integrator integrator, int samples, int steps) {
    const LiangTrain& train = LiangTrain::instance();
    IntegrationPlan plan =
        train.plan(samples, steps, dynamics::Motion::translational_torsional, integrator);
    plan.mesh_law = dynamics::MeshLaw::unilateral;
    add_tooth_pairs(train.pairs, plan.grid, plan.nodes);
    return plan;
}

// Gaps of up to 0.8 um, different in each lane.
ToothErrors wavy_errors(std::size_t lanes) {
    return LiangTrain::tooth_errors(
        LiangTrain::instance().pairs, lanes, [](std::size_t gear, std::size_t i) {
            return 4e-7 * (1.0 + std::sin(static_cast<double>(7 * i + gear)));
        });
}

struct IntegratedMesh {
    MeshRecord record;
    std::vector<PairGaps> gaps;
};

// Integrates `meshes` mesh periods and keeps their step states.
std::vector<IntegratedMesh> integrate_meshes(const IntegrationPlan& plan, const ToothErrors& errors,
                                             const std::vector<dynamics::GearboxInputs>& inputs,
                                             int meshes) {
    const auto mesh_integrator = make_mesh_integrator<8>(plan, inputs);
    const RigidRotation rotation(plan.layout, inputs);
    TileState state = equilibrium_state(plan, inputs);
    std::vector<IntegratedMesh> all;
    for (int k = 0; k < meshes; ++k) {
        IntegratedMesh one{make_record(plan, 8, true), tooth_gaps(plan, errors, k)};
        size_step_states(plan, 8, one.record);
        (*mesh_integrator)({{}, one.gaps}, state, one.record);
        rotation.remove(state);
        all.push_back(std::move(one));
    }
    return all;
}

// Minimum of each lane over all stretches, pairs and tooth pairs.
std::vector<double> least_of_lanes(const machine::AlignedVector& bounds) {
    std::vector<double> least(8, INFINITY);
    for (std::size_t i = 0; i < bounds.size(); ++i) {
        least[i % 8] = std::min(least[i % 8], bounds[i]);
    }
    return least;
}

TEST_CASE(
    "Step states hold the state at the samples and continue from one mesh period to the next") {
    for (const Integrator integrator : {Integrator::rk4, Integrator::central_difference}) {
        INFO(name(integrator));
        const IntegrationPlan plan = unilateral_plan(integrator, 24, 1200);
        const auto all =
            integrate_meshes(plan, wavy_errors(8), LiangTrain::instance().spread(kSpeedup), 2);
        const std::size_t size =
            8U * static_cast<std::size_t>(dynamics::degrees_of_freedom(plan.layout));
        const MeshRecord& record = all[1].record;
        REQUIRE(record.step_states.size() == 2 * size * (plan.grid.steps.size() + 1));
        for (std::size_t s = 0; s < plan.grid.steps.size(); ++s) {
            const int sample = plan.grid.steps[s].sample;
            for (std::size_t i = 0; i < size && sample >= 0; ++i) {
                CHECK(record.step_states[2 * s * size + i] ==
                      record.motion[static_cast<std::size_t>(sample) * size + i]);
            }
        }
        // The change of displacement between samples matches the velocity to second order of the
        // step.
        double largest = 0.0, deviation = 0.0;
        for (std::size_t s = 0; s < plan.grid.steps.size(); ++s) {
            const double h = plan.grid.steps[s].length *
                             dynamics::mesh_period_s(LiangTrain::instance().spread(kSpeedup)[0]);
            const double* now = record.step_states.data() + 2 * s * size;
            for (std::size_t i = 0; i < size; i += 8) {
                const double step = 0.5 * h * (now[size + i] + now[3 * size + i]);
                largest = std::max(largest, std::abs(step));
                deviation = std::max(deviation, std::abs(now[2 * size + i] - now[i] - step));
            }
        }
        CHECK(deviation < 0.1 * largest);
    }
}

TEST_CASE("A contact bound from long steps holds for the state that short steps find") {
    const ToothErrors errors = wavy_errors(8);
    const auto inputs = LiangTrain::instance().spread(kSpeedup);
    for (const Integrator integrator : {Integrator::rk4, Integrator::central_difference}) {
        INFO(name(integrator));
        const IntegrationPlan coarse = unilateral_plan(integrator, 24, 1200),
                              fine = unilateral_plan(integrator, 4800, 4800);
        const ToothContact coarse_contact(coarse, dynamics::mesh_periods_s(inputs)),
            fine_contact(fine, dynamics::mesh_periods_s(inputs));
        const auto rough = integrate_meshes(coarse, errors, inputs, 6),
                   exact = integrate_meshes(fine, errors, inputs, 6);
        const auto bound = least_of_lanes(
            coarse_contact.least_compression(rough[5].record, rough[5].gaps, nullptr));
        const auto found =
            least_of_lanes(fine_contact.least_compression(exact[5].record, exact[5].gaps, nullptr));
        for (std::size_t l = 0; l < 8; ++l) {
            INFO("lane " << l);
            // Contact deflection is 1 um; long steps of order 2 have an error of up to 3 % of it.
            CHECK(bound[l] < 1.1 * found[l]);
            CHECK(bound[l] > found[l] - 2e-7);
        }
    }
}

TEST_CASE("Bounds of parts add up to a bound of their sum") {
    const IntegrationPlan plan = unilateral_plan(Integrator::rk4, 24, 1200);
    const auto inputs = LiangTrain::instance().spread(kSpeedup);
    const ToothContact contact(plan, dynamics::mesh_periods_s(inputs));
    const auto none = integrate_meshes(plan, wavy_errors(8), inputs, 1);
    const auto all = integrate_meshes(plan, wavy_errors(8), inputs, 4);
    const MeshRecord &periodic_record = none[0].record, &whole = all[3].record;
    const auto of_periodic_record = contact.least_compression(periodic_record, {}, nullptr);
    const auto of_rest = contact.least_compression(whole, all[3].gaps, &periodic_record);
    const auto of_whole = contact.least_compression(whole, all[3].gaps, nullptr);
    double tightest = INFINITY;
    for (std::size_t i = 0; i < of_whole.size(); ++i) {
        if (std::isfinite(of_whole[i])) {
            CHECK(of_periodic_record[i] + of_rest[i] <= of_whole[i] + 1e-15);
            tightest = std::min(tightest, of_whole[i] - of_periodic_record[i] - of_rest[i]);
        }
    }
    CHECK(tightest < 1e-6);
}

// Every second pinion tooth has a gap that no load closes: its tooth pair carries no load while
// another pair does. With contact ratio c between 1 and 2 that is 2 (c - 1) of its engagement of c,
// so the share over all tooth pairs is (c - 1) / c.
TEST_CASE("The share of time out of contact of large gaps is that of the double-pair zones") {
    const auto& gearbox = test::TianGearbox::instance();
    for (const double ratio : {1.25, 1.5, 1.75}) {
        INFO("contact ratio " << ratio);
        const stiffness::SquareWaveMesh mesh(3e8, 6e8, ratio);
        const PairSet pairs{{&mesh}, {0.0}, false};
        IntegrationPlan plan = gearbox.plan(32, 32, Integrator::rk4);
        plan.mesh_law = dynamics::MeshLaw::unilateral;
        plan.grid = make_phase_grid(32, 32, contact_transitions(pairs));
        plan.nodes = tabulate(pairs, plan.grid, dynamics::MeshDamping::proportional);
        add_tooth_pairs(pairs, plan.grid, plan.nodes);
        auto in = gearbox.inputs();
        in.load_torque_N_m = in.motor_torque_N_m * 48 / 19;
        const std::vector<dynamics::GearboxInputs> inputs(4, in);
        ToothErrors errors{
            {{20, machine::AlignedVector(20 * 4, 0.0)}, {48, machine::AlignedVector(48 * 4, 0.0)}},
            fixed_shaft_teeth()};
        for (std::size_t tooth = 0; tooth < 20; tooth += 2) {
            errors.gears[0].error_m[tooth * 4 + 1] = 1e-3;  // in lane 1 alone
        }
        const TileResult tile =
            run_tile<4>(plan, inputs, FaultCurves{&pairs, {}, {}},
                        QuasiStaticSolution{StaticSpan{.meshes = 960, .tooth_errors = &errors}});
        REQUIRE(tile.contact_loss.size() == 4);
        CHECK(tile.contact_loss[0] == 0.0);
        CHECK(tile.contact_loss[1] == Approx((ratio - 1.0) / ratio).epsilon(0.02));
        CHECK(tile.contact_loss[2] == 0.0);
    }
}

TEST_CASE(
    "One mesh period in 144 is evaluated, including every tooth of any gear and the first one") {
    for (const int teeth : {1, 19, 20, 24, 31, 64, 81}) {
        INFO(teeth << " teeth");
        std::vector<int> counted(static_cast<std::size_t>(teeth), 0);
        const auto meshes = 20 * static_cast<int>(kContactMeshes) * teeth;
        for (int k = 0; k < meshes; ++k) {
            counted[static_cast<std::size_t>(k % teeth)] += counts_contact(k) ? 1 : 0;
        }
        CHECK(counts_contact(0));
        for (const int count : counted) {
            CHECK(count == Approx(20).margin(10));
        }
        CHECK(std::accumulate(counted.begin(), counted.end(), 0) == Approx(20 * teeth).margin(3));
    }
}

TEST_CASE("The share of time out of contact keeps its bits for any lanes and is zero under load") {
    const IntegrationPlan plan = unilateral_plan(Integrator::rk4, 24, 1200);
    auto inputs = LiangTrain::instance().spread(kSpeedup);
    for (dynamics::GearboxInputs& in : inputs) {
        auto& train = std::get<dynamics::PlanetaryInputs>(in);
        for (double& force : train.force_N) {
            force *= 0.2;
        }
    }
    const ToothErrors errors = wavy_errors(8);
    const FaultCurves faults = LiangTrain::instance().no_fault(8);
    FullSolution solution{.span = {.meshes = 30, .run_in_meshes = 3}, .tooth_errors = &errors};
    const TileResult wide = run_tile<8>(plan, inputs, faults, solution);
    REQUIRE(wide.contact_loss.size() == 8 * 8);
    CHECK(*std::ranges::max_element(wide.contact_loss) > 0.01);
    CHECK(*std::ranges::max_element(wide.contact_loss) < 1.0);
    for (const std::size_t lane : {0U, 5U}) {
        ToothErrors own = wavy_errors(1);
        for (std::size_t g = 0; g < own.gears.size(); ++g) {
            for (std::size_t i = 0; i < own.gears[g].error_m.size(); ++i) {
                own.gears[g].error_m[i] = errors.gears[g].error_m[8 * i + lane];
            }
        }
        solution.tooth_errors = &own;
        const TileResult narrow = run_tile<1>(plan, std::span(inputs).subspan(lane, 1),
                                              LiangTrain::instance().no_fault(1), solution);
        for (std::size_t pair = 0; pair < 8; ++pair) {
            CHECK(narrow.contact_loss[pair] == wide.contact_loss[8 * pair + lane]);
        }
    }
    const IntegrationPlan linear =
        LiangTrain::instance().plan(24, 1200, dynamics::Motion::translational_torsional);
    CHECK(run_tile<8>(linear, inputs, LiangTrain::instance().no_fault(8), PeriodicSolution{})
              .contact_loss.empty());
}

// Checks the mesh damping of the integrated gearbox: that of its law at the stiffness of the phase.

TEST_CASE("The mesh's damping force is the rate of its deflection times the law's damping") {
    const auto& gearbox = test::TianGearbox::instance();
    const std::pair<dynamics::MeshDamping, double> laws[] = {
        {dynamics::MeshDamping::ratio, 0.05}, {dynamics::MeshDamping::proportional, 4e-6}};
    for (const auto& [law, parameter] : laws) {
        IntegrationPlan plan = gearbox.plan(60, 60, Integrator::rk4);
        plan.nodes = tabulate(gearbox.pairs, plan.grid, law);
        dynamics::FixedShaftLayout layout = gearbox.layout();
        layout.mesh_damping = law;
        plan.layout = layout;
        dynamics::FixedShaftInputs in = gearbox.inputs();
        in.mesh_damping = parameter;
        const dynamics::GearboxInputs inputs = in;
        const MeshForces<1> forces(plan, std::span(&inputs, 1));
        const auto nodes = plan.grid.stage_nodes.size();
        const std::vector<double> q(dynamics::fixed_shaft_motions, 0.0);
        std::vector<double> v(q);
        v[dynamics::u_1] = 0.25;
        for (std::size_t step = 0; step < plan.grid.steps.size(); ++step) {
            double force = 0.0;
            forces.at(static_cast<int>(step), {}, q, v, &force);
            const double k = plan.nodes.stiffness[step * nodes];
            CHECK(force ==
                  Approx(0.25 * mesh_damping_N_s_m(
                                    law, mesh_damping_factor(plan.layout, inputs, PairId{0}), k)));
        }
    }
}

}  // namespace gearpod::lockstep::test_tooth_contact
