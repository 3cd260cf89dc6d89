// Checks stiffness at the stage nodes: one-sided at transitions, mirrored for reversed contact, and
// per lane during a fault passage.
#include "lockstep/plan/phase_grid.hpp"
#include "stiffness/faults/losses.hpp"
#include "stiffness/faults/pitting.hpp"
#include "stiffness/square_wave_mesh.hpp"
#include "tests/lockstep/liang_train.hpp"
#include "tests/numbers.hpp"

namespace gearpod::lockstep::test_stiffness_nodes {

using stiffness::Limit;
using test::LiangTrain;

PairSet ring_pair(const stiffness::MeshStiffness& mesh, double start, bool reversed) {
    return {{&mesh}, {start}, reversed};
}

// A plan with the pairs' stiffness and without dynamics.
IntegrationPlan stiffness_plan(const PairSet& pairs, std::vector<double> cuts, int steps) {
    IntegrationPlan plan;
    std::ranges::copy(contact_transitions(pairs), std::back_inserter(cuts));
    plan.grid = make_phase_grid(10, steps, cuts);
    plan.nodes = tabulate(pairs, plan.grid, dynamics::mesh_damping(plan.layout));
    return plan;
}

TEST_CASE("Nodes hold the total at any stage positions, one-sided at the ends of steps") {
    const auto& mesh = LiangTrain::instance().ring_planet;
    for (const auto& stages :
         {std::vector{0.0, 0.5, 1.0}, std::vector{0.4359, 0.7179, 1.0}, std::vector{0.0, 1.0}}) {
        for (const bool reversed : {false, true}) {
            const PairSet pairs = ring_pair(mesh, 0.37, reversed);
            PhaseGrid grid = make_phase_grid(10, 50, contact_transitions(pairs));
            grid.stage_nodes = stages;
            const StiffnessNodes nodes = tabulate(pairs, grid, dynamics::MeshDamping::ratio);
            REQUIRE(nodes.stiffness.size() == grid.steps.size() * stages.size());
            for (std::size_t i = 0; i < nodes.stiffness.size(); ++i) {
                const Step& step = grid.steps[i / stages.size()];
                const double part = stages[i % stages.size()];
                const double since = step.phase + part * step.length - 0.37;
                const double tau = reversed ? mesh.contact_ratio() - since : since;
                const bool above = (part < 1.0) != reversed;
                CHECK(nodes.stiffness[i] ==
                      Approx(total_at(mesh, tau, above ? Limit::from_above : Limit::from_below))
                          .epsilon(1e-12));
            }
        }
    }
}

TEST_CASE("Reversed contact is forward contact run backwards") {
    const auto& mesh = LiangTrain::instance().sun_planet;
    const double c = mesh.contact_ratio();
    const PairSet forward = ring_pair(mesh, 0.0, false);
    const PairSet backward = ring_pair(mesh, phase_in_period(-c), true);
    for (const double phase : {0.1, 0.3, 0.77, 0.9}) {
        CHECK(backward.total(PairId{0}, 1.0 - phase) ==
              Approx(forward.total(PairId{0}, phase)).epsilon(1e-12));
    }
}

TEST_CASE("Two broken teeth pass within a contact ratio and a mesh period, in both directions") {
    const auto& mesh = LiangTrain::instance().ring_planet;
    const double c = mesh.contact_ratio(), start = 0.37;
    // Two neighbouring teeth of the broken kind.
    struct TwoBroken : stiffness::ToothFault {
        int teeth() const override { return 2; }
        double pair_factor() const override { return 0.0; }
    };
    for (const bool reversed : {false, true}) {
        const PairSet pairs = ring_pair(mesh, start, reversed);
        const IntegrationPlan plan = stiffness_plan(pairs, {}, 50);
        FaultCurves faults{&pairs, shaft_fault_pattern(pairs, 31), {{nullptr}}};
        faults.curve[0].push_back(faulty_mesh(mesh, std::make_unique<TwoBroken>()));
        const FaultSchedule schedule(plan, faults);
        const std::size_t nodes = plan.grid.stage_nodes.size();
        for (int k = 0; k < 4; ++k) {
            const auto overrides = schedule.overrides(k);
            REQUIRE(overrides.size() == (k < start + 1 + c ? 1u : 0u));
            CHECK(schedule.continues_after(k) == (k + 1 < start + 1 + c));
            for (const PairOverride& o : overrides) {
                for (int i = o.first_step; i < o.last_step; ++i) {
                    const Step& step = plan.grid.steps[static_cast<std::size_t>(i)];
                    const double since = k + step.phase + 0.5 * step.length - start;
                    // The healthy pairs in contact are those before the first and after the second.
                    double expected = 0.0;
                    for (const int tooth : {-2, -1, 2, 3}) {
                        const double age = since - tooth;
                        expected += mesh.tooth_pair(reversed ? c - age : age);
                    }
                    const std::size_t at =
                        (static_cast<std::size_t>(i - o.first_step) * nodes + 1) * 2;
                    CHECK(o.stiffness[at + 1] == Approx(expected).epsilon(1e-12).margin(1e-3));
                    CHECK(o.stiffness[at] ==
                          plan.nodes.stiffness[static_cast<std::size_t>(i) * nodes + 1]);
                }
            }
        }
    }
}

TEST_CASE("A pit's edges are jumps at the ends of steps") {
    const auto& train = LiangTrain::instance();
    const double start = 0.37;
    const stiffness::ToothPitting family(train.ring_mesh, train.steel,
                                         stiffness::Profile::root_circle, 1,
                                         {train.planet.pitch_radius(), 1.2e-3, 0.2e-3, 2});
    for (const bool reversed : {false, true}) {
        const PairSet pairs = ring_pair(train.ring_planet, start, reversed);
        const double c = train.ring_planet.contact_ratio();
        std::vector<double> cuts;
        for (const double jump : family.jumps()) {
            cuts.push_back(phase_in_period(start + (reversed ? c - jump : jump)));
        }
        const IntegrationPlan plan = stiffness_plan(pairs, cuts, 50);
        const FaultCurves faults{&pairs,
                                 shaft_fault_pattern(pairs, 31),
                                 {{faulty_mesh(train.ring_planet, family.at(20e-3))}}};
        const auto& faulty = *faults.curve[0][0];
        const FaultSchedule schedule(plan, faults);
        const std::size_t nodes = plan.grid.stage_nodes.size();
        int jumps = 0;
        for (int k = 0; k < 4; ++k) {
            for (const PairOverride& o : schedule.overrides(k)) {
                for (int i = o.first_step; i < o.last_step; ++i) {
                    const Step& step = plan.grid.steps[static_cast<std::size_t>(i)];
                    for (std::size_t j = 0; j < nodes; ++j) {
                        const double part = plan.grid.stage_nodes[j];
                        const double since = k + step.phase + part * step.length - start;
                        const double tau = reversed ? faulty.duration() - since : since;
                        const bool above = (part < 1.0) != reversed;
                        const double expected =
                            total_at(faulty, train.ring_planet.transitions(), tau,
                                     above ? Limit::from_above : Limit::from_below);
                        const std::size_t at =
                            static_cast<std::size_t>(i - o.first_step) * nodes + j;
                        CHECK(o.stiffness[at] == Approx(expected).epsilon(1e-10));
                        if (j == 0 && i > o.first_step &&
                            std::abs(o.stiffness[at] - o.stiffness[at - 1]) >
                                0.01 * o.stiffness[at]) {
                            ++jumps;
                        }
                    }
                }
            }
        }
        // The jumps are two edges of two teeth, and the starts or ends of engagements during the
        // passage.
        CHECK(jumps >= 4);
    }
}

}  // namespace gearpod::lockstep::test_stiffness_nodes
