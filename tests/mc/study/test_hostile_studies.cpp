// Checks hostile studies: nesting, size, extreme numbers.
#include "mc/files/input/document.hpp"
#include "mc/study/study.hpp"
#include "tests/mc/study_example.hpp"
#include "tests/test.hpp"

namespace gearpod::test_hostile_studies {

using mc::format;
using mc::read_study_text;
using tests::kExampleStudy;

std::string repeated(int count, const std::string& part) {
    std::string all;
    for (int i = 0; i < count; ++i) {
        all += part;
    }
    return all;
}

TEST_CASE("A study nested too deeply is refused before a parser recurses into it") {
    constexpr int kDeep = 60000;
    const std::string dotted = "a" + repeated(kDeep, ".a");
    const std::string quoted = "\"a\"" + repeated(kDeep, " . 'a'");
    const std::string texts[] = {
        "[" + dotted + "]\n",
        "[[" + dotted + "]]\nx = 1\n",
        dotted + " = 1\n",
        quoted + " = 1\n",
        "gearbox.sun." + dotted + " = 1\n",
        "x = { " + dotted + " = 1 }\n",
        "x = " + repeated(kDeep, "[") + repeated(kDeep, "]") + "\n",
        "x = " + repeated(kDeep, "{ a = ") + "1" + repeated(kDeep, " }") + "\n",
        repeated(kDeep, "["),
    };
    for (const std::string& text : texts) {
        INFO(text.substr(0, 30));
        const auto reading = read_study_text("# one\n" + text, "deep.toml");
        REQUIRE(reading.problems.size() == 1);
        CHECK(reading.problems[0].line == 2);
        CHECK(reading.problems[0].what == "nested deeper than 32 levels");
    }
    for (const std::string& set :
         {dotted + "=1", "fault.side={" + dotted + "=1}", "fault.side=" + repeated(kDeep, "[")}) {
        INFO(set.substr(0, 30));
        const auto reading = read_study_text(kExampleStudy, "study.toml", {set});
        REQUIRE(reading.problems.size() == 1);
        CHECK(reading.problems[0].file == "--set");
    }
}

TEST_CASE(
    "Text that only resembles nesting is accepted: strings, comments, lists of numbers, many "
    "lines") {
    using gearpod::mc::line_nested_too_deep;
    CHECK(line_nested_too_deep("# " + repeated(100, ".a") + "\n") == 0);
    CHECK(line_nested_too_deep("x = \"" + repeated(100, "\\\".a[{") + "\"\ny = 1") == 0);
    CHECK(line_nested_too_deep("x = '" + repeated(100, ".a[{") + "'\n") == 0);
    CHECK(line_nested_too_deep("x = \"\"\"\n" + repeated(100, "\".a[\n") + "\"\"\"\n") == 0);
    CHECK(line_nested_too_deep("x = [" + repeated(100, "0.1, [1.5], ") + "]\n") == 0);
    CHECK(line_nested_too_deep(repeated(100, "[a]\nb.c = 1.25\n")) == 0);
    CHECK(line_nested_too_deep("a" + repeated(31, ".b") + " = 1\n") == 0);
    CHECK(line_nested_too_deep("\n\na" + repeated(32, ".b") + " = 1\n") == 3);
}

TEST_CASE("Numbers whose products would overflow are refused in every key") {
    for (const char* set :
         {"operation.torque_N_m=1e300", "sensor.noise_m_s2=1e300", "sensor.noise_levels=[0,1e300]",
          "gearbox.planet.mass_kg=1e-300", "detection.confidence=1e-300",
          "detection.false_alarm_rate=1e-300", "detection.confidence=0.9999999999999999",
          "random.operation.torque_N_m={distribution='uniform',low=1,high=1e200}",
          "random.operation.torque_N_m={distribution='lognormal',median=1e300,cv=1}"}) {
        const auto reading = read_study_text(kExampleStudy, "study.toml", {set});
        INFO(set << "\n" << format(reading.problems));
        CHECK_FALSE(reading.study);
        CHECK(reading.problems.size() == 1);
    }
}

TEST_CASE("A long file that makes toml++ fail is refused immediately, with its line") {
    const auto reading = read_study_text(repeated(20000, "# comment\n") + "[[[\n", "long.toml");
    REQUIRE(reading.problems.size() == 1);
    CHECK(reading.problems[0].line == 20001);
}

}  // namespace gearpod::test_hostile_studies
