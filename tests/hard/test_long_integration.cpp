// Checks a million mesh periods without damping: amplitude and phase follow each method's
// amplification factor R, z_n = R(i w h)^n z_0.
#include "lockstep/integrators/facts.hpp"
#include "lockstep/integrators/sdirk3.hpp"
#include "lockstep/steps/stability.hpp"
#include "tests/lockstep/pair_of_masses.hpp"
#include "tests/test.hpp"

namespace gearpod::lockstep::test_long_integration {

using test::PairOfMasses;
using Complex = std::complex<double>;

// Amplification factor R(z) of the methods.
Complex amplification(Integrator integrator, Complex z) {
    switch (integrator) {
        case Integrator::newmark:  // average acceleration: the trapezoidal rule
            return (1.0 + 0.5 * z) / (1.0 - 0.5 * z);
        case Integrator::sdirk3: {
            const double x = Alexander::kDiagonal;
            const Complex below = 1.0 - x * z;
            const Complex s1 = z / below;
            const Complex s2 = (z + z * Alexander::k21 * s1) / below;
            const Complex s3 = (z + z * (Alexander::k31 * s1 + Alexander::k32 * s2)) / below;
            return 1.0 + Alexander::k31 * s1 + Alexander::k32 * s2 + x * s3;
        }
        case Integrator::central_difference:  // a rotation by phi, sin(phi / 2) = |z| / 2
            return std::polar(1.0, 2.0 * std::asin(0.5 * z.imag()));
        default:
            return 1.0 + z * (1.0 + z / 2.0 * (1.0 + z / 3.0 * (1.0 + z / 4.0)));
    }
}

// Starts from d = 1 um at rest, without load and without common motion.
PairOfMasses swinging(int steps, double period_s, Integrator integrator) {
    PairOfMasses masses(dynamics::MeshLaw::linear, steps, period_s, 0.0, integrator);
    masses.plan.grid = make_phase_grid(1, steps, {});
    masses.plan.grid.stage_nodes = stage_nodes(integrator);
    constexpr double kSum = PairOfMasses::kSun + PairOfMasses::kPlanet;
    masses.state.q[2] = 1e-6 * PairOfMasses::kPlanet / kSum;
    masses.state.q[3] = 1e-6 * PairOfMasses::kSun / kSum;
    return masses;
}

void integrate_meshes(PairOfMasses& masses, long meshes) {
    const dynamics::GearboxInputs inputs = masses.in;
    const auto mesh_integrator = make_mesh_integrator<1>(masses.plan, std::span(&inputs, 1));
    MeshRecord record = make_record(masses.plan, 1, false);
    for (long i = 0; i < meshes; ++i) {
        (*mesh_integrator)({}, masses.state, record);
    }
}

TEST_CASE("After a million undamped mesh periods the motion follows the method's theory") {
    const auto [integrator, meshes] =
        GENERATE(std::pair{Integrator::newmark, 1'000'000L}, std::pair{Integrator::rk4, 1'000'000L},
                 std::pair{Integrator::sdirk3, 20'000L},
                 std::pair{Integrator::central_difference, 1'000'000L});
    constexpr int kSteps = 4;
    constexpr double kAngle = 0.15;  // w h, 42 steps in a natural period
    PairOfMasses masses(dynamics::MeshLaw::linear, kSteps, 1.0);
    const double w = masses.natural_rad_s();
    masses = swinging(kSteps, kSteps * kAngle / w, integrator);
    integrate_meshes(masses, meshes);
    const Complex r = amplification(integrator, {0.0, kAngle});
    const double steps = static_cast<double>(meshes) * kSteps;
    const double size = std::exp(steps * std::log(std::abs(r)));
    const double phase = std::fmod(steps * std::arg(r), 2.0 * std::numbers::pi);
    INFO("integrator " << static_cast<int>(integrator) << ", |R|^n = " << size);
    const Complex expected = 1e-6 * size * std::polar(1.0, phase);
    CHECK(masses.deflection() == Approx(expected.real()).margin(1e-6 * 1e-6 * size));
    // The states of central differences lie on an ellipse: their conserved energy has v^2 (1 - (w
    // h)^2 / 4).
    const double axis =
        integrator == Integrator::central_difference ? std::sqrt(1.0 - kAngle * kAngle / 4) : 1.0;
    CHECK(-axis * masses.rate() / w == Approx(expected.imag()).margin(1e-6 * 1e-6 * size));
    const double energy = std::pow(masses.deflection(), 2) + std::pow(axis * masses.rate() / w, 2);
    CHECK(energy == Approx(1e-12 * size * size).epsilon(1e-8));
    if (integrator == Integrator::newmark) {
        CHECK(std::abs(r) == Approx(1.0).epsilon(1e-15));  // conserves the energy
    }
    CHECK(masses.momentum() == Approx(0.0).margin(1e-12 * w * 1e-6));
}

TEST_CASE("A million mesh periods of changing stiffness neither add nor remove energy") {
    const auto integrator =
        GENERATE(Integrator::newmark, Integrator::rk4, Integrator::central_difference);
    constexpr int kSteps = 24;
    PairOfMasses masses(dynamics::MeshLaw::linear, kSteps, 1.0);
    // A mesh period of 0.7 half waves is away from the resonances of Meissner's equation.
    const double period = 0.7 * std::numbers::pi / masses.natural_rad_s();
    masses = swinging(kSteps, period, integrator);
    auto& k = masses.plan.nodes.stiffness;
    for (std::size_t i = 0; i < k.size() / 2; ++i) {
        k[2 * i] *= i < k.size() / 4 ? 0.9 : 1.1;
    }
    CHECK(growth_per_mesh(masses.plan, masses.in) == Approx(1.0).epsilon(1e-7));
    integrate_meshes(masses, 200'000);
    const double size = std::hypot(masses.deflection(), masses.rate() / masses.natural_rad_s());
    CHECK(size > 0.8e-6);
    CHECK(size < 1.2e-6);
}

}  // namespace gearpod::lockstep::test_long_integration
