// Checks targets of false alarms in time, and their conversion to the rate of a record.
#include "mc/study/assumptions.hpp"
#include "mc/study/schema/schema.hpp"
#include "mc/study/study.hpp"
#include "tests/mc/study_example.hpp"
#include "tests/test.hpp"

namespace gearpod::mc::test_false_alarm_target {

using tests::kExampleStudy;

Study study_of(const std::string& text, const std::vector<std::string>& overrides = {}) {
    StudyReading reading = read_study_text(text, "study.toml", overrides);
    INFO(format(reading.problems));
    REQUIRE(reading.study);
    return *reading.study;
}

TEST_CASE("A target of false alarms in time is a rate of one record") {
    const auto rate = [](const std::vector<std::string>& overrides) {
        return study_of(kExampleStudy, overrides).detection.false_alarm_rate;
    };
    // One a year and machine, a record a day: one in 365 records; of a fleet of ten: a tenth.
    const std::string daily = "detection.record_interval_h=24",
                      year = "detection.false_alarms_per_1000_h=" + std::to_string(1.0 / 8.76);
    CHECK(rate({year, daily}) == Approx(1.0 / 365.0).epsilon(1e-5));
    CHECK(rate({year, daily, "detection.machines=10"}) == Approx(0.1 / 365.0).epsilon(1e-5));
    CHECK(rate({"detection.false_alarms_per_1000_h=2", "detection.record_interval_h=5"}) ==
          Approx(0.01));
    const Study study = study_of(kExampleStudy, {year, daily, "detection.machines=10"});
    CHECK(study_of(resolved_text(study)) == study);
    CHECK(resolved_text(study_of(kExampleStudy)).find("machines") == std::string::npos);
    CHECK(false_alarm_target_text(study_of(kExampleStudy)) == "");
    CHECK(false_alarm_target_text(study_of(kExampleStudy, {year, daily})) ==
          "0.114 false alarms in 1000 h of a machine, with a record of each every 24 h, are a rate "
          "of "
          "0.00274 in a record for each feature.");
    // A target of --set replaces the rate of the file.
    std::string given = kExampleStudy;
    given += "\n[detection]\nfalse_alarm_rate = 0.05\n";
    CHECK(study_of(given, {year, daily}).detection.false_alarm_rate ==
          Approx(1.0 / 365.0).epsilon(1e-5));
    const auto problem = [](const std::vector<std::string>& overrides) {
        const Problems problems = read_study_text(kExampleStudy, "study.toml", overrides).problems;
        return problems.size() == 1 ? problems[0].key : std::to_string(problems.size());
    };
    CHECK(problem({year}) == "detection.record_interval_h");
    CHECK(problem({"detection.machines=3"}) == "detection.machines");
    CHECK(problem({year, daily, "detection.false_alarm_rate=0.1"}) == "detection.false_alarm_rate");
    CHECK(problem({"detection.false_alarms_per_1000_h=100", daily}) ==
          "detection.false_alarms_per_1000_h");
}

}  // namespace gearpod::mc::test_false_alarm_target
