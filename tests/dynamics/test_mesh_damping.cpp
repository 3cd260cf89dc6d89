// Checks the laws of mesh damping by their formulas and by the modes of a pair of gears.
#include "dynamics/gearbox.hpp"
#include "dynamics/gearbox_matrices.hpp"
#include "tests/test.hpp"

namespace gearpod::dynamics::test_mesh_damping {

constexpr double kPinion_kg = 1.2, kGear_kg = 3.6, kEquivalent_kg = 0.9;
constexpr double kStiffness_N_m = 4e8;

double damping(MeshDamping law, double parameter) {
    return mesh_damping_N_s_m(law, mesh_damping_factor(law, parameter, kPinion_kg, kGear_kg),
                              kStiffness_N_m);
}

// Damping ratio of the only mode with stiffness of two free gears that do not turn.
double modal_damping_ratio(MeshDamping law, double parameter) {
    FixedShaftLayout layout;
    layout.base_radius_m[pinion] = layout.base_radius_m[gear] = 0.05;
    layout.mesh_damping = law;
    FixedShaftInputs in;
    in.mass_kg[pinion] = kPinion_kg;
    in.mass_kg[gear] = kGear_kg;
    in.inertia_kg_m2[pinion] = in.inertia_kg_m2[gear] = 1e12;
    in.motor_inertia_kg_m2 = in.load_inertia_kg_m2 = 1e12;
    in.mesh_damping = parameter;
    const GearboxMatrices m = assemble(layout, in, {kStiffness_N_m});
    const Eigen::Index n = m.mass.rows();
    Eigen::MatrixXd system = Eigen::MatrixXd::Zero(2 * n, 2 * n);
    system.topRightCorner(n, n).setIdentity();
    const Eigen::MatrixXd inverse_mass = inverse(m.mass);
    system.bottomLeftCorner(n, n) = -inverse_mass * m.stiffness;
    system.bottomRightCorner(n, n) = -inverse_mass * m.damping;
    double ratio = 0.0, fastest = 0.0;
    const Eigen::VectorXcd values = eigenvalues(system);
    for (const auto& value : values) {
        if (std::abs(value.imag()) > fastest) {
            fastest = std::abs(value.imag());
            ratio = -value.real() / std::abs(value);
        }
    }
    return ratio;
}

TEST_CASE("Every law of mesh damping has the value of its formula") {
    CHECK(damping(MeshDamping::ratio, 0.05) ==
          Approx(2.0 * 0.05 * std::sqrt(kStiffness_N_m * kEquivalent_kg)));
    CHECK(damping(MeshDamping::proportional, 4e-6) == Approx(1600.0));
}

TEST_CASE("The damping ratio of two gears that vibrate against one another is that of the law") {
    CHECK(modal_damping_ratio(MeshDamping::ratio, 0.05) == Approx(0.05));
    const double w = std::sqrt(kStiffness_N_m / kEquivalent_kg);
    CHECK(modal_damping_ratio(MeshDamping::proportional, 4e-6) == Approx(4e-6 * w / 2.0));
}

}  // namespace gearpod::dynamics::test_mesh_damping
