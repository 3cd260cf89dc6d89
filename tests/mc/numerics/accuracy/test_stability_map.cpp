// Checks the stability map of a study and its hard cases.
#include "mc/numerics/accuracy/stability_map.hpp"
#include "tests/mc/study_file.hpp"

namespace gearpod::mc::test_stability_map {

TEST_CASE("the stability map has the steps of hard cases next to those of the study",
          "[accuracy]") {
    const Study study = test::shipped_study("published/tian-fig-4-9.toml", {});
    const Scene plan(study);
    const StabilityMap map = stability_map(
        {plan.solve().integration().layout, plan.gearbox().inputs(nominal_inputs(study)),
         plan.gearbox().stiffness->stiffest_pairs()},
        Planner(study).steps(study.numerics));
    const std::size_t own = map.factors.size() / 2;
    REQUIRE(map.factors[own] == Approx(1.0));
    REQUIRE(map.hard.size() == 3);
    for (const HardCase& hard : map.hard) {
        REQUIRE(hard.steps.size() == map.curves.size());
    }
    for (std::size_t i = 0; i < map.curves.size(); ++i) {
        INFO(map.curves[i].integrator);
        // Stiffer bearings raise the fastest mode, a mesh without stiffness lowers that of the
        // mesh.
        CHECK(map.hard[0].steps[i] >= (1.0 - 1e-9) * map.curves[i].steps[own]);
        CHECK(map.hard[1].steps[i] <= (1.0 + 1e-9) * map.curves[i].steps[own]);
        CHECK(map.curves[i].steps.back() >= map.curves[i].steps[own]);
    }
}

}  // namespace gearpod::mc::test_stability_map
