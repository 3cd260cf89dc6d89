// Checks the study that `describe` prints: short lines with the same meaning.
#include "mc/report/description/terminal_text.hpp"
#include "mc/study/study.hpp"
#include "tests/mc/study_example.hpp"
#include "tests/mc/study_file.hpp"

namespace gearpod::mc::test_wrapped_study {

using namespace tests;

TEST_CASE("A wrapped study has short lines and the same meaning") {
    const Study reading = gearpod::test::valid_study(read_study_text(
        kExampleStudy, "study.toml",
        {"random.operation.torque_N_m = {distribution='truncated-normal', mean=400, sd=20, "
         "low=369.123456789, high=489.123456789}",
         "features.use=['te_rms', 'te_kurtosis', 'te_fc', 'te_fm0', 'sensor_rms', 'window_ratio', "
         "'window_z']"}));
    const std::string text = resolved_text(reading), wrapped = wrapped_study(text);
    INFO(wrapped);
    CHECK(wrapped.find("operation.torque_N_m.sd = 20\n") != std::string::npos);
    std::istringstream lines(wrapped);
    for (std::string line; std::getline(lines, line);) {
        CHECK((line.size() <= 80 || line.starts_with("title = ")));
    }
    const Study again = gearpod::test::valid_study(read_study_text(wrapped, "study.toml", {}));
    CHECK(again == reading);
}

TEST_CASE("Short lines and long strings of a study stay as they are") {
    const std::string text = "title = \"" + std::string(90, '{') + "\"\n\n[a]\nb = [1, 2]\n";
    CHECK(wrapped_study(text) == text);
    CHECK(wrapped_study("k = [\"" + std::string(40, ',') + "\", \"\\\\\", \"" +
                        std::string(40, ']') + "\"]\n") == "k = [\n    \"" + std::string(40, ',') +
                                                               "\", \"\\\\\",\n    \"" +
                                                               std::string(40, ']') + "\",\n]\n");
}

}  // namespace gearpod::mc::test_wrapped_study
