// Checks parametric resonance: periodic mesh stiffness makes a motion grow. Floquet multipliers
// decide this; they are computed here independently of the program's time integration.
#include <unsupported/Eigen/MatrixFunctions>

#include "dynamics/gearbox_matrices.hpp"
#include "lockstep/steps/stability.hpp"
#include "tests/lockstep/liang_train.hpp"
#include "tests/lockstep/pair_of_masses.hpp"
#include "tests/test.hpp"

namespace gearpod::lockstep::test_parametric_resonance {

using std::numbers::pi;
using test::LiangTrain;
using test::PairOfMasses;

// Meissner's equation: d'' + 2 beta d' + w(t)^2 d = 0 with two stiffnesses, half a period each.
// With d = exp(-beta t) y the halves are rotations, and the multipliers follow from their trace.
struct Meissner {
    double stiffness[2];
    double period_s, damping_N_s_m;

    double beta() const { return 0.5 * damping_N_s_m / PairOfMasses::kMass; }
    double undamped_multiplier() const {
        double w[2], angle[2];
        for (int i = 0; i < 2; ++i) {
            w[i] = std::sqrt(stiffness[i] / PairOfMasses::kMass - beta() * beta());
            angle[i] = 0.5 * w[i] * period_s;
        }
        const double half_trace =
            std::abs(std::cos(angle[0]) * std::cos(angle[1]) -
                     0.5 * (w[0] / w[1] + w[1] / w[0]) * std::sin(angle[0]) * std::sin(angle[1]));
        return half_trace <= 1.0 ? 1.0 : half_trace + std::sqrt(half_trace * half_trace - 1.0);
    }
    double largest_multiplier() const {
        return std::exp(-beta() * period_s) * undamped_multiplier();
    }
};

PairOfMasses pair_of(const Meissner& m, int steps, Integrator integrator) {
    PairOfMasses masses(dynamics::MeshLaw::linear, steps, m.period_s, m.damping_N_s_m, integrator);
    const std::size_t nodes = masses.plan.nodes.stiffness.size() / 2;
    for (std::size_t i = 0; i < nodes; ++i) {
        masses.plan.nodes.stiffness[2 * i] = m.stiffness[i < nodes / 2 ? 0 : 1];
    }
    // Only the deflection moves; the pair's common motion is zero.
    constexpr double kSum = PairOfMasses::kSun + PairOfMasses::kPlanet;
    masses.state.q[2] = 1e-6 * PairOfMasses::kPlanet / kSum;
    masses.state.q[3] = 1e-6 * PairOfMasses::kSun / kSum;
    return masses;
}

double size_of(const PairOfMasses& masses) {
    return std::hypot(masses.deflection(), masses.rate() / masses.natural_rad_s());
}

// Growth per period over the second half of `meshes`, when the fastest growing motion dominates.
double integrated_growth(PairOfMasses masses, int meshes) {
    double half_way = 0.0;
    for (int mesh = 0; mesh < meshes; ++mesh) {
        if (mesh == meshes / 2) {
            half_way = size_of(masses);
        }
        masses.integrate_mesh();
    }
    return std::pow(size_of(masses) / half_way, 2.0 / meshes);
}

// Equations of Liang's rotations (carrier, ring, sun, planets) from their energies, independent of
// the library.
class LiangRotations {
  public:
    explicit LiangRotations(const dynamics::PlanetaryInputs& in) : in_(in) {
        mass_.setZero();
        mass_(0) = in.inertia_over_r2_kg[dynamics::carrier] + 4 * in.mass_kg[dynamics::planet];
        mass_(1) = in.inertia_over_r2_kg[dynamics::ring];
        mass_(2) = in.inertia_over_r2_kg[dynamics::sun];
        mass_.tail(4).setConstant(in.inertia_over_r2_kg[dynamics::planet]);
    }

    // Largest |multiplier| apart from the rotation of the whole train, which is exactly 1 twice.
    double largest_multiplier(int pieces) const {
        std::vector<double> cuts = contact_transitions(LiangTrain::instance().pairs);
        for (int i = 0; i <= pieces; ++i) {
            cuts.push_back(static_cast<double>(i) / pieces);
        }
        std::sort(cuts.begin(), cuts.end());
        Eigen::MatrixXd over_mesh = Eigen::MatrixXd::Identity(14, 14);
        for (std::size_t i = 1; i < cuts.size(); ++i) {
            const double length = cuts[i] - cuts[i - 1], middle = 0.5 * (cuts[i] + cuts[i - 1]);
            over_mesh = ((in_.mesh_period_s * length) * system(middle)).exp() * over_mesh;
        }
        auto sizes = dynamics::eigenvalues(over_mesh);
        double largest = 0.0;
        for (const auto multiplier : sizes) {
            if (std::abs(multiplier - 1.0) > 1e-4) {
                largest = std::max(largest, std::abs(multiplier));
            }
        }
        return largest;
    }

  private:
    using Vector = Eigen::Matrix<double, 7, 1>;
    using Matrix = Eigen::Matrix<double, 7, 7>;

    // The state holds displacements in units of 1e-4 s times the velocities.
    Eigen::MatrixXd system(double phase) const {
        const auto& train = LiangTrain::instance();
        Matrix stiffness = Matrix::Zero(), damping = Matrix::Zero();
        for (int pair = 0; pair < 8; ++pair) {
            const bool ring = pair >= 4;
            Vector row = Vector::Zero();
            row(0) = -std::cos(LiangTrain::kAngle);
            row(ring ? 1 : 2) = 1.0;
            row(3 + pair % 4) = ring ? -1.0 : 1.0;
            const double k = train.pairs.total(PairId{pair}, phase);
            const double m1 = in_.mass_kg[ring ? dynamics::ring : dynamics::sun];
            const double m2 = in_.mass_kg[dynamics::planet];
            stiffness += k * row * row.transpose();
            damping +=
                2.0 * in_.mesh_damping * std::sqrt(k * m1 * m2 / (m1 + m2)) * row * row.transpose();
        }
        stiffness(1, 1) += in_.support_stiffness_N_m;
        damping(1, 1) += in_.support_damping_N_s_m;
        constexpr double kUnit_s = 1e-4;
        Eigen::MatrixXd a = Eigen::MatrixXd::Zero(14, 14);
        a.topRightCorner(7, 7) = Matrix::Identity() / kUnit_s;
        a.bottomLeftCorner(7, 7) = -kUnit_s * (mass_.cwiseInverse().asDiagonal() * stiffness);
        a.bottomRightCorner(7, 7) = -(mass_.cwiseInverse().asDiagonal() * damping);
        return a;
    }

    const dynamics::PlanetaryInputs& in_;
    Vector mass_;
};

TEST_CASE("A pair grows or decays by the multiplier of Meissner's equation") {
    const auto integrator = GENERATE(Integrator::rk4, Integrator::newmark, Integrator::sdirk3,
                                     Integrator::central_difference);
    // Stiffness is two thirds and four thirds of the mean, and a mesh lasts half a natural period:
    // the main resonance.
    Meissner m{{PairOfMasses::kStiffness * 2 / 3, PairOfMasses::kStiffness * 4 / 3}, 0.0, 0.0};
    m.period_s = pi / std::sqrt(PairOfMasses::kStiffness / PairOfMasses::kMass);
    const double growth = m.undamped_multiplier();
    REQUIRE(growth > 1.1);
    // Damping at which growth and decay balance, first without its frequency shift.
    const double balance = 2.0 * PairOfMasses::kMass * std::log(growth) / m.period_s;
    for (const double share : {0.0, 0.9, 0.98, 1.02, 1.1}) {
        m.damping_N_s_m = share * balance;
        const double expected = m.largest_multiplier();
        INFO("integrator " << static_cast<int>(integrator) << ", damping " << share
                           << " of the balance, multiplier " << expected);
        const PairOfMasses masses = pair_of(m, 400, integrator);
        CHECK(integrated_growth(masses, 60) == Approx(expected).epsilon(2e-4));
        CHECK(growth_per_mesh(masses.plan, masses.in) ==
              Approx(std::max(expected, 1.0)).epsilon(2e-4));
        CHECK((find_instability(masses.plan, masses.in) == Instability::parametric) ==
              (expected > 1.0));
    }
    m.damping_N_s_m = 0.0;
    const PairOfMasses masses = pair_of(m, 400, integrator);
    CHECK(growth_per_mesh(masses.plan, masses.in) == Approx(growth).epsilon(1e-5));
    CHECK(find_instability(masses.plan, masses.in) == Instability::parametric);
}

TEST_CASE("Away from its resonances a pair is stable although its stiffness changes") {
    const double w = std::sqrt(PairOfMasses::kStiffness / PairOfMasses::kMass);
    for (const double half_waves : {0.7, 1.4, 2.45}) {
        const Meissner m{{PairOfMasses::kStiffness * 0.9, PairOfMasses::kStiffness * 1.1},
                         half_waves * pi / w,
                         0.0};
        REQUIRE(m.undamped_multiplier() == 1.0);
        PairOfMasses masses = pair_of(m, 400, Integrator::rk4);
        CHECK(find_instability(masses.plan, masses.in) == Instability::none);
        const double first = size_of(masses);
        double largest = first;
        for (int mesh = 0; mesh < 2000; ++mesh) {
            masses.integrate_mesh();
            largest = std::max(largest, size_of(masses));
        }
        CHECK(largest < 2.0 * first);
    }
}

TEST_CASE(
    "Liang's rotations: convergence or divergence of the tile matches independent multipliers") {
    const auto& train = LiangTrain::instance();
    const IntegrationPlan plan = train.plan(24, 600, dynamics::Motion::torsional);
    int stable = 0, unstable = 0;
    for (const double speedup : {180.0, 200.0, 230.0, 240.0, 270.0, 320.0, 360.0, 400.0}) {
        auto in = train.inputs(speedup);
        in.mesh_damping = 0.002;
        in.support_damping_N_s_m = 5e3;
        const double expected = LiangRotations(in).largest_multiplier(200);
        INFO("carrier at " << speedup * 8.87 << " rpm, multiplier " << expected);
        CHECK(growth_per_mesh(plan, in) == Approx(expected).epsilon(2e-4));
        const bool grows = expected > 1.0;
        (grows ? unstable : stable) += 1;
        const PeriodicSolution solution{.convergence = {1e-6, 20000}};
        const std::vector<dynamics::GearboxInputs> inputs{in};
        const TileResult tile = run_tile<1>(plan, inputs, train.no_fault(1), solution);
        CHECK(tile.status[0] == (grows ? LaneStatus::diverged : LaneStatus::ok));
        CHECK((find_instability(plan, in) == Instability::parametric) == grows);
    }
    CHECK(stable > 0);
    CHECK(unstable > 0);
}

}  // namespace gearpod::lockstep::test_parametric_resonance
