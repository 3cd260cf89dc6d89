#include "dynamics/planetary_lanes.hpp"

#include <cassert>
#include <cmath>
#include <numbers>

#include "dynamics/effects/mesh_damping.hpp"

namespace gearpod::dynamics {
namespace {

template <int W>
void set_directions(PlanetaryLanes<W>& lanes, const PlanetaryLayout& layout) {
    const double a = layout.transverse_pressure_angle();
    lanes.planets = layout.planets;
    lanes.cos_pressure_angle = std::cos(a);
    for (int n = 0; n < layout.planets; ++n) {
        const double psi = layout.planet_angle(n);
        lanes.cos_psi[n] = std::cos(psi);
        lanes.sin_psi[n] = std::sin(psi);
        lanes.cos_sun[n] = std::cos(std::numbers::pi / 2 - a + psi);
        lanes.sin_sun[n] = std::sin(std::numbers::pi / 2 - a + psi);
        lanes.cos_ring[n] = std::cos(std::numbers::pi / 2 + a + psi);
        lanes.sin_ring[n] = std::sin(std::numbers::pi / 2 + a + psi);
    }
}

template <int W>
void set_lane(PlanetaryLanes<W>& lanes, int l, const PlanetaryLayout& layout,
              const PlanetaryInputs& in) {
    for (int body = 0; body < body_count; ++body) {
        double inertia = in.inertia_over_r2_kg[body];
        if (layout.motion == Motion::torsional && body == carrier) {
            inertia += layout.planets * in.mass_kg[planet];  // planets ride on the carrier
        }
        lanes.inverse_mass[body][l] = 1.0 / in.mass_kg[body];
        lanes.inverse_inertia[body][l] = 1.0 / inertia;
        lanes.bearing_stiffness[body][l] = in.bearing_stiffness_N_m[body];
        lanes.bearing_damping[body][l] = in.bearing_damping_N_s_m[body];
    }
    for (int body : {carrier, ring, sun}) {
        const bool held = body == held_body(layout.fixed);
        lanes.support_stiffness[body][l] = held ? in.support_stiffness_N_m : 0.0;
        lanes.support_damping[body][l] = held ? in.support_damping_N_s_m : 0.0;
        lanes.force[body][l] = in.force_N[body];
    }
    with_mesh_damping(layout.mesh_damping, [&](auto law) {
        lanes.mesh_damping_factor[0][l] =
            law.factor(in.mesh_damping, in.mass_kg[sun], in.mass_kg[planet]);
        lanes.mesh_damping_factor[1][l] =
            law.factor(in.mesh_damping, in.mass_kg[ring], in.mass_kg[planet]);
    });
    const double w = in.carrier_speed_rad_s;
    lanes.speed[l] = w;
    lanes.centrifugal[l] = layout.carrier_radius_m * w * w;
    lanes.mesh_period[l] = in.mesh_period_s;
    lanes.backlash[l] = in.backlash_m;
}

}  // namespace

template <int W>
PlanetaryLanes<W> make_lanes(const PlanetaryLayout& layout,
                             std::span<const PlanetaryInputs> inputs) {
    assert(inputs.size() == W);
    PlanetaryLanes<W> lanes{};
    set_directions(lanes, layout);
    for (int l = 0; l < W; ++l) {
        set_lane(lanes, l, layout, inputs[static_cast<std::size_t>(l)]);
    }
    return lanes;
}

template PlanetaryLanes<1> make_lanes<1>(const PlanetaryLayout&, std::span<const PlanetaryInputs>);
template PlanetaryLanes<4> make_lanes<4>(const PlanetaryLayout&, std::span<const PlanetaryInputs>);
template PlanetaryLanes<8> make_lanes<8>(const PlanetaryLayout&, std::span<const PlanetaryInputs>);

}  // namespace gearpod::dynamics
