// Checks the stated assumptions of a result.
#include "mc/study/assumptions.hpp"
#include "tests/mc/study_file.hpp"

namespace gearpod::test_assumptions {

using namespace gearpod::test;

std::string assumptions(const gearpod::mc::Study& study) {
    return gearpod::mc::assumptions(study, false);
}

TEST_CASE("A result states for which teeth and planets it is valid") {
    const std::string ideal = assumptions(shipped_study("planet-crack-ideal.toml"));
    CHECK_THAT(ideal, Catch::Contains("identical teeth, identical planets and pins, rigid gear "
                                      "bodies, steady torque and speed"));
    CHECK_THAT(ideal, Catch::Contains("Real teeth can hide faults"));

    const std::string real =
        assumptions(shipped_study("planet-crack-ideal.toml",
                                  {"gearbox.tooth_quality=6", "gearbox.pin_tangential_rms_um=20"}));
    CHECK_THAT(real, Catch::StartsWith(
                         "These results hold for teeth of ISO 1328 grade 6, rigid gear bodies"));
    CHECK_THAT(real, !Catch::Contains("hide faults"));
    CHECK_THAT(real, !Catch::Contains("identical planets"));

    CHECK_THAT(assumptions(shipped_study("planet-crack-ideal.toml", {"gearbox.pitch_error_um=2"})),
               Catch::Contains("teeth with individual errors"));
    CHECK_THAT(assumptions(shipped_study("real-teeth.toml")),
               Catch::Contains("teeth of random ISO 1328 grades") &&
                   Catch::Contains("a healthy record of the same gearbox, taken at a torque that "
                                   "differs by 2 % (rms)"));
}

TEST_CASE("Crack growth is an assumption of results on lives, not of a run of the same study") {
    const gearpod::mc::Study study = shipped_study("planet-life.toml");
    CHECK_THAT(gearpod::mc::assumptions(study, true), Catch::Contains("grow by Paris' law"));
    CHECK_THAT(gearpod::mc::assumptions(study, false), !Catch::Contains("Paris"));
}

}  // namespace gearpod::test_assumptions
