// Kills runs of one to three ranks two hundred times at random moments, while another process
// attempts to write the same output. An hour's test: ctest -C long -R kills.
#include <csignal>
#include <thread>

#include "tests/mc/program.hpp"

namespace gearpod::test_kills {

using namespace test;

// Starts a separate process group, so that a launcher's ranks end with it.
pid_t start(const std::string& command) {
    const pid_t child = fork();
    if (child == 0) {
        setpgid(0, 0);
        execl("/bin/sh", "sh", "-c", (command + " > /dev/null 2>&1").c_str(), nullptr);
        std::_Exit(127);
    }
    setpgid(child, child);
    return child;
}

TEST_CASE("Killed two hundred times with a concurrent rival, a run loses nothing", "[.kills]") {
    const Folder folder;
    const std::string out = folder.file("r.h5");
    const auto command = [&](const std::string& file) {
        return std::string(GEARPOD_PROGRAM) + " run " + study("crack-in-sun.toml") +
               " --instances 300 --set ensemble.threshold_instances=100 --set "
               "ensemble.checkpoint_s=0 --quiet --resume --out " +
               file;
    };
    REQUIRE(shell(command(folder.file("whole.h5"))).code == 0);
    const auto reference = bits(folder.file("whole.h5"));
    std::mt19937 engine(200);
    std::uniform_real_distribution<double> moment(0.05, 2.0);
    int killed = 0, whole = 0;
    while (killed < 200) {
        const int ranks = 1 + killed % 3;
        const pid_t child = start((ranks == 1 ? "" : "env " + mpirun(ranks)) + command(out));
        std::this_thread::sleep_for(std::chrono::duration<double>(0.5 * moment(engine)));
        const Outcome rival =
            shell("timeout -s KILL " + std::to_string(moment(engine)) + " " + command(out));
        CHECK((rival.code == 0 || rival.code == 2 || rival.code == 137));
        if (rival.code == 2) {
            INFO(rival.output);
            CHECK(rival.mentions("is using it"));
        }
        kill(-child, SIGKILL);
        int status = 0;
        REQUIRE(waitpid(child, &status, 0) == child);
        killed += WIFSIGNALED(status) || rival.code == 137 ? 1 : 0;
        if (std::filesystem::exists(out) && !std::filesystem::exists(out + ".part")) {
            CHECK(bits(out) == reference);
            std::filesystem::remove(out);
            ++whole;
        }
    }
    Outcome last = shell(command(out));
    for (int i = 0; i < 50 && last.mentions("is using it"); ++i) {
        std::this_thread::sleep_for(std::chrono::milliseconds(200));  // ranks may outlive mpirun
        last = shell(command(out));
    }
    INFO(last.output << whole << " times whole in between");
    CHECK(last.code == 0);
    CHECK(bits(out) == reference);
}

}  // namespace gearpod::test_kills
