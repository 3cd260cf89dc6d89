// Checks the stated assumptions of a result, and targets of false alarms in time.
#include "mc/study/assumptions.hpp"
#include "mc/study/schema/schema.hpp"
#include "mc/study/study.hpp"
#include "tests/mc/study_example.hpp"
#include "tests/mc/study_file.hpp"
#include "tests/test.hpp"

namespace gearpod::mc::test_assumptions {

using namespace gearpod::test;
using tests::kExampleStudy;

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
    CHECK_THAT(real, !Catch::Contains("hide faults") && !Catch::Contains("identical planets"));

    CHECK_THAT(assumptions(shipped_study("planet-crack-ideal.toml", {"gearbox.pitch_error_um=2"})),
               Catch::Contains("teeth with individual errors"));
    CHECK_THAT(assumptions(shipped_study("planet-crack.toml")),
               Catch::Contains("grade 6 (chosen),") && Catch::Contains("1 % (rms) (chosen), that"));
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

TEST_CASE("A target of false alarms in time is a rate of one record") {
    const auto rate = [](const std::vector<std::string>& overrides) {
        return study_of_text(kExampleStudy, overrides).detection.false_alarm_rate;
    };
    // One a year and machine, a record a day: one in 365 records; of a fleet of ten: a tenth.
    const std::string daily = "detection.record_interval_h=24",
                      year = "detection.false_alarms_per_1000_h=" + std::to_string(1.0 / 8.76);
    CHECK(rate({year, daily}) == Approx(1.0 / 365.0).epsilon(1e-5));
    CHECK(rate({year, daily, "detection.machines=10"}) == Approx(0.1 / 365.0).epsilon(1e-5));
    CHECK(rate({"detection.false_alarms_per_1000_h=2", "detection.record_interval_h=5"}) ==
          Approx(0.01));
    const Study study = study_of_text(kExampleStudy, {year, daily, "detection.machines=10"});
    CHECK(study_of_text(resolved_text(study)) == study);
    CHECK_FALSE(contains(resolved_text(study_of_text(kExampleStudy)), "machines"));
    CHECK(false_alarm_target_text(study_of_text(kExampleStudy)) == "");
    CHECK(false_alarm_target_text(study_of_text(kExampleStudy, {year, daily})) ==
          "0.114 false alarms in 1000 h of a machine, with a record of each every 24 h, are a rate "
          "of 0.00274 in a record for each feature.");
    // A target of --set replaces the rate of the file.
    const auto given = std::string(kExampleStudy) + "\n[detection]\nfalse_alarm_rate = 0.05\n";
    CHECK(study_of_text(given, {year, daily}).detection.false_alarm_rate ==
          Approx(1.0 / 365.0).epsilon(1e-5));
    const auto problem = [](const std::vector<std::string>& overrides) {
        const Problems problems = read_study_text(kExampleStudy, "study.toml", overrides).problems;
        return problems.size() == 1 ? problems[0].key : std::to_string(problems.size());
    };
    CHECK(problem({year}) == "detection.record_interval_h");
    CHECK(problem({"detection.chosen_values=['fault.depth_mm']"}) == "detection.chosen_values");
    CHECK(problem({"detection.machines=3"}) == "detection.machines");
    CHECK(problem({year, daily, "detection.false_alarm_rate=0.1"}) == "detection.false_alarm_rate");
    CHECK(problem({"detection.false_alarms_per_1000_h=100", daily}) ==
          "detection.false_alarms_per_1000_h");
}

}  // namespace gearpod::mc::test_assumptions
