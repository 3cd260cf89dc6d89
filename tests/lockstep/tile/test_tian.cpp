// Checks Tian's gearbox (2004, chapter 4) with Table 4.1 as printed against an independent solution
// of the printed equations. tests/mc/studies/test_tian_studies.cpp checks the published
// frequencies.
#include <Eigen/LU>

#include "dynamics/gearbox_matrices.hpp"
#include "lockstep/tile/tile_integrators.hpp"
#include "tests/lockstep/tian_gearbox.hpp"
#include "tests/numbers.hpp"

namespace gearpod::lockstep::test_tian {

using std::numbers::pi;
using test::TianGearbox;

constexpr double kPeriod_s = 1.0 / TianGearbox::kMeshFrequency_Hz;

constexpr int kSamples = 600;
constexpr double kLowPass_rad_s = 2 * pi * 100e3;  // above all relevant frequencies

// Healthy periodic orbit with the sensor on the pinion's bearing.
TileResult periodic_orbit(const TianGearbox& gearbox, int steps, Integrator integrator) {
    IntegrationPlan plan = gearbox.plan(kSamples, steps, integrator);
    plan.low_pass_rad_s = kLowPass_rad_s;
    return run_tile<1>(plan, std::vector<dynamics::GearboxInputs>{gearbox.inputs()},
                       gearbox.no_fault(1), PeriodicSolution{.with_motion = true});
}

// Amplitudes of the harmonics 0..count of one period.
std::vector<double> harmonics(const std::vector<double>& signal, int count) {
    std::vector<double> result;
    for (int order = 0; order <= count; ++order) {
        std::complex<double> sum = 0.0;
        for (std::size_t i = 0; i < signal.size(); ++i) {
            sum += signal[i] * std::polar(1.0, -2 * pi * order * static_cast<double>(i) /
                                                   static_cast<double>(signal.size()));
        }
        result.push_back(2.0 * std::abs(sum) / static_cast<double>(signal.size()));
    }
    return result;
}

// Solves Eqs. 4.3-4.8 in y1 y2 and the angles of motor, pinion, gear and load with the printed
// torques (except the sign in Eq. 4.4). The trapezoidal rule has 1754 equal steps per mesh period,
// independent of transitions. Gives pinion's y'' and R1 th1 - R2 th2 over the last of `meshes`
// periods.
struct DenseSolution {
    std::vector<double> acceleration, turn;
};

DenseSolution trapezoidal_rule(const TianGearbox& gearbox, int meshes) {
    constexpr int kSteps = 1754;
    using Matrix = Eigen::Matrix<double, 6, 6>;
    using Vector = Eigen::Matrix<double, 6, 1>;
    const auto in = gearbox.inputs();
    const double r1 = gearbox.pinion.base_radius(), r2 = gearbox.gear.base_radius();
    Vector mass, load, mesh;
    mass << in.mass_kg[0], in.mass_kg[1], in.motor_inertia_kg_m2, in.inertia_kg_m2[0],
        in.inertia_kg_m2[1], in.load_inertia_kg_m2;
    load << 0, 0, in.motor_torque_N_m, 0, 0, -in.load_torque_N_m;
    mesh << -1, 1, 0, r1, -r2, 0;
    // Matrices with these coefficients of bearings and couplings.
    const auto with = [&](double bearing, double coupling) {
        Matrix m = Matrix::Zero();
        m(0, 0) = m(1, 1) = bearing;
        for (const int i : {2, 4}) {
            m(i, i) = m(i + 1, i + 1) = coupling;
            m(i, i + 1) = m(i + 1, i) = -coupling;
        }
        return m;
    };
    const Matrix stiffness = with(in.bearing_stiffness_N_m[0], in.coupling_stiffness_N_m_rad[0]);
    const Matrix damping = with(in.bearing_damping_N_s_m[0], in.coupling_damping_N_m_s_rad[0]);
    const auto k_at = [&](int step) {
        return gearbox.pairs.total(PairId{0}, static_cast<double>(step % kSteps) / kSteps);
    };

    // Start: the train accelerates without vibration.
    Vector turn;
    turn << 0, 0, 1 / r1, 1 / r1, 1 / r2, 1 / r2;
    const Vector inertia = mass.cwiseProduct(turn);
    const Vector speeding_up = turn * (turn.dot(load) / turn.dot(inertia));
    const double k0 = k_at(0);
    Vector q = dynamics::solve(stiffness + k0 * mesh * mesh.transpose(),
                               load - mass.cwiseProduct(speeding_up));
    Vector v = Vector::Zero(), a = speeding_up;
    DenseSolution solution;
    const double h = kPeriod_s / kSteps;
    for (int i = 1; i <= meshes * kSteps; ++i) {
        const double k = k_at(i);
        const Matrix kk = stiffness + k * mesh * mesh.transpose();
        const Matrix cc = damping + in.mesh_damping * k * mesh * mesh.transpose();
        const Vector v_half = v + 0.5 * h * a, q_half = q + h * v + 0.25 * h * h * a;
        Matrix left = 0.5 * h * cc + 0.25 * h * h * kk;
        left.diagonal() += mass;
        a = left.partialPivLu().solve(load - cc * v_half - kk * q_half);
        v = v_half + 0.5 * h * a;
        q = q_half + 0.25 * h * h * a;
        if (i > (meshes - 1) * kSteps) {
            solution.acceleration.push_back(a(0));
            solution.turn.push_back(r1 * q(3) - r2 * q(4));
        }
    }
    return solution;
}

TEST_CASE("Tian's gearbox as printed agrees with a dense solution of his equations") {
    const TianGearbox& gearbox = TianGearbox::instance();
    const DenseSolution dense = trapezoidal_rule(gearbox, 12);
    const auto expected = harmonics(dense.acceleration, 12);
    for (const auto& [integrator, steps] :
         {std::pair{Integrator::sdirk3, 1200}, std::pair{Integrator::newmark, 3600}}) {
        const TileResult tile = periodic_orbit(gearbox, steps, integrator);
        REQUIRE(tile.status[0] == LaneStatus::ok);
        const auto y = test::every(2, tile.records[0].acceleration, 1);
        const auto ours = harmonics(y, 12);
        for (std::size_t order = 1; order <= 12; ++order) {
            INFO("order " << order);
            CHECK(ours[order] == Approx(expected[order]).margin(0.01 * expected[7]));
        }
        // Amplitudes of the first harmonics of the mesh's rotational deflection.
        std::vector<double> turn;
        for (std::size_t i = 0; i < kSamples; ++i) {
            const double* q = tile.records[0].motion.data() + i * dynamics::fixed_shaft_motions;
            turn.push_back(q[dynamics::u_1] - q[dynamics::u_2]);
        }
        const auto a = harmonics(turn, 8), b = harmonics(dense.turn, 8);
        for (std::size_t order = 0; order <= 8; ++order) {
            CHECK(a[order] == Approx(b[order]).margin(0.005 * b[1]));
        }
    }
}

}  // namespace gearpod::lockstep::test_tian
