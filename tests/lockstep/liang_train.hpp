// Liang's planetary gearbox (2016, Table 4.1) as input of a tile; module 3.175 mm.
#pragma once

#include "gears/mesh_geometry.hpp"
#include "gears/planetary.hpp"
#include "lockstep/integrators/facts.hpp"
#include "lockstep/integrators/sensor_filter.hpp"
#include "lockstep/plan/tooth_pairs.hpp"
#include "lockstep/strategies/solution.hpp"
#include "stiffness/additive_mesh.hpp"
#include "stiffness/faults/tooth_crack.hpp"
#include "tests/numbers.hpp"

namespace gearpod::test {

inline lockstep::FaultCurves no_fault(const lockstep::PairSet& pairs, int lanes) {
    lockstep::FaultCurves f;
    f.pairs = &pairs;
    f.curve.resize(1);
    f.curve[0].resize(static_cast<std::size_t>(lanes));
    return f;
}

// A state at rest at these displacements, for one lane.
inline lockstep::TileState state_at(const lockstep::IntegrationPlan& plan,
                                    const Eigen::VectorXd& q) {
    lockstep::TileState state;
    state.q.assign(q.begin(), q.end());
    state.v.assign(state.q.size(), 0.0);
    state.filter.assign(static_cast<std::size_t>(plan.channels() * lockstep::kFilterStates), 0.0);
    return state;
}

struct LiangTrain {
    static constexpr double kModule = 3.175e-3;
    static constexpr double kAngle = 20 * std::numbers::pi / 180;

    gears::Gear sun{19, false, kModule, kAngle}, planet{31, false, kModule, kAngle},
        ring{81, true, kModule, kAngle};
    stiffness::Material steel{2.068e11, 0.3, 0.0381};
    gears::MeshGeometry sun_mesh{sun, planet}, ring_mesh{planet, ring};
    stiffness::AdditiveMesh sun_planet{sun_mesh, steel, stiffness::Profile::root_circle};
    stiffness::AdditiveMesh ring_planet{ring_mesh, steel, stiffness::Profile::root_circle};
    stiffness::ToothCrack cracked{ring_mesh, steel, stiffness::Profile::root_circle, 1,
                                  std::numbers::pi / 4};
    lockstep::PairSet pairs;

    LiangTrain() {
        const gears::PlanetaryTrain train{19, 31, 81, 4};
        const auto add = [&](double pitch_phase, const stiffness::AdditiveMesh& mesh) {
            const double start = pitch_phase - mesh.pitch_position();
            pairs.mesh.push_back(&mesh);
            pairs.start.push_back(start - std::floor(start));
        };
        for (int n = 0; n < 4; ++n) {
            add(gears::sun_mesh_phase(train, PlanetId{n}), sun_planet);
        }
        for (int n = 0; n < 4; ++n) {
            add(gears::ring_mesh_phase(train, PlanetId{n}), ring_planet);
        }
    }

    static const LiangTrain& instance() {
        static const LiangTrain train;
        return train;
    }

    lockstep::IntegrationPlan plan(int samples, int steps, dynamics::Motion motion,
                                   bool inertial = true) const {
        lockstep::IntegrationPlan p;
        dynamics::PlanetaryLayout layout;
        layout.planets = 4;
        layout.pressure_angle_rad = kAngle;
        layout.carrier_radius_m = 25 * kModule;
        layout.motion = motion;
        layout.inertial_terms = inertial;
        p.layout = layout;
        p.grid = lockstep::make_phase_grid(samples, steps, lockstep::contact_transitions(pairs));
        p.nodes = lockstep::tabulate(pairs, p.grid, layout.mesh_damping);
        p.low_pass_rad_s = 2 * std::numbers::pi * 800;
        p.te_weight.assign(static_cast<std::size_t>(layout.degrees_of_freedom()), 0.0);
        const auto u = [&](int body) {
            return static_cast<std::size_t>(layout.rotation_index(body));
        };
        p.te_weight[u(dynamics::carrier)] = -100.0 / 19 / layout.carrier_radius_m;
        p.te_weight[u(dynamics::sun)] = 1.0 / sun.base_radius();
        return p;
    }

    // The same for another integrator.
    lockstep::IntegrationPlan plan(int samples, int steps, dynamics::Motion motion,
                                   lockstep::Integrator integrator, bool inertial = true) const {
        lockstep::IntegrationPlan p = plan(samples, steps, motion, inertial);
        p.integrator = integrator;
        p.grid.stage_nodes = lockstep::stage_nodes(integrator);
        p.nodes = lockstep::tabulate(pairs, p.grid, dynamics::mesh_damping(p.layout));
        return p;
    }

    // Errors of all flanks: sun, ring and both sides of each planet. error(gear, i) gives value i
    // of a gear, [tooth][lane]; slope(gear, i), if there are slopes, is called after its errors.
    template <class Error, class Slope = std::nullptr_t>
    static lockstep::ToothErrors tooth_errors(const lockstep::PairSet& pairs, std::size_t lanes,
                                              Error error, Slope slope = nullptr) {
        lockstep::ToothErrors errors{
            {}, lockstep::planetary_teeth(pairs, {19, 31, 81, 4}, gears::PlanetSense::clockwise)};
        for (const int teeth : {19, 81, 31, 31, 31, 31, 31, 31, 31, 31}) {
            const std::size_t g = errors.gears.size(),
                              count = static_cast<std::size_t>(teeth) * lanes;
            lockstep::GearErrors& gear = errors.gears.emplace_back(teeth);
            for (std::size_t i = 0; i < count; ++i) {
                gear.error_m.push_back(error(g, i));
            }
            if constexpr (!std::is_null_pointer_v<Slope>) {
                for (std::size_t i = 0; i < count; ++i) {
                    gear.slope_m.push_back(slope(g, i));
                }
            }
        }
        return errors;
    }

    // Inputs for a carrier at 8.87 rpm times `speedup` and 429 N m on the sun.
    dynamics::PlanetaryInputs inputs(double speedup = 1.0, double bearing_N_m = 1e8) const {
        dynamics::PlanetaryInputs in;
        const double cos_a = std::cos(kAngle);
        const double masses[] = {10.0, 5.982, 0.700, 1.822};
        for (int body = 0; body < dynamics::body_count; ++body) {
            in.mass_kg[body] = masses[body];
            const double share = body == dynamics::carrier ? 0.5 : 0.5 / (cos_a * cos_a);
            in.inertia_over_r2_kg[body] = share * masses[body];
            in.bearing_stiffness_N_m[body] = bearing_N_m;
            in.bearing_damping_N_s_m[body] = 1.5e3;
        }
        in.support_stiffness_N_m = 1e8;
        in.support_damping_N_s_m = 1.5e3;
        in.mesh_damping = 0.07;
        in.carrier_speed_rad_s = speedup * 8.87 * 2 * std::numbers::pi / 60;
        in.mesh_period_s = 60.0 / (81 * 8.87 * speedup);
        in.force_N[dynamics::sun] = 429.0 / sun.base_radius();
        in.force_N[dynamics::carrier] = -429.0 * (1 + 81.0 / 19) / (25 * kModule);
        return in;
    }

    // Inputs of gearboxes whose bearings differ: 0.8e8 N/m in the first, `step` of 1e8 N/m more in
    // each next one.
    std::vector<dynamics::GearboxInputs> spread(double speedup, int count = 8,
                                                double step = 0.05) const {
        return tabulated(count, [&](int l) {
            return dynamics::GearboxInputs(inputs(speedup, 1e8 * (0.8 + step * l)));
        });
    }

    lockstep::FaultCurves no_fault(int lanes) const { return test::no_fault(pairs, lanes); }

    // Curves for a crack of the given depths on the ring side of planet 1, one per lane; 0:
    // healthy.
    lockstep::FaultCurves ring_side_cracks(const std::vector<double>& depths_m) const {
        lockstep::FaultCurves f = no_fault(static_cast<int>(depths_m.size()));
        f.pattern =
            lockstep::planet_fault_pattern(pairs, PlanetId{0}, lockstep::PlanetSide::ring, 31);
        for (std::size_t l = 0; l < depths_m.size(); ++l) {
            if (depths_m[l] > 0.0) {
                f.curve[0][l] = stiffness::faulty_mesh(ring_planet, cracked.at(depths_m[l]));
            }
        }
        return f;
    }
};

}  // namespace gearpod::test
