// Checks light load near the resonance of the mesh: teeth lose contact and collide every few
// periods.
#include "tests/lockstep/pair_of_masses.hpp"
#include "tests/test.hpp"

namespace gearpod::lockstep::test_impacts {

using test::PairOfMasses;

// Load over stiffness is 0.1 um; the flanks' error has an amplitude of 0.5 um close to resonance.
constexpr double kRest_m = 1e-7, kError_m = 5e-7;

PairOfMasses rattling(Integrator integrator, double of_resonance, int steps) {
    PairOfMasses masses(dynamics::MeshLaw::separating, steps, 1.0, 0.0, integrator);
    const double w = masses.natural_rad_s();
    masses.in.mesh_period_s = 2.0 * std::numbers::pi / (of_resonance * w);
    masses.in.mesh_damping = 2.0 * 0.05 * w * PairOfMasses::kMass / PairOfMasses::kStiffness;
    masses.in.force_N[dynamics::sun] =
        kRest_m * PairOfMasses::kStiffness * PairOfMasses::kSun / PairOfMasses::kMass;
    auto& nodes = masses.plan.nodes;
    for (const Step& step : masses.plan.grid.steps) {
        for (const double at : masses.plan.grid.stage_nodes) {
            const double angle = 2.0 * std::numbers::pi * (step.phase + at * step.length);
            nodes.error.insert(nodes.error.end(), {kError_m * std::sin(angle), 0.0});
            nodes.error_rate.insert(nodes.error_rate.end(),
                                    {2.0 * std::numbers::pi * kError_m * std::cos(angle), 0.0});
        }
    }
    masses.plan.te_weight = {0.0, 0.0, 1.0, 1.0};
    return masses;
}

TEST_CASE("For any sequence of impacts the mean contact force carries the load") {
    const auto integrator = GENERATE(Integrator::rk4, Integrator::newmark, Integrator::sdirk3,
                                     Integrator::central_difference);
    for (const double of_resonance : {0.9, 1.0, 1.15}) {
        constexpr int kSteps = 800, kRunIn = 100, kMeshes = 300;
        PairOfMasses masses = rattling(integrator, of_resonance, kSteps);
        const double c = masses.in.mesh_damping * PairOfMasses::kStiffness;
        double impulse = 0.0, apart = 0.0, largest = 0.0, before = 0.0;
        for (int mesh = 0; mesh < kRunIn + kMeshes; ++mesh) {
            if (mesh == kRunIn) {
                before = masses.rate();
            }
            const auto d = masses.integrate_mesh();
            for (std::size_t i = 0; mesh >= kRunIn && i < d.size(); ++i) {
                const double phase = 2.0 * std::numbers::pi * static_cast<double>(i) / kSteps;
                const double pressed = d[i] - kError_m * std::sin(phase);
                const double next = i + 1 < d.size() ? d[i + 1] : masses.deflection();
                const double rate =
                    (next - d[i]) / masses.in.mesh_period_s * kSteps -
                    2.0 * std::numbers::pi * kError_m * std::cos(phase) / masses.in.mesh_period_s;
                apart += pressed > 0.0 ? 0.0 : 1.0;
                impulse += pressed > 0.0 ? PairOfMasses::kStiffness * pressed + c * rate : 0.0;
                largest = std::max(largest, std::abs(pressed));
            }
        }
        apart /= kMeshes * kSteps;
        impulse /= kMeshes * kSteps;
        // The difference of the load's and the contact's impulse equals the change of momentum.
        const double motion =
            PairOfMasses::kMass * (masses.rate() - before) / (kMeshes * masses.in.mesh_period_s);
        INFO("integrator " << static_cast<int>(integrator) << ", " << of_resonance
                           << " of the resonance, out of contact " << apart);
        CHECK(impulse + motion == Approx(kRest_m * PairOfMasses::kStiffness).epsilon(0.02));
        CHECK(apart > 0.02);
        CHECK(apart < 0.98);
        CHECK(largest < 400 * kError_m);
    }
}

}  // namespace gearpod::lockstep::test_impacts
