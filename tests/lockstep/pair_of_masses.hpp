// Two masses coupled by one tooth contact only. They are the sun and the only planet of a torsional
// train whose carrier and ring are too heavy to move and whose ring mesh is missing.
// Equations: d = u_s + u_p, d'' = g - mesh force / m, 1/m = 1/m_s + 1/m_p, g = F / m_s.
#pragma once

#include "lockstep/integrators/facts.hpp"
#include "lockstep/integrators/sensor_filter.hpp"
#include "lockstep/tile/tile_integrators.hpp"
#include "tests/test.hpp"

namespace gearpod::test {

struct PairOfMasses {
    static constexpr double kSun = 0.5, kPlanet = 0.3, kHeavy = 1e18;
    static constexpr double kMass = kSun * kPlanet / (kSun + kPlanet);
    static constexpr double kStiffness = 4e8;

    lockstep::IntegrationPlan plan;
    dynamics::PlanetaryInputs in;
    lockstep::TileState state;

    PairOfMasses(dynamics::MeshLaw law, int steps, double period_s, double damping_N_s_m = 0.0,
                 lockstep::Integrator integrator = lockstep::Integrator::rk4) {
        dynamics::PlanetaryLayout layout;
        layout.planets = 1;
        layout.pressure_angle_rad = 0.35;
        layout.motion = dynamics::Motion::torsional;
        layout.mesh_damping = dynamics::MeshDamping::proportional;
        plan.layout = layout;
        plan.mesh_law = law;
        plan.integrator = integrator;
        plan.grid = lockstep::make_phase_grid(steps, steps, {});
        plan.grid.stage_nodes = lockstep::stage_nodes(integrator);
        const std::size_t nodes = plan.grid.steps.size() * plan.grid.stage_nodes.size();
        plan.nodes.pairs = 2;
        for (std::size_t i = 0; i < nodes; ++i) {
            plan.nodes.stiffness.insert(plan.nodes.stiffness.end(), {kStiffness, 0.0});
            // The shape of the mean stiffness makes the damping constant.
            plan.nodes.damping_shape.insert(plan.nodes.damping_shape.end(), {kStiffness, 0.0});
        }
        plan.low_pass_rad_s = 1000.0;
        plan.te_weight = {0.0, 0.0, 1.0, 1.0};  // d itself
        for (int body = 0; body < dynamics::body_count; ++body) {
            in.mass_kg[body] = 1e-6;  // mass of a planet on the carrier: negligible
            in.inertia_over_r2_kg[body] = kHeavy;
        }
        in.inertia_over_r2_kg[dynamics::sun] = kSun;
        in.inertia_over_r2_kg[dynamics::planet] = kPlanet;
        in.mesh_damping = damping_N_s_m / kStiffness;
        in.mesh_period_s = period_s;
        state.q.assign(4, 0.0);
        state.v.assign(4, 0.0);
        state.filter.assign(static_cast<std::size_t>(2 * lockstep::kFilterStates), 0.0);
    }

    double natural_rad_s() const { return std::sqrt(kStiffness / kMass); }
    double deflection() const { return state.q[2] + state.q[3]; }
    double rate() const { return state.v[2] + state.v[3]; }
    // Total momentum, which the mesh force does not change: it acts on both equally.
    double momentum() const { return kSun * state.v[2] - kPlanet * state.v[3]; }

    // Integrates one mesh period and returns d at every step.
    machine::AlignedVector integrate_mesh() {
        const dynamics::GearboxInputs inputs = in;
        auto record = lockstep::make_record(plan, 1, false);
        (*lockstep::make_mesh_integrator<1>(plan, std::span(&inputs, 1)))({}, state, record);
        return record.te;
    }
};

}  // namespace gearpod::test
