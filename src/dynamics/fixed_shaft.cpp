#include "dynamics/fixed_shaft.hpp"

#include "dynamics/gearbox_matrices.hpp"

namespace gearpod::dynamics {

Eigen::VectorXd mesh_row(const FixedShaftLayout&) {
    Eigen::VectorXd row = Eigen::VectorXd::Zero(fixed_shaft_motions);
    row(y_1) = -1.0;
    row(y_2) = 1.0;
    row(u_1) = 1.0;
    row(u_2) = -1.0;
    return row;
}

std::vector<SpringDamper> spring_dampers(const FixedShaftLayout& layout,
                                         const FixedShaftInputs& inputs,
                                         const std::vector<double>& pair_stiffness_N_m) {
    std::vector<SpringDamper> springs;
    const auto motion = [](int i) -> Eigen::VectorXd {
        return Eigen::VectorXd::Unit(fixed_shaft_motions, i);
    };
    for (const int g : {pinion, gear}) {
        for (const int axis : {0, 1}) {
            springs.push_back({g == pinion ? "the pinion's bearing" : "the gear's bearing",
                               motion(2 * g + axis), inputs.bearing_stiffness_N_m[g],
                               inputs.bearing_damping_N_s_m[g]});
        }
        const double r2 = layout.base_radius_m[g] * layout.base_radius_m[g];
        springs.push_back({g == pinion ? "the motor coupling" : "the load coupling",
                           g == pinion ? motion(u_m) - motion(u_1) : motion(u_2) - motion(u_b),
                           inputs.coupling_stiffness_N_m_rad[g] / r2,
                           inputs.coupling_damping_N_m_s_rad[g] / r2});
    }
    const double k = pair_stiffness_N_m[0];
    springs.push_back({"the mesh", mesh_row(layout), k,
                       mesh_damping_N_s_m(layout.mesh_damping,
                                          mesh_damping_factor(layout, inputs, PairId{0}), k)});
    return springs;
}

GearboxMatrices assemble(const FixedShaftLayout& layout, const FixedShaftInputs& inputs,
                         const std::vector<double>& pair_stiffness_N_m) {
    GearboxMatrices m = zero_matrices(fixed_shaft_motions);
    const double r_1 = layout.base_radius_m[pinion], r_2 = layout.base_radius_m[gear];
    m.mass.diagonal() << inputs.mass_kg[pinion], inputs.mass_kg[pinion], inputs.mass_kg[gear],
        inputs.mass_kg[gear], inputs.motor_inertia_kg_m2 / (r_1 * r_1),
        inputs.inertia_kg_m2[pinion] / (r_1 * r_1), inputs.inertia_kg_m2[gear] / (r_2 * r_2),
        inputs.load_inertia_kg_m2 / (r_2 * r_2);
    for (const SpringDamper& spring : spring_dampers(layout, inputs, pair_stiffness_N_m)) {
        add(m, spring);
    }
    m.force(u_m) = inputs.motor_torque_N_m / r_1;
    m.force(u_b) = -inputs.load_torque_N_m / r_2;
    const Eigen::VectorXd turn = rigid_rotation(layout);
    const Eigen::VectorXd inertia = m.mass * turn;
    m.force -= inertia * (turn.dot(m.force) / turn.dot(inertia));
    return m;
}

double mesh_damping_factor(const FixedShaftLayout& layout, const FixedShaftInputs& inputs, PairId) {
    return mesh_damping_factor(layout.mesh_damping, inputs.mesh_damping, inputs.mass_kg[pinion],
                               inputs.mass_kg[gear]);
}

Eigen::VectorXd rigid_rotation(const FixedShaftLayout&) {
    Eigen::VectorXd turn = Eigen::VectorXd::Zero(fixed_shaft_motions);
    turn.segment<4>(u_m).setOnes();
    return turn;
}

std::vector<std::string> motion_names(const FixedShaftLayout&) {
    return {"pinion_x", "pinion_y", "gear_x", "gear_y", "motor_u", "pinion_u", "gear_u", "load_u"};
}

}  // namespace gearpod::dynamics
