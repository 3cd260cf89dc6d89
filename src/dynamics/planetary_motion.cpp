#include "dynamics/planetary_motion.hpp"

#include <algorithm>
#include <numbers>

#include "machine/contracts.hpp"

namespace gearpod::dynamics {
namespace {

template <int W, class Real>
void set_directions(PlanetaryLanes<W, Real>& lanes, const PlanetaryLayout& layout) {
    const double a_sun = layout.sun_mesh_angle(), a_ring = layout.ring_mesh_angle();
    lanes.planets = layout.planets;
    lanes.sources = layout.sources();
    lanes.cos_sun_mesh = Real(std::cos(a_sun));
    lanes.cos_ring_mesh = Real(std::cos(a_ring));
    lanes.ring_over_sun_cosine = Real(std::cos(a_ring) / std::cos(a_sun));
    for (int n = 0; n < layout.planets; ++n) {
        const double psi = layout.planet_angle(n);
        lanes.cos_psi[n] = Real(std::cos(psi));
        lanes.sin_psi[n] = Real(std::sin(psi));
        lanes.cos_sun[n] = Real(std::cos(std::numbers::pi / 2 - a_sun + psi));
        lanes.sin_sun[n] = Real(std::sin(std::numbers::pi / 2 - a_sun + psi));
        lanes.cos_ring[n] = Real(std::cos(std::numbers::pi / 2 + a_ring + psi));
        lanes.sin_ring[n] = Real(std::sin(std::numbers::pi / 2 + a_ring + psi));
    }
}

// Mass of the planets, which the carrier moves in torsional motion.
double planets_mass_kg(const PlanetaryLayout& layout, const PlanetaryInputs& in) {
    return layout.planets * in.mass_kg[planet];
}

template <int W, class Real>
void set_lane(PlanetaryLanes<W, Real>& lanes, int l, const PlanetaryLayout& layout,
              const PlanetaryInputs& in) {
    for (int i = 0; i < 3 + layout.planets; ++i) {
        const int body = std::min(i, static_cast<int>(planet));
        double inertia = in.inertia_over_r2_kg[body];
        if (layout.motion == Motion::torsional && body == carrier) {
            inertia += planets_mass_kg(layout, in);
        }
        lanes.inverse_mass[i][l] = Real(1.0 / in.mass_kg[body]);
        lanes.inverse_inertia[i][l] = Real(1.0 / inertia);
        lanes.bearing_stiffness[i][l] = Real(in.bearing_stiffness_N_m[body]);
        lanes.bearing_damping[i][l] = Real(in.bearing_damping_N_s_m[body]);
    }
    for (int n = 0; n < layout.planets; ++n) {
        lanes.pin_x[n][l] = Real(in.planet_deviations[n].pin_x_m);
        lanes.pin_y[n][l] = Real(in.planet_deviations[n].pin_y_m);
    }
    for (int body : {carrier, ring, sun}) {
        const bool is_fixed = body == body_index(layout.fixed);
        lanes.support_stiffness[body][l] = Real(is_fixed ? in.support_stiffness_N_m : 0.0);
        lanes.support_damping[body][l] = Real(is_fixed ? in.support_damping_N_s_m : 0.0);
        lanes.force[body][l] = Real(in.force_N[body]);
    }
    for (PairId pair{0}; pair < layout.pairs(); ++pair) {
        lanes.mesh_damping[pair].factor[l] = Real(mesh_damping_factor(layout, in, pair));
    }
    const double w = in.carrier_speed_rad_s;
    lanes.speed[l] = Real(w);
    lanes.centrifugal[l] = Real(layout.carrier_radius_m * w * w);
    lanes.mesh_period[l] = Real(in.mesh_period_s);
    lanes.backlash[l] = Real(in.backlash_m);
}

}  // namespace

template <int W, class Real>
PlanetaryLanes<W, Real> make_lanes(const PlanetaryLayout& layout,
                                   std::span<const PlanetaryInputs> inputs) {
    EXPECTS(inputs.size() == W);
    PlanetaryLanes<W, Real> lanes{};
    set_directions(lanes, layout);
    for (int l = 0; l < W; ++l) {
        set_lane(lanes, l, layout, inputs[static_cast<std::size_t>(l)]);
    }
    return lanes;
}

#define GEARPOD_LANES(W, REAL)                                                   \
    template PlanetaryLanes<W, REAL> make_lanes<W, REAL>(const PlanetaryLayout&, \
                                                         std::span<const PlanetaryInputs>);
GEARPOD_FOR_ALL_WIDTHS(GEARPOD_LANES)
#undef GEARPOD_LANES

}  // namespace gearpod::dynamics
