// Checks Tian's gearbox (2004, chapter 4) with Table 4.1 as printed against published frequencies,
// a closed form and an independent solution of the printed equations.
#include <Eigen/LU>

#include "dynamics/gearbox_matrices.hpp"
#include "lockstep/integrators/sensor_filter.hpp"
#include "lockstep/tile/tile_integrators.hpp"
#include "stiffness/faults/losses.hpp"
#include "tests/lockstep/tian_gearbox.hpp"
#include "tests/test.hpp"

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

std::vector<double> along_y(const MeshRecord& record) {
    std::vector<double> y;
    for (std::size_t i = 1; i < record.acceleration.size(); i += 2) {
        y.push_back(record.acceleration[i]);
    }
    return y;
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

long dominant(const std::vector<double>& amplitudes) {
    return std::max_element(amplitudes.begin() + 1, amplitudes.end()) - amplitudes.begin();
}

// Times of the local extremes of one mesh period's samples, in s.
std::vector<double> extremes(const std::vector<double>& x) {
    std::vector<double> times;
    for (std::size_t i = 1; i + 1 < x.size(); ++i) {
        const double before = x[i] - x[i - 1], after = x[i + 1] - x[i];
        if (before * after < 0.0) {
            // Vertex of the parabola through the three samples.
            const double turn = static_cast<double>(i) + 0.5 * (before + after) / (before - after);
            times.push_back(turn * kPeriod_s / static_cast<double>(x.size()));
        }
    }
    return times;
}

// Frequency from the extremes within (from, to).
double oscillation_Hz(const std::vector<double>& times, double from, double to) {
    double first = to, last = from;
    int halves = -1;
    for (const double t : times) {
        if (t > from && t < to) {
            first = std::min(first, t);
            last = std::max(last, t);
            ++halves;
        }
    }
    return 0.5 * halves / (last - first);
}

// Natural frequency with couplings and bearings fixed by their dampers: pinion with motor against
// gear with load.
double closed_form_Hz(const TianGearbox& gearbox, double stiffness) {
    const auto in = gearbox.inputs();
    const double r1 = gearbox.pinion.base_radius(), r2 = gearbox.gear.base_radius();
    return std::sqrt(stiffness * (r1 * r1 / (in.inertia_kg_m2[0] + in.motor_inertia_kg_m2) +
                                  r2 * r2 / (in.inertia_kg_m2[1] + in.load_inertia_kg_m2))) /
           (2 * pi);
}

// Mean stiffness of the phases between two transitions.
double mean_between(const TianGearbox& gearbox, double from, double to) {
    double sum = 0.0;
    constexpr int kParts = 200;
    for (int i = 0; i < kParts; ++i) {
        sum += gearbox.pairs.total(PairId{0}, from + (to - from) * (i + 0.5) / kParts);
    }
    return sum / kParts;
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
        const auto ours = harmonics(along_y(tile.records[0]), 12);
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

TEST_CASE(
    "The 7th harmonic of 570 Hz dominates the pinion's y acceleration; the 10th without shear") {
    // The thesis reads the 6th and the 8th from its plots; see tests/peers/tian-loose-tolerances.
    const TianGearbox shearless(false);
    CHECK(dominant(harmonics(
              along_y(periodic_orbit(TianGearbox::instance(), 1200, Integrator::sdirk3).records[0]),
              15)) == 7);
    CHECK(dominant(harmonics(
              along_y(periodic_orbit(shearless, 1200, Integrator::sdirk3).records[0]), 15)) == 10);
}

TEST_CASE("With constant stiffness the gearbox oscillates at the closed form's frequency") {
    const TianGearbox& gearbox = TianGearbox::instance();
    const double leaves = gearbox.pair.contact_ratio() - 1.0;
    const double published[] = {3788.0, 3049.0};  // two pairs in contact, one pair
    const double from[] = {0.0, leaves}, to[] = {leaves, 1.0};
    for (std::size_t zone = 0; zone < 2; ++zone) {
        const double k = mean_between(gearbox, from[zone], to[zone]);
        const double expected = closed_form_Hz(gearbox, k);
        CHECK(expected == Approx(published[zone]).epsilon(0.08));

        IntegrationPlan plan = gearbox.plan(kSamples, 1200, Integrator::sdirk3);
        plan.low_pass_rad_s = kLowPass_rad_s;
        std::fill(plan.nodes.stiffness.begin(), plan.nodes.stiffness.end(), k);
        plan.nodes.damping_shape = plan.nodes.stiffness;
        const dynamics::GearboxInputs in = gearbox.inputs();
        Eigen::VectorXd q = dynamics::static_equilibrium(dynamics::assemble(plan.layout, in, {k}));
        q(dynamics::u_m) += 1e-6;  // motor and pinion rotated together
        q(dynamics::u_1) += 1e-6;
        TileState state;
        state.q.assign(q.begin(), q.end());
        state.v.assign(state.q.size(), 0.0);
        state.filter.assign(2 * kFilterStates, 0.0);
        MeshRecord record = make_record(plan, 1, false);
        (*make_mesh_integrator<1>(plan, std::span(&in, 1)))({}, state, record);
        // Extremes of the acceleration after the initial transient.
        CHECK(oscillation_Hz(extremes(along_y(record)), 0.1e-3, 0.9e-3) ==
              Approx(expected).epsilon(0.01));
    }
}

TEST_CASE(
    "After each transition of the periodic orbit the published oscillations occur and decay") {
    const TianGearbox& gearbox = TianGearbox::instance();
    const auto times =
        extremes(along_y(periodic_orbit(gearbox, 1200, Integrator::sdirk3).records[0]));
    const double leaves = (gearbox.pair.contact_ratio() - 1.0) * kPeriod_s;
    constexpr double kAfter = 0.1e-3;  // end of the initial transient
    CHECK(oscillation_Hz(times, kAfter, leaves - kAfter) == Approx(3788.0).epsilon(0.08));
    CHECK(oscillation_Hz(times, leaves + 0.04e-3, kPeriod_s) == Approx(3049.0).epsilon(0.08));
}

TEST_CASE(
    "A broken tooth has zero stiffness in the single-pair zone, and time integration succeeds") {
    const TianGearbox& gearbox = TianGearbox::instance();
    const stiffness::BrokenTooth family;
    FaultCurves faults = gearbox.no_fault(1);
    faults.pattern.length = 19;
    faults.pattern.passages = {{PairId{0}, 0.0}};
    faults.curve[0][0] = stiffness::faulty_mesh(gearbox.pair, family.at(1.0));
    IntegrationPlan plan = gearbox.plan(kSamples, 1200, Integrator::sdirk3);
    plan.low_pass_rad_s = kLowPass_rad_s;

    const auto overrides = FaultSchedule(plan, faults).overrides(0);
    REQUIRE(overrides.size() == 1);
    double least = 1e9;
    for (const double k : overrides[0].stiffness) {
        least = std::min(least, k);
    }
    CHECK(least == 0.0);

    const TileResult tile = run_tile<1>(
        plan, std::vector<dynamics::GearboxInputs>{gearbox.inputs()}, faults, PeriodicSolution{});
    REQUIRE(tile.status[0] == LaneStatus::ok);
    REQUIRE(tile.content[1] > 0);
    const auto shock = along_y(tile.records[static_cast<std::size_t>(tile.content[1])]);
    // The mesh is open for part of a period, so motor and load accelerate the gears apart. Then one
    // pair takes the load: its transient is much larger than the healthy one and oscillates at
    // Tian's 2530 Hz.
    const auto healthy = along_y(tile.records[0]);
    const auto peak = [](const std::vector<double>& x) {
        double largest = 0.0;
        for (const double value : x) {
            largest = std::max(largest, std::abs(value));
        }
        return largest;
    };
    CHECK(peak(shock) > 10 * peak(healthy));
    CHECK(oscillation_Hz(extremes(shock), 0.1e-3, 1.2e-3) == Approx(2530.0).epsilon(0.08));
}

}  // namespace gearpod::lockstep::test_tian
