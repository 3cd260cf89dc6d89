// Checks gearpod new train: studies of the stages of a drive train, and the level of the monitored
// one.
#include "mc/study/new/datasheet.hpp"
#include "mc/study/study.hpp"
#include "signals/noise/coloured_noise.hpp"
#include "tests/mc/program.hpp"
#include "tests/test.hpp"

namespace gearpod::mc::test_new_train {

using namespace gearpod::test;

// First stage and parallel stages of a wind turbine of 2.5 MW.
const std::vector<std::string> kTurbine{"21/39/99 module=14 helix=8", "97/23 module=11 helix=12",
                                        "103/21 module=8 helix=14"};

mc::TrainDatasheet train(const std::vector<std::string>& stages) {
    mc::TrainDatasheet train;
    mc::Problems problems;
    for (const std::string& stage : stages) {
        train.stages.push_back(mc::read_train_stage(stage, train.stages.size() + 1, problems));
    }
    INFO(format(problems));
    REQUIRE(problems.empty());
    train.load.power_kW = 2500;
    train.load.speed_rpm = 14;
    train.file = "folder/turbine.toml";
    return train;
}

mc::NewTrain made(const mc::TrainDatasheet& train, std::vector<double> levels = {}) {
    auto next = levels.begin();
    const mc::NewTrain made =
        new_train(train, "new train", [&](const std::string&, const std::string&) {
            return next != levels.end() ? *next++ : 0.0;
        });
    INFO(format(made.problems));
    REQUIRE(made.problems.empty());
    return made;
}

// The study of the monitored stage with the texts of the others in place of their files.
mc::Study monitored(const mc::NewTrain& train, std::size_t stage) {
    std::string text = train.studies.at(stage).second;
    for (const auto& [path, other] : train.studies) {
        const std::string file = "study = \"" + path.substr(path.find('/') + 1) + "\"";
        if (const std::size_t at = text.find(file); at != std::string::npos) {
            text.replace(at, file.size(), "text = " + mc::quoted_text(other));
        }
    }
    const mc::StudyReading reading = mc::read_study_text(text, "s.toml");
    INFO(format(reading.problems));
    REQUIRE(reading.study);
    return *reading.study;
}

TEST_CASE("Stages of a train turn and are loaded as their teeth require") {
    const mc::NewTrain turbine = made(train(kTurbine));
    REQUIRE(turbine.studies.size() == 3);
    CHECK(turbine.studies[0].first == "folder/turbine.toml");
    CHECK(turbine.studies[2].first == "folder/turbine-stage-3.toml");
    const mc::Study first = monitored(turbine, 0);
    // Willis with the ring fixed: 14 rpm (1 + 99 / 21) at the sun, times 97 / 23 at the pinion.
    const double sun_rad_s = 80.0 * M_PI / 30.0, torque_N_m = 2500e3 / sun_rad_s;
    REQUIRE(first.sensor.stages.size() == 2);
    const mc::NeighbourStage &second = first.sensor.stages[0], &third = first.sensor.stages[1];
    CHECK(*second.study->operation.pinion_speed_rad_s == Approx(sun_rad_s).epsilon(1e-3));
    CHECK(second.study->operation.torque_N_m == Approx(torque_N_m).epsilon(1e-3));
    CHECK(*third.study->operation.pinion_speed_rad_s == Approx(sun_rad_s * 97 / 23).epsilon(1e-3));
    CHECK(third.study->operation.torque_N_m == Approx(torque_N_m * 23 / 97).epsilon(1e-3));
    CHECK(second.shaft == mc::Member::sun);
    CHECK(second.stage_shaft == mc::Member::pinion);
    CHECK(third.of == "stage-2");
    CHECK(third.shaft == mc::Member::gear);
    // A pair that speeds up cracks at its smaller gear, which it drives.
    CHECK(second.study->fault.member == mc::Member::gear);
    // Without a level, the density of the noise is chosen and marked.
    CHECK(contains(turbine.studies[0].second, "\"sensor.noise_density_m_s2_per_sqrt_Hz\"]"));
    CHECK(first.title == "Planetary gearbox 21/39/99, stage 1 of 3: crack of a tooth");
}

TEST_CASE("The monitored stage of a train may be any, with the stages before and after it") {
    mc::TrainDatasheet turbine = train(kTurbine);
    turbine.monitored = 1;
    const mc::Study second = monitored(made(turbine), 1);
    REQUIRE(second.sensor.stages.size() == 2);
    const mc::NeighbourStage &third = second.sensor.stages[0], &first = second.sensor.stages[1];
    CHECK(third.shaft == mc::Member::gear);
    CHECK(third.stage_shaft == mc::Member::pinion);
    CHECK(first.shaft == mc::Member::pinion);
    CHECK(first.stage_shaft == mc::Member::sun);
    CHECK(first.of.empty());
    // 20 times the mesh frequency of 97 teeth at 80 rpm.
    CHECK(second.sensor.low_pass_Hz == Approx(20 * 97 * 80 / 60.0).epsilon(1e-3));
}

TEST_CASE("A measured level is the sum of the stages and the background") {
    mc::TrainDatasheet turbine = train(kTurbine);
    turbine.low_pass_Hz = 2000;
    const double bandwidth_Hz = signals::low_pass_noise_bandwidth_Hz(2000);
    for (const double level : {2.5, 0.5}) {
        turbine.level_m_s2 = level;
        const mc::NewTrain with_level = made(turbine, {0.3, 0.4, 0.3});
        const mc::Study study = monitored(with_level, 0);
        const double gain = study.sensor.stages[0].gain,
                     noise = *study.sensor.noise_density_m_s2_per_sqrt_Hz * std::sqrt(bandwidth_Hz);
        CHECK(gain <= 1.0);
        CHECK(std::sqrt(0.09 + gain * gain * 0.25 + noise * noise) == Approx(level).epsilon(1e-3));
        // Where the other stages alone are louder, the background is chosen, and marked.
        const std::string& text = with_level.studies[0].second;
        CHECK(contains(text, "the rest of the measured level") == (gain == 1.0));
        CHECK(contains(text, "\"sensor.noise_density") == (gain < 1.0));
        CHECK(study.sensor.noise_levels.back() == (gain == 1.0 ? 1.0 : 4.0));
    }
    turbine.level_m_s2 = 0.2;
    const mc::NewTrain quiet =
        new_train(turbine, "c", [](const std::string&, const std::string&) { return 0.3; });
    CHECK(quiet.studies.empty());
    CHECK(contains(format(quiet.problems), "less than the monitored stage alone has"));
}

TEST_CASE("Bad stages of a train are refused with every reason") {
    mc::Problems problems;
    for (const char* stage : {"21/39", "21 module=2", "21/x module=2", "0/3 module=2",
                              "21/39/99 module=2 planets=9 face=3 helix=x",
                              "9/8 module=2 input=sun", "8/7 module=2 quality"}) {
        read_train_stage(stage, 1, problems);
    }
    CHECK(problems.size() == 9);
    mc::TrainDatasheet turbine = train({"21/39/99 module=12", "95/3 module=11"});
    turbine.low_pass_Hz = 5;
    const std::string refused =
        format(new_train(turbine, "c", [](const std::string&, const std::string&) {
                   return 0.0;
               }).problems);
    INFO(refused);
    CHECK(contains(refused, "--band: 5 Hz is below the monitored stage's mesh frequency, 23.1 Hz"));
    CHECK(contains(refused, "--stage 2"));
    turbine.load.power_kW.reset();
    CHECK(contains(format(new_train(turbine, "c", {}).problems), "1 of the three are given"));
}

TEST_CASE("new train writes the study of each stage, and none over an existing file") {
    const Folder folder;
    const std::string file = folder.file("t.toml");
    const std::string command =
        "new train --stage '20/28/76 module=2' --stage '60/20 module=2' "
        "--power 20 --speed 60 --level 40 --band 1500 --out " +
        file;
    require_success(command);
    const std::string text = bytes_of(file);
    CHECK(contains(text, "--stage \"20/28/76 module=2\" --stage \"60/20 module=2\" --power 20"));
    CHECK(contains(text, "Measured level: 40 m/s^2 rms below 1500 Hz"));
    require_success("check " + file);
    check_refused(program(command), {"t-stage-2.toml: --out: exists already"});
    check_refused(program("new train --stage '20/28/76 module=2' --sun 3 --out -"));
}

}  // namespace gearpod::mc::test_new_train
