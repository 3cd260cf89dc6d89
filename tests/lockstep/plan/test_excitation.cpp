// Checks realizations under variable excitation: fluctuating torque and speed against closed forms.
#include <Eigen/Dense>

#include "dynamics/gearbox.hpp"
#include "lockstep/excitation/excitation_rows.hpp"
#include "lockstep/tile/tile_integrators.hpp"
#include "tests/lockstep/liang_train.hpp"
#include "tests/lockstep/pair_of_masses.hpp"
#include "tests/test.hpp"

namespace gearpod::lockstep::test_excitation {

using std::numbers::pi;

// A sine for one realization.
Fluctuation sine(double amplitude, double per_mesh, double per_s, double turns) {
    return {{amplitude}, {per_mesh}, {per_s}, {turns}, {}, {}, {}};
}

// Integrates mesh periods first <= k < last and returns the transmission errors of the last one.
machine::AlignedVector integrate_pair(test::PairOfMasses& pair, const Excitation& excitation,
                                      int first, int last) {
    const std::vector<dynamics::GearboxInputs> inputs{pair.in};
    const auto mesh_integrator = make_excited_integrator<1>(pair.plan, excitation, inputs);
    MeshRecord record = make_record(pair.plan, 1, false);
    for (int k = first; k < last; ++k) {
        (*mesh_integrator)(k, {}, pair.state, record);
    }
    return record.te;
}

TEST_CASE("a sine of the torque gives the frequency response of a mass on a spring",
          "[excitation][lockstep]") {
    const auto [integrator, steps, tolerance] = GENERATE(
        std::tuple(Integrator::rk4, 1200, 1e-6), std::tuple(Integrator::sdirk3, 4800, 1e-6),
        std::tuple(Integrator::central_difference, 9600, 2e-5));
    constexpr double kPeriod = 1e-3, kTorque = 1500.0, kAmplitude = 0.3, kTurns = 0.2;
    const double frequency = GENERATE(500.0, 7000.0);  // below and near the resonance at 7351 Hz
    const double c =
        0.05 * 2.0 * std::sqrt(test::PairOfMasses::kStiffness * test::PairOfMasses::kMass);
    test::PairOfMasses pair(dynamics::MeshLaw::linear, steps, kPeriod, c, integrator);
    pair.in.force_N[dynamics::sun] = kTorque;
    Excitation excitation;
    // Half of the frequency is specified per mesh period, half per second: here they are the same.
    excitation.torque = sine(kAmplitude, 0.5 * frequency * kPeriod, 0.5 * frequency, kTurns);
    constexpr int kMeshes = 20;
    const auto te = integrate_pair(pair, excitation, 0, kMeshes);

    const double w = 2.0 * pi * frequency, m = test::PairOfMasses::kMass;
    const double g = kTorque / test::PairOfMasses::kSun;
    const std::complex<double> response =
        g * kAmplitude /
        std::complex<double>(test::PairOfMasses::kStiffness / m - w * w, w * c / m);
    double worst = 0.0;
    for (std::size_t i = 0; i < te.size(); ++i) {
        const double t =
            (kMeshes - 1 + static_cast<double>(i) / static_cast<double>(te.size())) * kPeriod;
        const double expected = g * m / test::PairOfMasses::kStiffness +
                                std::imag(response * std::polar(1.0, w * t + 2.0 * pi * kTurns));
        worst = std::max(worst, std::abs(te[i] - expected));
    }
    CAPTURE(worst, std::abs(response), frequency, steps);
    CHECK(worst / std::abs(response) < tolerance);
}

TEST_CASE("the damper dissipates the power that a fluctuating torque supplies",
          "[excitation][lockstep]") {
    constexpr double kPeriod = 1e-3, kForce = 1500.0, kAmplitude = 0.5, kFrequency = 6000.0;
    constexpr int kSteps = 960;
    const double c =
        0.1 * 2.0 * std::sqrt(test::PairOfMasses::kStiffness * test::PairOfMasses::kMass);
    test::PairOfMasses pair(dynamics::MeshLaw::linear, kSteps, kPeriod, c);
    pair.in.force_N[dynamics::sun] = kForce;
    Excitation excitation;
    excitation.torque = sine(kAmplitude, kFrequency * kPeriod, 0.0, 0.0);
    // The torque has six periods per mesh period.
    const auto d = integrate_pair(pair, excitation, 0, 20);
    // Over whole periods the sum of (F A / m_s) m sin(w t) d' equals that of c d'^2.
    double in = 0.0, out = 0.0;
    const std::size_t n = d.size();
    for (std::size_t i = 0; i < n; ++i) {
        const double rate =
            (8.0 * (d[(i + 1) % n] - d[(i + n - 1) % n]) - (d[(i + 2) % n] - d[(i + n - 2) % n])) *
            static_cast<double>(n) / (12.0 * kPeriod);
        const double turn =
            2.0 * pi * kFrequency * kPeriod * static_cast<double>(i) / static_cast<double>(n);
        in += kForce * kAmplitude * test::PairOfMasses::kMass / test::PairOfMasses::kSun *
              std::sin(turn) * rate;
        out += c * rate * rate;
    }
    CHECK(in == Approx(out).epsilon(1e-6));
}

TEST_CASE("the spline of the knots is a cubic B-spline", "[excitation][lockstep]") {
    // It repeats a constant and a straight line exactly, and a parabola but for a third of its
    // second difference.
    const auto power = GENERATE(0, 1, 2);
    test::PairOfMasses pair(dynamics::MeshLaw::linear, 7, 0.01);
    Excitation excitation;
    excitation.torque = Fluctuation{{}, {}, {}, {}, {250.0}, {3.25}, {}};
    for (int knot = 0; knot < 40; ++knot) {
        excitation.torque->knot.push_back(std::pow(knot, power));
    }
    const std::vector<dynamics::GearboxInputs> inputs{pair.in};
    ExcitationRows rows(pair.plan, excitation, inputs);
    rows.fill(5);
    for (int step = 0; step < 7; ++step) {
        for (int node = 0; node < 3; ++node) {
            const double u = (5.0 + (step + 0.5 * node) / 7.0) * 0.01 * 250.0 + 3.25;
            const double expected = std::pow(u, power) + (power == 2 ? 1.0 / 3.0 : 0.0);
            CHECK(rows.row(step, node)[0] == Approx(expected).epsilon(1e-13));
        }
    }
}

TEST_CASE("random torque shakes a mass on a spring as the spectra say", "[excitation][lockstep]") {
    constexpr double kPeriod = 1e-3, kForce = 1500.0, kRms = 0.2, kBand = 6000.0;
    constexpr int kMeshes = 600, kRunIn = 20;
    constexpr std::size_t kLanes = 8;
    const double k = test::PairOfMasses::kStiffness, m = test::PairOfMasses::kMass;
    const double c = 0.05 * 2.0 * std::sqrt(k * m);
    test::PairOfMasses pair(dynamics::MeshLaw::linear, 200, kPeriod, c);
    pair.in.force_N[dynamics::sun] = kForce;
    TileState state;
    state.q.assign(4 * kLanes, 0.0);
    state.v.assign(4 * kLanes, 0.0);
    state.filter.assign(2 * 4 * kLanes, 0.0);
    const double spacing = 0.2275119577344975 / kBand;  // sinc(0.2275...)^8 = 1/2 (excitation.hpp)
    const double knot_deviation = std::sqrt(315.0 / 151.0);
    const auto knots = static_cast<std::size_t>((kMeshes + kRunIn) * kPeriod / spacing) + 5;
    Excitation excitation;
    Fluctuation noise;
    std::mt19937_64 engine(7);
    std::normal_distribution<double> unit;
    noise.knots_per_s.assign(kLanes, 1.0 / spacing);
    noise.first_knot.assign(kLanes, 1.0 + kRunIn * kPeriod / spacing);
    for (std::size_t i = 0; i < knots * kLanes; ++i) {
        noise.knot.push_back(kRms * knot_deviation * unit(engine));
    }
    excitation.torque = noise;
    const std::vector<dynamics::GearboxInputs> inputs(kLanes, pair.in);
    const auto mesh_integrator = make_excited_integrator<8>(pair.plan, excitation, inputs);
    MeshRecord record = make_record(pair.plan, kLanes, false);
    double sum = 0.0, count = 0.0;
    const double mean = kForce / test::PairOfMasses::kSun * m / k;
    for (int mesh = -kRunIn; mesh < kMeshes; ++mesh) {
        (*mesh_integrator)(mesh, {}, state, record);
        for (const double te : record.te) {
            sum += mesh < 0 ? 0.0 : (te - mean) * (te - mean);
            count += mesh < 0 ? 0.0 : 1.0;
        }
    }
    // The integral of |H|^2 S over all frequencies.
    double variance = 0.0;
    constexpr double kStep = 2.0;
    for (double f = 0.5 * kStep; f < 40e3; f += kStep) {
        const double w = 2.0 * pi * f, x = pi * f * spacing;
        const double spectrum =
            kRms * kRms * spacing * std::pow(std::sin(x) / x, 8) * 315.0 / 151.0;
        const double response = kForce / test::PairOfMasses::kSun /
                                std::abs(std::complex<double>(k / m - w * w, w * c / m));
        variance += 2.0 * kStep * response * response * spectrum;
    }
    // 8 lanes of 600 ms of a resonance 735 Hz wide: 3500 independent values.
    CHECK(sum / count == Approx(variance).epsilon(0.05));
}

}  // namespace gearpod::lockstep::test_excitation
