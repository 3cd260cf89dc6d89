// Checks a train with fluctuating speed against closed forms, the same train at another steady
// speed, and the slow limit.
#include <Eigen/Dense>

#include "dynamics/gearbox_matrices.hpp"
#include "lockstep/integrators/sensor_filter.hpp"
#include "lockstep/tile/rigid_rotation.hpp"
#include "lockstep/tile/tile_integrators.hpp"
#include "tests/lockstep/liang_train.hpp"
#include "tests/numbers.hpp"

namespace gearpod::lockstep::test_variable_speed {

using std::numbers::pi;

constexpr double kPeriod = 1e-3;

// A train between a motor and a load with constant springs.
struct TwoShafts {
    IntegrationPlan plan;
    dynamics::FixedShaftInputs in;

    explicit TwoShafts(int steps) {
        dynamics::FixedShaftLayout layout;
        layout.base_radius_m[dynamics::pinion] = 0.03;
        layout.base_radius_m[dynamics::gear] = 0.06;
        layout.mesh_damping = dynamics::MeshDamping::proportional;
        plan.layout = layout;
        plan.grid = make_phase_grid(steps, steps, {});
        plan.nodes.pairs = 1;
        plan.nodes.stiffness.assign(plan.grid.steps.size() * 3, 2e8);
        plan.nodes.damping_shape = plan.nodes.stiffness;
        plan.low_pass_rad_s = 2.0 * pi * 2500.0;
        plan.te_weight = {0, 0, 0, 0, 0, 1.0, -1.0, 0};  // u_1 - u_2
        in.mass_kg[dynamics::pinion] = 1.0;
        in.mass_kg[dynamics::gear] = 2.0;
        in.inertia_kg_m2[dynamics::pinion] = 1e-3;
        in.inertia_kg_m2[dynamics::gear] = 5e-3;
        for (const int g : {dynamics::pinion, dynamics::gear}) {
            in.bearing_stiffness_N_m[g] = 1e8;
            in.bearing_damping_N_s_m[g] = 2e3;
            in.coupling_stiffness_N_m_rad[g] = 1e4;
            in.coupling_damping_N_m_s_rad[g] = 3.0;
        }
        in.motor_inertia_kg_m2 = 2e-3;
        in.load_inertia_kg_m2 = 1e-2;
        in.mesh_damping = 1e3 / 2e8;
        in.mesh_period_s = kPeriod;
    }
};

TileState still(int degrees, int channels) {
    TileState state;
    state.q.assign(static_cast<std::size_t>(degrees), 0.0);
    state.v = state.q;
    state.filter.assign(static_cast<std::size_t>(channels) * kFilterStates, 0.0);
    return state;
}

// A speed that is (1 + value) times its mean throughout, or rises by `slope` per second.
Fluctuation ramp(double value, double slope) {
    Fluctuation f{{}, {}, {}, {}, {100.0}, {10.0}, {}};
    for (int knot = 0; knot < 200; ++knot) {
        f.knot.push_back(value + slope * (knot - 10.0) / 100.0);
    }
    return f;
}

TEST_CASE("a sinusoidal speed excites a train according to its inertias",
          "[uneven-speed][lockstep]") {
    constexpr int kSteps = 400, kMeshes = 60;
    constexpr double kAmplitude = 1e-6, kOrder = 2.0, kSpeed = 3.0;
    const TwoShafts two_shafts(kSteps);
    Excitation excitation;
    excitation.speed = Fluctuation{{kAmplitude}, {kOrder}, {0.0}, {0.1}, {}, {}, {}};
    excitation.input_degree = dynamics::u_m;
    excitation.rotation_m_s = {kSpeed};
    const std::vector<dynamics::GearboxInputs> inputs{two_shafts.in};
    const auto mesh_integrator = make_excited_integrator<1>(two_shafts.plan, excitation, inputs);
    TileState state = still(8, 2);
    MeshRecord record = make_record(two_shafts.plan, 1, false);
    for (int k = 0; k < kMeshes; ++k) {
        (*mesh_integrator)(k, {}, state, record);
    }

    // Newton's law for the relative motion: the motor's shaft drives, all others resist.
    const auto m = dynamics::assemble(two_shafts.plan.layout, inputs[0], {2e8});
    Eigen::VectorXcd force = Eigen::VectorXcd::Zero(8);
    const double inertia[] = {2e-3 / 9e-4, 1e-3 / 9e-4, 5e-3 / 36e-4, 1e-2 / 36e-4};
    for (int i = 0; i < 4; ++i) {
        force(dynamics::u_m + i) = -inertia[i];
        force(dynamics::u_m) += inertia[i];
    }
    const double w = 2.0 * pi * kOrder / kPeriod;
    const std::complex<double> i(0.0, 1.0);
    const Eigen::MatrixXcd dynamic = m.stiffness.cast<std::complex<double>>() -
                                     w * w * m.mass.cast<std::complex<double>>() +
                                     i * w * m.damping.cast<std::complex<double>>();
    // The speed varies as sin(w t + phase): the acceleration is w A u' cos(w t + phase).
    const Eigen::VectorXcd q = dynamic.fullPivLu().solve(force) * (i * w * kAmplitude * kSpeed);
    const std::complex<double> te = q(dynamics::u_1) - q(dynamics::u_2);
    const double p = two_shafts.plan.low_pass_rad_s;
    const auto section = [&](double b) { return p * p / (p * p - w * w + i * b * p * w); };
    const std::complex<double> sensor = -w * w * q(dynamics::y_1) *
                                        section(2.0 * std::cos(pi / 8)) *
                                        section(2.0 * std::cos(3 * pi / 8));
    double te_error = 0.0, sensor_error = 0.0;
    for (std::size_t n = 0; n < kSteps; ++n) {
        const double phase = 2.0 * pi * (kOrder * static_cast<double>(n) / kSteps + 0.1);
        const std::complex<double> turn = std::polar(1.0, phase);
        te_error = std::max(te_error, std::abs(record.te[n] - std::imag(te * turn)));
        sensor_error = std::max(
            sensor_error, std::abs(record.acceleration[2 * n + 1] - std::imag(sensor * turn)));
    }
    CHECK(te_error < 1e-5 * std::abs(te));
    CHECK(sensor_error < 1e-5 * std::abs(sensor));
}

TEST_CASE("a speed that stays above its mean equals another steady speed",
          "[uneven-speed][lockstep]") {
    const auto& train = test::LiangTrain::instance();
    const auto [motion, inertial] =
        GENERATE(std::pair(dynamics::Motion::torsional, false),
                 std::pair(dynamics::Motion::translational_torsional, false),
                 std::pair(dynamics::Motion::translational_torsional, true));
    constexpr double kFaster = 1.3, kSpeedup = 60.0;
    IntegrationPlan plan = train.plan(40, 400, motion, inertial);
    std::get<dynamics::PlanetaryLayout>(plan.layout).bearing_sources =
        motion == dynamics::Motion::translational_torsional;
    const std::vector<dynamics::GearboxInputs> slow{train.inputs(kSpeedup)};
    const std::vector<dynamics::GearboxInputs> fast{train.inputs(kFaster * kSpeedup)};
    Excitation excitation;
    excitation.speed = ramp(kFaster - 1.0, 0.0);
    excitation.input_degree =
        std::get<dynamics::PlanetaryLayout>(plan.layout).rotation_index(dynamics::sun);
    excitation.rotation_m_s = {1.0};
    const auto variable_speed_integrator = make_excited_integrator<1>(plan, excitation, slow);
    const auto steady = make_mesh_integrator<1>(plan, fast);
    TileState a = equilibrium_state(plan, slow), b = a;
    MeshRecord of_variable_speed = make_record(plan, 1, false), of_steady = of_variable_speed;
    for (int k = 0; k < 3; ++k) {
        (*variable_speed_integrator)(k, {}, a, of_variable_speed);
        (*steady)({}, b, of_steady);
    }
    double largest = 0.0, difference = 0.0;
    for (std::size_t n = 0; n < of_steady.acceleration.size(); ++n) {
        largest = std::max(largest, std::abs(of_steady.acceleration[n]));
        difference = std::max(
            difference, std::abs(of_steady.acceleration[n] - of_variable_speed.acceleration[n]));
    }
    CHECK(difference < 1e-9 * largest);
    test::check_close(a.q, b.q, 1e-9, 1e-15);
}

TEST_CASE("a free body moves straight while the carrier accelerates", "[uneven-speed][lockstep]") {
    const auto& train = test::LiangTrain::instance();
    IntegrationPlan plan = train.plan(40, 400, dynamics::Motion::translational_torsional, true);
    std::fill(plan.nodes.stiffness.begin(), plan.nodes.stiffness.end(), 0.0);
    std::fill(plan.nodes.damping_shape.begin(), plan.nodes.damping_shape.end(), 0.0);
    dynamics::PlanetaryInputs in = train.inputs();
    in.mesh_period_s = 0.1;
    in.carrier_speed_rad_s = 15.0;  // 1.5 rad in a mesh period
    in.bearing_stiffness_N_m[dynamics::sun] = in.bearing_damping_N_s_m[dynamics::sun] = 0.0;
    in.bearing_stiffness_N_m[dynamics::planet] = in.bearing_damping_N_s_m[dynamics::planet] = 0.0;
    const std::vector<dynamics::GearboxInputs> inputs{in};
    constexpr double kRise = 6.0;  // relative rise per second: 1.6 times at the end
    Excitation excitation;
    excitation.speed = ramp(0.0, kRise);
    excitation.input_degree = dynamics::motion_index(dynamics::carrier) + 2;
    excitation.rotation_m_s = {0.0};
    const auto mesh_integrator = make_excited_integrator<1>(plan, excitation, inputs);
    const int sun = dynamics::motion_index(dynamics::sun);
    TileState state = still(21, 8);
    state.q[sun] = 2e-3;
    state.q[sun + 1] = 1e-3;
    state.v[sun] = 0.01;
    state.v[sun + 1] = -0.05;
    MeshRecord record = make_record(plan, 1, false);
    (*mesh_integrator)(0, {}, state, record);

    // The frame's axes coincide with the housing's at rest; there the body moves with v + W x r.
    const double time = std::log1p(kRise * in.mesh_period_s) / kRise;
    const double x = 2e-3 + (0.01 - 15.0 * 1e-3) * time;
    const double y = 1e-3 + (-0.05 + 15.0 * 2e-3) * time;
    const double angle = in.carrier_speed_rad_s * in.mesh_period_s;
    CHECK(state.q[sun] == Approx(x * std::cos(angle) + y * std::sin(angle)).epsilon(1e-9));
    CHECK(state.q[sun + 1] == Approx(y * std::cos(angle) - x * std::sin(angle)).epsilon(1e-9));
}

TEST_CASE("a slowly varying speed passes through the periodic orbits of steady speeds",
          "[uneven-speed][lockstep]") {
    const auto& train = test::LiangTrain::instance();
    constexpr double kSpeedup = 40.0, kAmplitude = 0.2;
    constexpr int kBefore = 40;
    const IntegrationPlan plan = train.plan(40, 240, dynamics::Motion::torsional);
    const std::vector<dynamics::GearboxInputs> mean{train.inputs(kSpeedup)};
    const std::vector<dynamics::GearboxInputs> top{train.inputs((1.0 + kAmplitude) * kSpeedup)};
    const auto steady = make_mesh_integrator<1>(plan, top);
    const RigidRotation turn(plan.layout, top);
    TileState periodic_orbit = equilibrium_state(plan, top);
    MeshRecord at_top = make_record(plan, 1, false);
    for (int k = 0; k < 2 * kBefore; ++k) {
        (*steady)({}, periodic_orbit, at_top);
        turn.remove(periodic_orbit);
    }
    // Difference in the mesh period of highest speed, for a variation of so many mesh periods.
    const auto difference = [&](int meshes) {
        Excitation excitation;
        excitation.speed =
            Fluctuation{{kAmplitude}, {1.0 / meshes}, {0.0}, {0.25 - 0.5 / meshes}, {}, {}, {}};
        excitation.input_degree = 2;
        excitation.rotation_m_s = {0.0};
        const auto mesh_integrator = make_excited_integrator<1>(plan, excitation, mean);
        TileState state = periodic_orbit;
        MeshRecord record = at_top;
        for (int k = -kBefore; k <= 0; ++k) {
            (*mesh_integrator)(k, {}, state, record);
            turn.remove(state);
        }
        return test::largest_difference(record.te, at_top.te);
    };
    const auto [low, high] = std::minmax_element(at_top.te.begin(), at_top.te.end());
    const double slow = difference(400), slower = difference(800);
    CHECK(slow < 5e-3 * (*high - *low));
    CHECK(slower < 0.35 * slow);
}

}  // namespace gearpod::lockstep::test_variable_speed
