// Checks that describe names the effects that a scene does not need.
#include "tests/mc/program.hpp"
#include "tests/mc/study_file.hpp"

namespace test_effect_changes {

using namespace gearpod;
using test::program;

TEST_CASE("describe names effects that change nothing and those that a study lacks") {
    const auto description =
        program("describe " + test::study("published/tian-fig-4-9.toml") + " --seconds 30");
    INFO(description.output);
    REQUIRE(description.code == 0);
    CHECK(description.mentions("what the effects change"));
    // Constant forces on a stage whose stiffness varies in the mesh alone; the features are those
    // of the vibration.
    CHECK(description.mentions("omitted; would change no feature by more than 1 %"));
    CHECK(description.mentions("extended contact"));
    CHECK(description.mentions("omitted; would change"));
    CHECK(description.mentions("shear of the teeth"));
    // With a tolerance above all changes no effect is needed.
    const auto loose = program("describe " + test::study("published/tian-fig-4-9.toml") +
                               " --seconds 30 --set numerics.tolerance=0.9");
    INFO(loose.output);
    CHECK(loose.mentions("changes no feature by more than 90 %"));
    CHECK(loose.mentions("so the study does not need it"));
}

TEST_CASE("describe measures effects on short records where every mesh period is integrated") {
    const auto description = program(
        "describe " + test::study("published/yang-pitch-errors.toml") + test::measuring_for(3) +
        " --set ensemble.instances=8 --set ensemble.threshold_instances=20");
    INFO(description.output);
    REQUIRE(description.code == 0);
    CHECK(description.mentions("s: 3 turns of "));
    CHECK(description.mentions("tooth errors"));
}

}  // namespace test_effect_changes
