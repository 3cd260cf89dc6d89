// Tian's one-stage gearbox (2004, Table 4.1) as input of a tile.
#pragma once

#include "gears/mesh_geometry.hpp"
#include "lockstep/integrators/facts.hpp"
#include "lockstep/strategies/solution.hpp"
#include "stiffness/additive_mesh.hpp"
#include "tests/lockstep/liang_train.hpp"

namespace gearpod::test {

struct TianGearbox {
    static constexpr double kModule = 0.0254 / 8;  // diametral pitch 8 per inch
    static constexpr double kAngle = 20 * std::numbers::pi / 180;
    static constexpr double kMeshFrequency_Hz = 570.0;

    gears::Gear pinion{19, false, kModule, kAngle}, gear{48, false, kModule, kAngle};
    stiffness::Material steel{2.068e11, 0.3, 0.016, true};
    gears::MeshGeometry mesh{pinion, gear};
    stiffness::AdditiveMesh pair{mesh, steel, stiffness::Profile::base_circle};
    lockstep::PairSet pairs;

    TianGearbox() {
        pairs.mesh = {&pair};
        pairs.start = {0.0};
    }

    static const TianGearbox& instance() {
        static const TianGearbox gearbox;
        return gearbox;
    }

    dynamics::FixedShaftLayout layout() const {
        dynamics::FixedShaftLayout layout;
        layout.base_radius_m[dynamics::pinion] = pinion.base_radius();
        layout.base_radius_m[dynamics::gear] = gear.base_radius();
        return layout;
    }

    lockstep::IntegrationPlan plan(int samples, int steps, lockstep::Integrator integrator) const {
        lockstep::IntegrationPlan p;
        p.layout = layout();
        p.integrator = integrator;
        p.grid = lockstep::make_phase_grid(samples, steps, lockstep::contact_transitions(pairs));
        p.grid.stage_nodes = lockstep::stage_nodes(integrator);
        p.nodes = lockstep::tabulate(pairs, p.grid, dynamics::MeshDamping::proportional);
        p.low_pass_rad_s = 2 * std::numbers::pi * 10e3;
        p.te_weight.assign(dynamics::fixed_shaft_motions, 0.0);
        p.te_weight[dynamics::u_1] = 1.0 / pinion.base_radius();
        p.te_weight[dynamics::u_2] = -1.0 / pinion.base_radius();
        return p;
    }

    // Inputs as printed; 11.9 and 48.8 N m are not in balance.
    dynamics::FixedShaftInputs inputs() const {
        dynamics::FixedShaftInputs in;
        const double masses[] = {0.96, 2.88}, inertias[] = {4.3659e-4, 8.3602e-3};
        for (const auto g : {dynamics::pinion, dynamics::gear}) {
            in.mass_kg[g] = masses[g];
            in.inertia_kg_m2[g] = inertias[g];
            in.bearing_stiffness_N_m[g] = 6.56e7;
            in.bearing_damping_N_s_m[g] = 1.8e5;
            in.coupling_stiffness_N_m_rad[g] = 4.4e4;
            in.coupling_damping_N_m_s_rad[g] = 5e5;
        }
        in.motor_inertia_kg_m2 = 0.0021;
        in.load_inertia_kg_m2 = 0.0105;
        in.motor_torque_N_m = 11.9;
        in.load_torque_N_m = 48.8;
        in.mesh_damping = 3.99e-6;
        in.mesh_period_s = 1.0 / kMeshFrequency_Hz;
        return in;
    }

    lockstep::FaultCurves no_fault(int lanes) const { return test::no_fault(pairs, lanes); }
};

}  // namespace gearpod::test
