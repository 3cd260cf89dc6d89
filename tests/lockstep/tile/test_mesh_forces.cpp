// Checks the mesh damping of the integrated gearbox: that of its law at the stiffness of the phase.
#include "dynamics/gearbox.hpp"
#include "lockstep/tile/mesh_forces.hpp"
#include "tests/lockstep/tian_gearbox.hpp"
#include "tests/test.hpp"

namespace gearpod::lockstep::test_mesh_forces {

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

}  // namespace gearpod::lockstep::test_mesh_forces
