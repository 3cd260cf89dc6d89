#include "dynamics/planetary.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "dynamics/effects/mesh_damping.hpp"
#include "dynamics/helical_pair.hpp"

namespace gearpod::dynamics {
namespace {

using std::numbers::pi;

void add_spring(Eigen::MatrixXd& matrix, const Eigen::VectorXd& row, double coefficient) {
    matrix += coefficient * row * row.transpose();
}

// Planets that cannot move on their bearings: x_n = -u_c sin psi_n, y_n = u_c cos psi_n.
Eigen::MatrixXd torsional_constraint(const PlanetaryLayout& layout) {
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

void add_inertial_terms(PlanetaryMatrices& m, const PlanetaryLayout& layout,
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

PlanetaryMatrices reduce(const PlanetaryMatrices& full, const Eigen::MatrixXd& tie) {
    const auto project = [&](const Eigen::MatrixXd& m) {
        return Eigen::MatrixXd(tie.transpose() * m * tie);
    };
    PlanetaryMatrices r;
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

Body held_body(gears::FixedMember fixed) {
    switch (fixed) {
        case gears::FixedMember::sun:
            return sun;
        case gears::FixedMember::carrier:
            return carrier;
        case gears::FixedMember::ring:
            break;
    }
    return ring;
}

Eigen::VectorXd sun_planet_row(const PlanetaryLayout& layout, int n) {
    const double angle = pi / 2 - layout.transverse_pressure_angle() + layout.planet_angle(n);
    Eigen::VectorXd row = Eigen::VectorXd::Zero(layout.motions());
    const int s = motion_index(sun);
    const int p = motion_index(planet, n);
    row(s) = std::cos(angle);
    row(s + 1) = std::sin(angle);
    row(s + 2) = 1.0;
    row(p) = -row(s);
    row(p + 1) = -row(s + 1);
    row(p + 2) = 1.0;
    return row;
}

Eigen::VectorXd ring_planet_row(const PlanetaryLayout& layout, int n) {
    const double angle = pi / 2 + layout.transverse_pressure_angle() + layout.planet_angle(n);
    Eigen::VectorXd row = Eigen::VectorXd::Zero(layout.motions());
    const int r = motion_index(ring);
    const int p = motion_index(planet, n);
    row(r) = std::cos(angle);
    row(r + 1) = std::sin(angle);
    row(r + 2) = 1.0;
    row(p) = -row(r);
    row(p + 1) = -row(r + 1);
    row(p + 2) = -1.0;
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

double pair_damping(const PlanetaryLayout& layout, const PlanetaryInputs& inputs, int pair,
                    double stiffness_N_m) {
    const Body gear = pair < layout.planets ? sun : ring;
    return with_mesh_damping(layout.mesh_damping, [&](auto law) {
        return law.factor(inputs.mesh_damping, inputs.mass_kg[gear], inputs.mass_kg[planet]) *
               law.shape(stiffness_N_m);
    });
}

PlanetaryMatrices assemble(const PlanetaryLayout& layout, const PlanetaryInputs& inputs,
                           const std::vector<double>& pair_stiffness_N_m) {
    const int size = layout.motions();
    PlanetaryMatrices m;
    m.mass = Eigen::MatrixXd::Zero(size, size);
    m.damping = m.stiffness = m.gyroscopic = m.centrifugal = m.mass;
    m.force = Eigen::VectorXd::Zero(size);

    for (int i = 0; i < 3 + layout.planets; ++i) {
        const int body = std::min(i, static_cast<int>(planet));
        m.mass(3 * i, 3 * i) = m.mass(3 * i + 1, 3 * i + 1) = inputs.mass_kg[body];
        m.mass(3 * i + 2, 3 * i + 2) = inputs.inertia_over_r2_kg[body];
    }
    for (int body : {carrier, ring, sun}) {
        for (int axis : {0, 1}) {
            m.stiffness(3 * body + axis, 3 * body + axis) += inputs.bearing_stiffness_N_m[body];
            m.damping(3 * body + axis, 3 * body + axis) += inputs.bearing_damping_N_s_m[body];
        }
        m.force(3 * body + 2) = inputs.force_N[body];
    }
    const int held = 3 * held_body(layout.fixed) + 2;
    m.stiffness(held, held) += inputs.support_stiffness_N_m;
    m.damping(held, held) += inputs.support_damping_N_s_m;

    for (int n = 0; n < layout.planets; ++n) {
        for (int axis : {0, 1}) {
            const Eigen::VectorXd row = planet_bearing_row(layout, n, axis);
            add_spring(m.stiffness, row, inputs.bearing_stiffness_N_m[planet]);
            add_spring(m.damping, row, inputs.bearing_damping_N_s_m[planet]);
        }
        const int pairs[] = {n, layout.planets + n};
        for (int pair : pairs) {
            const Eigen::VectorXd row =
                pair == n ? sun_planet_row(layout, n) : ring_planet_row(layout, n);
            const double k = pair_stiffness_N_m[static_cast<std::size_t>(pair)];
            add_spring(m.stiffness, row, k);
            add_spring(m.damping, row, pair_damping(layout, inputs, pair, k));
        }
    }
    if (layout.motion == Motion::torsional) {
        return reduce(m, torsional_constraint(layout));
    }
    if (layout.inertial_terms) {
        add_inertial_terms(m, layout, inputs);
    }
    return m;
}

Eigen::VectorXd rigid_rotation(const PlanetaryLayout& layout) {
    // From zero deflection of both meshes: u_s + u_n = u_c cos a and u_r - u_n = u_c cos a.
    const double cos_a = std::cos(layout.transverse_pressure_angle());
    const Body held = held_body(layout.fixed);
    const double u_c = held == carrier ? 0.0 : 1.0;
    const double u_s = held == sun ? 0.0 : held == ring ? 2.0 * cos_a : 1.0;
    const double u_n = u_c * cos_a - u_s;
    Eigen::VectorXd turn = Eigen::VectorXd::Zero(layout.degrees_of_freedom());
    const bool torsional = layout.motion == Motion::torsional;
    const auto u = [&](int body) { return torsional ? body : 3 * body + 2; };
    turn(u(carrier)) = u_c;
    turn(u(ring)) = u_c * cos_a + u_n;
    turn(u(sun)) = u_s;
    for (int n = 0; n < layout.planets; ++n) {
        turn(u(planet + n)) = u_n;
        if (!torsional) {
            turn(motion_index(planet, n)) = -u_c * std::sin(layout.planet_angle(n));
            turn(motion_index(planet, n) + 1) = u_c * std::cos(layout.planet_angle(n));
        }
    }
    return turn;
}

Eigen::VectorXd static_equilibrium(const PlanetaryMatrices& matrices) {
    // The complete orthogonal decomposition gives the least-norm solution, which leaves the rigid
    // rotation, the null vector of a free gearbox, at zero.
    const Eigen::MatrixXd k = matrices.stiffness + matrices.centrifugal;
    return k.completeOrthogonalDecomposition().solve(matrices.force);
}

std::vector<double> natural_frequencies_Hz(const PlanetaryMatrices& matrices) {
    const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> solver(
        matrices.stiffness, matrices.mass, Eigen::EigenvaluesOnly);
    std::vector<double> frequencies;
    const double largest = solver.eigenvalues().cwiseAbs().maxCoeff();
    for (const double value : solver.eigenvalues()) {
        // A rigid rotation comes out as rounding noise of either sign.
        frequencies.push_back(std::abs(value) < 1e-10 * largest ? 0.0
                                                                : std::sqrt(value) / (2.0 * pi));
    }
    return frequencies;
}

}  // namespace gearpod::dynamics
