// Checks that describe names the effects that a scene does not need.
#include "tests/mc/program.hpp"
#include "tests/mc/study_file.hpp"

namespace gearpod::test_effect_changes {

using namespace test;

TEST_CASE("describe names effects that change nothing and those that a study lacks") {
    const auto description =
        require_success("describe " + study("published/tian-fig-4-9.toml") + " --seconds 30");
    CHECK(description.mentions("what the effects change"));
    // Constant forces on a stage whose stiffness varies in the mesh alone; the features are those
    // of the vibration.
    check_mentions(description,
                   {"omitted, not needed: ", "no feature changes by more than 1 %",
                    "extended contact", "omitted; would change", "shear of the teeth"});
    // With a tolerance above all changes no effect is needed.
    check_mentions(program("describe " + study("published/tian-fig-4-9.toml") +
                           " --seconds 30 --set numerics.tolerance=0.9"),
                   {"no feature changes by more than 90 %", "simulated, not needed: "});
}

TEST_CASE("describe measures effects on short records where every mesh period is integrated") {
    check_mentions(
        require_success("describe " + study("published/yang-pitch-errors.toml") + measuring_for(3) +
                        " --set ensemble.instances=8 --set ensemble.threshold_instances=20"),
        {"s: 3 turns of ", "tooth errors"});
}

}  // namespace gearpod::test_effect_changes
