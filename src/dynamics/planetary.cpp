#include "dynamics/planetary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "dynamics/gearbox_matrices.hpp"
#include "dynamics/helical_pair.hpp"
#include "machine/contracts.hpp"

namespace gearpod::dynamics {
namespace {

using std::numbers::pi;

constexpr const char* kBodyNames[] = {"carrier", "ring", "sun", "planet"};

void add_inertial_terms(GearboxMatrices& m, const PlanetaryLayout& layout,
                        const PlanetaryInputs& inputs) {
    const double w = inputs.carrier_speed_rad_s;
    for (int i = 0; i < 3 + layout.planets; ++i) {
        const double mass = m.mass(3 * i, 3 * i);
        m.gyroscopic(3 * i, 3 * i + 1) = -2.0 * mass * w;
        m.gyroscopic(3 * i + 1, 3 * i) = 2.0 * mass * w;
        m.centrifugal(3 * i, 3 * i) = -mass * w * w;
        m.centrifugal(3 * i + 1, 3 * i + 1) = -mass * w * w;
    }
    for (int n = 0; n < layout.planets; ++n) {
        const double pull = inputs.mass_kg[planet] * layout.carrier_radius_m * w * w;
        m.force(motion_index(planet, n)) += pull * std::cos(layout.planet_angle(n));
        m.force(motion_index(planet, n) + 1) += pull * std::sin(layout.planet_angle(n));
    }
}

// Adds f = k_p (pin) along x and y: a bearing is unloaded where its pin is.
void add_pin_forces(GearboxMatrices& m, const PlanetaryLayout& layout,
                    const PlanetaryInputs& inputs) {
    for (int n = 0; n < layout.planets; ++n) {
        const PlanetDeviations& deviations = inputs.planet_deviations[n];
        const double k = inputs.bearing_stiffness_N_m[planet];
        m.force += k * deviations.pin_x_m * planet_bearing_row(layout, n, 0) +
                   k * deviations.pin_y_m * planet_bearing_row(layout, n, 1);
    }
}

GearboxMatrices reduce(const GearboxMatrices& full, const Eigen::MatrixXd& tie) {
    const auto project = [&](const Eigen::MatrixXd& m) {
        return Eigen::MatrixXd(tie.transpose() * m * tie);
    };
    GearboxMatrices r;
    r.mass = project(full.mass);
    r.damping = project(full.damping);
    r.stiffness = project(full.stiffness);
    r.gyroscopic = Eigen::MatrixXd::Zero(tie.cols(), tie.cols());
    r.centrifugal = r.gyroscopic;
    r.force = tie.transpose() * full.force;
    return r;
}

}  // namespace

double PlanetaryLayout::planet_angle(int n) const {
    return positions_rad.empty() ? 2.0 * pi * n / planets
                                 : positions_rad[static_cast<std::size_t>(n)];
}

double PlanetaryLayout::transverse_pressure_angle() const {
    return dynamics::transverse_pressure_angle(pressure_angle_rad, helix_angle_rad);
}

int body_index(gears::Member member) {
    EXPECTS(member == gears::Member::sun || member == gears::Member::carrier ||
            member == gears::Member::ring);
    return member == gears::Member::sun ? sun : member == gears::Member::carrier ? carrier : ring;
}

Eigen::VectorXd pair_row(const PlanetaryLayout& layout, PairId pair) {
    const bool with_sun = pair < layout.planets;
    const int n = pair % layout.planets;
    const double angle = pi / 2 + (with_sun ? -layout.sun_mesh_angle() : layout.ring_mesh_angle()) +
                         layout.planet_angle(n);
    Eigen::VectorXd row = Eigen::VectorXd::Zero(layout.motions());
    const int g = motion_index(with_sun ? sun : ring);
    const int p = motion_index(planet, n);
    row(g) = std::cos(angle);
    row(g + 1) = std::sin(angle);
    row(g + 2) = 1.0;
    row(p) = -row(g);
    row(p + 1) = -row(g + 1);
    row(p + 2) = with_sun ? 1.0 : -1.0;
    return row;
}

Eigen::VectorXd planet_bearing_row(const PlanetaryLayout& layout, int n, int axis) {
    const double psi = layout.planet_angle(n);
    Eigen::VectorXd row = Eigen::VectorXd::Zero(layout.motions());
    row(motion_index(planet, n) + axis) = 1.0;
    row(motion_index(carrier) + axis) = -1.0;
    row(motion_index(carrier) + 2) = axis == 0 ? std::sin(psi) : -std::cos(psi);
    return row;
}

Eigen::MatrixXd motions_from_degrees(const PlanetaryLayout& layout) {
    if (layout.motion != Motion::torsional) {
        return Eigen::MatrixXd::Identity(layout.motions(), layout.motions());
    }
    Eigen::MatrixXd tie = Eigen::MatrixXd::Zero(layout.motions(), layout.degrees_of_freedom());
    for (int body = 0; body < 3 + layout.planets; ++body) {
        tie(3 * body + 2, body) = 1.0;
    }
    for (int n = 0; n < layout.planets; ++n) {
        const double psi = layout.planet_angle(n);
        tie(motion_index(planet, n), 0) = -std::sin(psi);
        tie(motion_index(planet, n) + 1, 0) = std::cos(psi);
    }
    return tie;
}

double mesh_damping_factor(const PlanetaryLayout& layout, const PlanetaryInputs& inputs,
                           PairId pair) {
    const int central = pair < layout.planets ? sun : ring;
    return mesh_damping_factor(layout.mesh_damping, inputs.mesh_damping, inputs.mass_kg[central],
                               inputs.mass_kg[planet]);
}

std::vector<SpringDamper> spring_dampers(const PlanetaryLayout& layout,
                                         const PlanetaryInputs& inputs,
                                         const std::vector<double>& pair_stiffness_N_m) {
    std::vector<SpringDamper> springs;
    const auto motion = [&](int i) { return Eigen::VectorXd::Unit(layout.motions(), i); };
    for (int body : {carrier, ring, sun}) {
        for (int axis : {0, 1}) {
            springs.push_back({fmt::format("the {}'s bearing", kBodyNames[body]),
                               motion(3 * body + axis), inputs.bearing_stiffness_N_m[body],
                               inputs.bearing_damping_N_s_m[body]});
        }
    }
    const int fixed_member = body_index(layout.fixed);
    springs.push_back({fmt::format("the {}'s support", kBodyNames[fixed_member]),
                       motion(3 * fixed_member + 2), inputs.support_stiffness_N_m,
                       inputs.support_damping_N_s_m});
    for (int n = 0; n < layout.planets; ++n) {
        for (int axis : {0, 1}) {
            springs.push_back(
                {fmt::format("planet {}'s bearing", n + 1), planet_bearing_row(layout, n, axis),
                 inputs.bearing_stiffness_N_m[planet], inputs.bearing_damping_N_s_m[planet]});
        }
        for (const PairId pair : {sun_pair(PlanetId{n}), ring_pair(PlanetId{n}, layout.planets)}) {
            const double k = pair_stiffness_N_m[pair];
            springs.push_back(
                {fmt::format("planet {}'s mesh with the {}", n + 1, pair == n ? "sun" : "ring"),
                 pair_row(layout, pair), k,
                 mesh_damping_N_s_m(layout.mesh_damping, mesh_damping_factor(layout, inputs, pair),
                                    k)});
        }
    }
    return springs;
}

GearboxMatrices assemble(const PlanetaryLayout& layout, const PlanetaryInputs& inputs,
                         const std::vector<double>& pair_stiffness_N_m) {
    GearboxMatrices m = zero_matrices(layout.motions());
    for (int i = 0; i < 3 + layout.planets; ++i) {
        const int body = std::min(i, static_cast<int>(planet));
        m.mass(3 * i, 3 * i) = m.mass(3 * i + 1, 3 * i + 1) = inputs.mass_kg[body];
        m.mass(3 * i + 2, 3 * i + 2) = inputs.inertia_over_r2_kg[body];
    }
    for (int body : {carrier, ring, sun}) {
        m.force(3 * body + 2) = inputs.force_N[body];
    }
    add_pin_forces(m, layout, inputs);
    for (const SpringDamper& spring : spring_dampers(layout, inputs, pair_stiffness_N_m)) {
        add(m, spring);
    }
    if (layout.motion == Motion::torsional) {
        return reduce(m, motions_from_degrees(layout));
    }
    if (layout.inertial_terms) {
        add_inertial_terms(m, layout, inputs);
    }
    return m;
}

std::vector<std::string> motion_names(const PlanetaryLayout& layout) {
    std::vector<std::string> bodies{"carrier", "ring", "sun"};
    for (int n = 1; n <= layout.planets; ++n) {
        bodies.push_back(fmt::format("planet{}", n));
    }
    std::vector<std::string> names;
    for (const std::string& body : bodies) {
        if (layout.motion != Motion::torsional) {
            names.push_back(body + "_x");
            names.push_back(body + "_y");
        }
        names.push_back(body + "_u");
    }
    return names;
}

Eigen::VectorXd rigid_rotation(const PlanetaryLayout& layout) {
    // Condition of zero deflection of both meshes: u_s + u_n = u_c cos a_s and u_r - u_n = u_c cos
    // a_r.
    const double cos_s = std::cos(layout.sun_mesh_angle());
    const double cos_r = std::cos(layout.ring_mesh_angle());
    const int fixed_member = body_index(layout.fixed);
    const double u_c = fixed_member == carrier ? 0.0 : 1.0;
    const double u_s = fixed_member == sun ? 0.0 : fixed_member == ring ? cos_s + cos_r : 1.0;
    const double u_n = u_c * cos_s - u_s;
    Eigen::VectorXd turn = Eigen::VectorXd::Zero(layout.degrees_of_freedom());
    turn(layout.rotation_index(carrier)) = u_c;
    turn(layout.rotation_index(ring)) = fixed_member == ring ? 0.0 : u_c * cos_r + u_n;
    turn(layout.rotation_index(sun)) = u_s;
    for (int n = 0; n < layout.planets; ++n) {
        turn(layout.rotation_index(planet + n)) = u_n;
        if (layout.motion != Motion::torsional) {
            turn(motion_index(planet, n)) = -u_c * std::sin(layout.planet_angle(n));
            turn(motion_index(planet, n) + 1) = u_c * std::cos(layout.planet_angle(n));
        }
    }
    return turn;
}

}  // namespace gearpod::dynamics
