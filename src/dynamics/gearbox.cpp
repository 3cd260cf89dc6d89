#include "dynamics/gearbox.hpp"

#include <algorithm>
#include <cmath>

#include "dynamics/gearbox_matrices.hpp"
#include "machine/contracts.hpp"

namespace gearpod::dynamics {
namespace {

template <class... Cases>
struct Overloaded : Cases... {
    using Cases::operator()...;
};
template <class... Cases>
Overloaded(Cases...) -> Overloaded<Cases...>;

// Calls f() with the values that the two variants hold.
template <class F>
auto with_inputs(const GearboxLayout& layout, const GearboxInputs& inputs, F f) {
    EXPECTS(layout.index() == inputs.index());
    return std::visit(Overloaded{[&](const PlanetaryLayout& kind) {
                                     return f(kind, std::get<PlanetaryInputs>(inputs));
                                 },
                                 [&](const FixedShaftLayout& kind) {
                                     return f(kind, std::get<FixedShaftInputs>(inputs));
                                 }},
                      layout);
}

GearboxMatrices without_meshes(const GearboxLayout& layout, const GearboxInputs& inputs) {
    return assemble(layout, inputs,
                    std::vector<double>(static_cast<std::size_t>(pairs(layout)), 0.0));
}

Eigen::MatrixX2d planetary_weight(const PlanetaryLayout& layout, const PlanetaryInputs& in) {
    Eigen::MatrixX2d weight = Eigen::MatrixX2d::Zero(layout.motions(), 2);
    for (int i = 0; i < 3 + layout.planets; ++i) {
        const double mass = in.mass_kg[std::min(i, static_cast<int>(planet))];
        weight(3 * i, 0) = weight(3 * i + 1, 1) = mass;
    }
    return motions_from_degrees(layout).transpose() * weight;
}

// Removes the part of the force that rotates the train as a rigid body, as for unbalanced torques
// (fixed_shaft.cpp). Unbalanced planets cause such a part, but the rotation is prescribed.
Eigen::VectorXd without_rigid_rotation(const Eigen::VectorXd& force, const Eigen::MatrixXd& mass,
                                       const Eigen::VectorXd& turn) {
    const double generalized_force = turn.dot(force);
    if (std::abs(generalized_force) <= 1e-12 * force.cwiseAbs().sum()) {
        return force;
    }
    const Eigen::VectorXd inertia = mass * turn;
    return force - inertia * (generalized_force / turn.dot(inertia));
}

}  // namespace

int degrees_of_freedom(const GearboxLayout& layout) {
    return std::visit([](const auto& kind) { return kind.degrees_of_freedom(); }, layout);
}

int pairs(const GearboxLayout& layout) {
    return std::visit([](const auto& kind) { return kind.pairs(); }, layout);
}

int sources(const GearboxLayout& layout) {
    return std::visit([](const auto& kind) { return kind.sources(); }, layout);
}

MeshDamping mesh_damping(const GearboxLayout& layout) {
    return std::visit([](const auto& kind) { return kind.mesh_damping; }, layout);
}

double mesh_period_s(const GearboxInputs& inputs) {
    return std::visit([](const auto& kind) { return kind.mesh_period_s; }, inputs);
}

std::vector<double> mesh_periods_s(std::span<const GearboxInputs> inputs) {
    std::vector<double> periods;
    for (const GearboxInputs& in : inputs) {
        periods.push_back(mesh_period_s(in));
    }
    return periods;
}

double backlash_m(const GearboxInputs& inputs) {
    return std::visit([](const auto& kind) { return kind.backlash_m; }, inputs);
}

double frame_speed_rad_s(const GearboxInputs& inputs) {
    return std::visit(Overloaded{[](const PlanetaryInputs& in) { return in.carrier_speed_rad_s; },
                                 [](const FixedShaftInputs&) { return 0.0; }},
                      inputs);
}

GearboxMatrices assemble(const GearboxLayout& layout, const GearboxInputs& inputs,
                         const std::vector<double>& pair_stiffness_N_m) {
    return with_inputs(layout, inputs, [&](const auto& kind, const auto& in) {
        return assemble(kind, in, pair_stiffness_N_m);
    });
}

std::vector<SpringDamper> spring_dampers(const GearboxLayout& layout, const GearboxInputs& inputs,
                                         const std::vector<double>& pair_stiffness_N_m) {
    auto springs = with_inputs(layout, inputs, [&](const auto& kind, const auto& in) {
        return spring_dampers(kind, in, pair_stiffness_N_m);
    });
    if (const auto* planetary = std::get_if<PlanetaryLayout>(&layout)) {
        const Eigen::MatrixXd tie = motions_from_degrees(*planetary);
        for (SpringDamper& spring : springs) {
            spring.row = (tie.transpose() * spring.row).eval();
        }
    }
    return springs;
}

Eigen::VectorXd rigid_rotation(const GearboxLayout& layout) {
    return std::visit([](const auto& kind) { return rigid_rotation(kind); }, layout);
}

double mesh_damping_factor(const GearboxLayout& layout, const GearboxInputs& inputs, PairId pair) {
    return with_inputs(layout, inputs, [&](const auto& kind, const auto& in) {
        return mesh_damping_factor(kind, in, pair);
    });
}

std::vector<std::string> motion_names(const GearboxLayout& layout) {
    return std::visit([](const auto& kind) { return motion_names(kind); }, layout);
}

Eigen::VectorXd mesh_row(const GearboxLayout& layout, PairId pair) {
    return std::visit(Overloaded{[&](const PlanetaryLayout& kind) -> Eigen::VectorXd {
                                     return motions_from_degrees(kind).transpose() *
                                            pair_row(kind, pair);
                                 },
                                 [](const FixedShaftLayout& kind) { return mesh_row(kind); }},
                      layout);
}

Eigen::VectorXd source_row(const GearboxLayout& layout, int source, int axis) {
    return std::visit(Overloaded{[&](const PlanetaryLayout& kind) -> Eigen::VectorXd {
                                     return motions_from_degrees(kind).row(
                                         source_motion_index(kind.planets, source) + axis);
                                 },
                                 [&](const FixedShaftLayout& kind) -> Eigen::VectorXd {
                                     return Eigen::VectorXd::Unit(fixed_shaft_motions,
                                                                  2 * kind.sensor + axis);
                                 }},
                      layout);
}

Eigen::VectorXd torque_force(const GearboxLayout& layout, const GearboxInputs& inputs) {
    if (const auto* planetary = std::get_if<PlanetaryLayout>(&layout)) {
        const auto& in = std::get<PlanetaryInputs>(inputs);
        Eigen::VectorXd force = Eigen::VectorXd::Zero(planetary->degrees_of_freedom());
        for (const int body : {carrier, ring, sun}) {
            force(planetary->rotation_index(body)) = in.force_N[body];
        }
        return force;
    }
    return without_meshes(layout, inputs).force;
}

Eigen::MatrixX2d weight_force(const GearboxLayout& layout, const GearboxInputs& inputs) {
    if (const auto* planetary = std::get_if<PlanetaryLayout>(&layout)) {
        Eigen::MatrixX2d weight = planetary_weight(*planetary, std::get<PlanetaryInputs>(inputs));
        const Eigen::MatrixXd mass = without_meshes(layout, inputs).mass;
        for (const int axis : {0, 1}) {
            weight.col(axis) =
                without_rigid_rotation(weight.col(axis), mass, rigid_rotation(layout));
        }
        return weight;
    }
    const auto& in = std::get<FixedShaftInputs>(inputs);
    Eigen::MatrixX2d weight = Eigen::MatrixX2d::Zero(fixed_shaft_motions, 2);
    weight(x_1, 0) = weight(y_1, 1) = in.mass_kg[pinion];
    weight(x_2, 0) = weight(y_2, 1) = in.mass_kg[gear];
    return weight;
}

Eigen::VectorXd angular_acceleration_force(const GearboxLayout& layout, const GearboxInputs& inputs,
                                           int input_degree) {
    const Eigen::VectorXd turn = rigid_rotation(layout);
    Eigen::VectorXd force = -(without_meshes(layout, inputs).mass * turn);
    force(input_degree) -= turn.dot(force) / turn(input_degree);
    return force;
}

}  // namespace gearpod::dynamics
