// Checks gearpod check: several study files, problems of each, the exit code.
#include "mc/library/run/run_options.hpp"
#include "tests/mc/lives/life_example.hpp"
#include "tests/mc/program.hpp"

namespace gearpod::test_check {

using namespace test;

TEST_CASE("check reports the problems of every study and simulates none") {
    const Folder folder;
    const std::string wrong = folder.file("wrong.toml"), unmeshed = folder.file("unmeshed.toml");
    std::ofstream(wrong) << "[gearbox]\nsun.teeth = -3\nplanets = \"four\"\n";
    std::ofstream(unmeshed) << "[gearbox]\nsun.teeth = 19\nplanet.teeth = 31\nring.teeth = 80\n";
    const std::string sound = study("planet-crack.toml");
    const Outcome all = program("check " + wrong + " " + sound + " " + unmeshed);
    INFO(all.output);
    CHECK(all.code == mc::kBadInput);
    check_mentions(all, {wrong + ":2: gearbox.sun.teeth", wrong + ":3: gearbox.planets",
                         sound + ": can be simulated", unmeshed + ":"});
    CHECK_FALSE(all.mentions(wrong + ": can be simulated"));
    CHECK_FALSE(all.mentions(unmeshed + ": can be simulated"));
    CHECK(folder.files() == 2);
}

TEST_CASE("check of sound studies ends with code 0, unless a changed key is wrong") {
    const std::string files = study("planet-crack.toml") + " " + study("bell-206b.toml");
    CHECK(program("check " + files).code == mc::kDone);
    const Outcome changed = program("check " + files + " --set sensor.noise_m_s2=-1");
    INFO(changed.output);
    CHECK(changed.code == mc::kBadInput);
    CHECK(changed.mentions("sensor.noise_m_s2"));
}

TEST_CASE("check and describe take a study with [life] as one for lives") {
    const std::string life = study("planet-crack-ideal.toml") + life_arguments();
    const std::string refused =
        " --set life.record_s=10 --set 'features.use=[\"te_kurtosis\"]'"
        " --set 'sensor.noise_levels=[1,2]'";
    CHECK(require_success("check " + life).mentions("can be simulated by `lives`"));
    const Outcome all = program("check " + life + refused);
    INFO(all.output);
    CHECK(all.code == mc::kBadInput);
    CHECK(all.mentions("\"te_kurtosis\" averages the transmission error"));
    CHECK(all.mentions("a life has one noise level"));
    check_mentions(require_success("describe " + life + " --seconds 0.1"),
                   {"forecast of lives", "records of a crack"});
    CHECK(program("describe " + life + refused).mentions("refused by `lives`"));
}

}  // namespace gearpod::test_check
