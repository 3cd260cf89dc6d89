#include "dynamics/varying_forces.hpp"

#include <cmath>

#include "dynamics/gearbox_matrices.hpp"

namespace gearpod::dynamics {
namespace {

GearboxMatrices without_meshes(const GearboxLayout& layout, const GearboxInputs& inputs) {
    return assemble(layout, inputs,
                    std::vector<double>(static_cast<std::size_t>(pairs(layout)), 0.0));
}

Eigen::MatrixX2d planetary_weight(const PlanetaryLayout& layout, const PlanetaryInputs& in) {
    Eigen::MatrixX2d weight = Eigen::MatrixX2d::Zero(layout.motions(), 2);
    for (int i = 0; i < 3 + layout.planets; ++i) {
        const double mass = i < planet ? in.mass_kg[i] : in.planet_mass_kg(i - planet);
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
