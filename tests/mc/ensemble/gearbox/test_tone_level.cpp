// Checks the level of other machine noise: one factor on the amplitudes of all tones.
#include <fmt/format.h>

#include "mc/numerics/numerics_choice.hpp"
#include "mc/plan/calibration_plan.hpp"
#include "mc/recordings/calibration/simulated_sets.hpp"
#include "tests/mc/program.hpp"
#include "tests/numbers.hpp"

namespace gearpod::test_tone_level {

using namespace test;

const std::string kStudy = std::string(GEARPOD_SOURCE_DIR) + "/tests/features/reference/small.toml";

std::string tones(double amplitude) {
    return fmt::format(
        "sensor.tones=[{{frequency_Hz=50, amplitude_m_s2={0}}}, "
        "{{frequency_Hz=111, amplitude_m_s2={1}}}]",
        amplitude, 0.5 * amplitude);
}

mc::StudyScene scene_with(const std::vector<std::string>& overrides) {
    mc::StudyScene made = mc::make_scene(kStudy, mc::read_study(kStudy, overrides));
    INFO(format(made.problems));
    REQUIRE(made);
    return made;
}

TEST_CASE("Twice the level doubles the amplitude of every tone") {
    const Folder folder;
    const auto simulate = [&](const std::string& options, const std::string& name) {
        require_success("simulate " + kStudy + " --instance 2 " + options + " --out " +
                        folder.file(name));
        return bytes_of(folder.file(name));
    };
    const std::string quiet = simulate("--set '" + tones(2.0) + "'", "quiet.csv");
    const std::string loud = simulate("--set '" + tones(4.0) + "'", "loud.csv");
    CHECK(simulate("--set '" + tones(2.0) + "' --set sensor.tone_level=2", "level.csv") == loud);
    CHECK(quiet != loud);
}

TEST_CASE("A level requires tones") {
    check_refused("describe " + kStudy + " --set sensor.tone_level=2",
                  {"sensor.tone_level", "only with sensor.tones"});
}

// Each background that shares an integration has its own level.
TEST_CASE("Calibration uses the given level") {
    const std::vector<std::string> random{
        tones(2.0), "random.sensor.tone_level={distribution='uniform',low=0.1,high=10}"};
    const mc::StudyScene quiet = scene_with(random);
    const mc::StudyScene loud = scene_with({tones(6.0)});
    const std::vector<const features::Feature*> used{features::find_feature("sensor_rms"),
                                                     features::find_feature("window_ratio")};
    const mc::RecordLengths lengths(2, {quiet.scene->record().span.meshes()});
    const auto values = [&](const mc::StudyScene& study,
                            const std::vector<mc::CalibratedInput>& inputs,
                            const mc::PriorRegion& region) {
        return simulate_sets(study.scene->tile(), inputs, region, {1, 1, 7}, lengths, used, 1,
                             [](double) {})[0]
            .values;
    };
    const auto by_level = values(quiet, {{"sensor.tone_level", 0.0, 6.0}}, {{0.5}, {0.5}});
    const auto by_amplitude = values(loud, {}, {});
    REQUIRE(by_level.size() == 2 * used.size());
    REQUIRE(by_level.size() == by_amplitude.size());
    test::check_close(by_level, by_amplitude, 1e-12);
    const std::vector<mc::CalibratedInput> usual =
        make_calibration_plan(*mc::read_study(kStudy, random).study, "").default_inputs(2.0);
    const auto level =
        std::ranges::find(usual, std::string("sensor.tone_level"), &mc::CalibratedInput::key);
    REQUIRE(level != usual.end());
    CHECK(level->independent_of_motion());
}

}  // namespace gearpod::test_tone_level
