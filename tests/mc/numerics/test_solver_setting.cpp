// Checks that the numerics of a solver setting equal those that reading its overrides gives, and
// that invalid settings are rejected as by reading.
#include "mc/numerics/solver_setting.hpp"
#include "tests/mc/scene_examples.hpp"
#include "tests/mc/study_file.hpp"

namespace gearpod::mc::test_solver_setting {

// Reads the study again, without a tolerance and with the setting's overrides.
StudyReading read_again(Study study, const SolverSetting& setting) {
    study.numerics.tolerance = 0.0;
    return read_study_text(resolved_text(study), "study", setting.overrides());
}

void check_as_read(const Study& study, const SolverSetting& setting) {
    INFO(setting.text());
    const StudyReading reading = read_again(study, setting);
    const Planner planner(study);
    if (reading.study) {
        planner.check(setting.numerics, setting.keys());
        CHECK(setting.numerics == reading.study->numerics);
        return;
    }
    try {
        planner.check(setting.numerics, setting.keys());
        FAIL("accepted, although reading rejects it");
    } catch (const SceneError& error) {
        const Problem& first = reading.problems.front();
        CHECK(error.key() == first.key);
        CHECK(error.what() == first.what);
        CHECK(error.remedy() == first.remedy);
    }
}

TEST_CASE("A solver setting gives the numerics that its overrides give") {
    for (const char* const name : {"published/tian-fig-4-9.toml", "planet-crack.toml"}) {
        const Study study = test::shipped_study(name, {"numerics.tolerance=1e-3"});
        check_as_read(study, own_setting(study.numerics));
        for (const SolverFamily& family : solver_families(Planner(study), study.numerics, 1.0)) {
            check_as_read(study, family.common);
            if (family.size() > 0) {
                check_as_read(study, family.setting(family.size() - 1, 1e-7));
            }
        }
    }
}

TEST_CASE("A solver setting is rejected as an invalid study file is") {
    const Study study = test::shipped_study("published/tian-fig-4-9.toml");
    SolverSetting setting = own_setting(study.numerics);
    setting.numerics.steps_per_mesh = 1'200'000;
    check_as_read(study, setting);
    setting = own_setting(study.numerics);
    setting.numerics.integrator = lockstep::Integrator::sdirk3;
    setting.numerics.precision = Precision::single_precision;
    setting.options = {"precision"};
    check_as_read(study, setting);
    const Study quasi_static = test::study_of_text(tests::kQuasiStaticStudy);
    check_as_read(quasi_static, own_setting(quasi_static.numerics));
}

TEST_CASE("The text of a solver setting names the keys that it chooses") {
    SolverSetting setting =
        own_setting(test::shipped_study("published/tian-fig-4-9.toml").numerics);
    setting.numerics.integrator = lockstep::Integrator::sdirk3;
    setting.numerics.steps_per_mesh = 864;
    setting.numerics.convergence_tolerance = 1e-6;
    setting.numerics.grid = StepGrid::graded;
    setting.numerics.grid_tolerance = 0.01;
    setting.options = {"grid", "grid_tolerance"};
    CHECK(setting.text() ==
          "sdirk3, 864 steps, converged to 1e-06, grid=graded, grid_tolerance=0.01");
    CHECK(setting.overrides() ==
          std::vector<std::string>{"numerics.integrator=sdirk3", "numerics.steps_per_mesh=864",
                                   "numerics.settle_tolerance=1e-06", "numerics.grid=graded",
                                   "numerics.grid_tolerance=0.01"});
}

}  // namespace gearpod::mc::test_solver_setting
