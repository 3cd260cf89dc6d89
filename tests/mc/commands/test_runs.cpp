// Checks runs that are split, killed, stopped, resumed and extended: always the same gearboxes, bit
// by bit.
#include <chrono>
#include <csignal>
#include <set>
#include <thread>

#include "tests/mc/compared_program.hpp"
#include "tests/mc/lives/life_example.hpp"
#include "tests/mc/program.hpp"

namespace gearpod::test_runs {

using namespace test;
namespace fs = std::filesystem;
using namespace std::chrono_literals;

// Command for three batches of the threshold group and four test gearboxes; the last batch of each
// group is not full. Snapshots are written continuously.
std::string run_of(const std::string& out, int instances = 50, int healthy = 35,
                   const std::string& name = "planet-crack-ideal.toml") {
    return "run " + study(name) + " --instances " + std::to_string(instances) +
           " --set ensemble.threshold_instances=" + std::to_string(healthy) +
           " --set ensemble.checkpoint_s=0 --out " + out;
}

// Bits of one uninterrupted run, computed once.
const std::vector<std::uint64_t>& reference() {
    static const std::vector<std::uint64_t> all = [] {
        const Folder folder;
        require_success(run_of(folder.file("r.h5")) + " --quiet");
        return bits(folder.file("r.h5"));
    }();
    return all;
}

// Starts the program in a process group of its own, so that the ranks of a launcher end with it.
pid_t start(const std::string& arguments, const std::string& launcher = "") {
    const pid_t child = fork();
    if (child == 0) {
        setpgid(0, 0);
        const std::string command =
            "exec " + launcher + GEARPOD_PROGRAM + " " + arguments + " > /dev/null 2>&1";
        execl("/bin/sh", "sh", "-c", command.c_str(), nullptr);
        std::_Exit(127);
    }
    setpgid(child, child);
    return child;
}

int status_of(pid_t child) {
    int status = 0;
    REQUIRE(waitpid(child, &status, 0) == child);
    return status;
}

std::uintmax_t size_of(const std::string& path) {
    std::error_code none;
    const std::uintmax_t size = fs::file_size(path, none);
    return none ? 0 : size;
}

// Waits until the checkpoint has grown by at least one batch.
void await_batches(const std::string& part, std::uintmax_t before) {
    for (int i = 0; i < 4000 && size_of(part) < before + 8192; ++i) {
        std::this_thread::sleep_for(5ms);
    }
}

TEST_CASE("One to four ranks, one or two threads, one lane, four or eight: the same bits",
          "[mpi]") {
    const auto [folder, out] = TemporaryFile("r.h5");
    for (const int ranks : {1, 2, 3, 4}) {
        const std::string threads = " --set numerics.threads=" + std::to_string(1 + ranks % 2);
        const Outcome run =
            require_success(shell(mpirun(ranks) + GEARPOD_PROGRAM + " " + run_of(out) + threads));
        CHECK(run.mentions(" in " + std::to_string(ranks) + " ranks") == (ranks > 1));
        CHECK(bits(out) == reference());
        fs::remove(out);
    }
    for (const char* change :
         {" --set numerics.lanes=1", " --set numerics.lanes=4", " --set numerics.threads=2"}) {
        INFO(change);
        require_success(compared_program(run_of(out) + change));
        CHECK(bits(out) == reference());
        fs::remove(out);
    }
    CHECK(folder.empty());
}

TEST_CASE("Killed twenty times at random moments and resumed, a run loses nothing") {
    const Folder folder;
    const std::string out = folder.file("r.h5"), part = out + ".part";
    const auto before = std::chrono::steady_clock::now();
    require_success(run_of(folder.file("whole.h5")) + " --quiet");
    const std::chrono::duration<double> whole = std::chrono::steady_clock::now() - before;
    std::mt19937 engine(20);
    std::uniform_real_distribution<double> moment(0.0, 0.6 * whole.count());
    int killed = 0;
    for (int i = 0; i < 20; ++i) {
        const pid_t child = start(
            run_of(out) + " --resume --quiet --set numerics.threads=" + std::to_string(1 + i % 2));
        std::this_thread::sleep_for(std::chrono::duration<double>(moment(engine)));
        kill(child, SIGKILL);
        const int status = status_of(child);
        killed += WIFSIGNALED(status) ? 1 : 0;
        REQUIRE((WIFSIGNALED(status) || WEXITSTATUS(status) == 0));
        if (fs::exists(out)) {
            // Snapshots during the run are complete.
            CHECK_NOTHROW(mc::read_results(out));
        }
        if (!WIFSIGNALED(status)) {
            fs::remove(out);  // finished before it could be killed: start again
        }
    }
    CHECK(killed > 5);
    require_success(shell(mpirun(2) + GEARPOD_PROGRAM + " " + run_of(out) + " --resume --quiet"));
    CHECK(bits(out) == reference());
    CHECK_FALSE(fs::exists(part));
    CHECK(folder.files() == 2);
}

// One to three ranks, while another process attempts to write the same output: an hour's test,
// ctest -C long -R kills.
TEST_CASE("Killed two hundred times with a concurrent rival, a run loses nothing", "[.kills]") {
    const Folder folder;
    const std::string out = folder.file("r.h5");
    const auto command = [&](const std::string& file) {
        return " " + run_of(file, 300, 100, "crack-in-sun.toml") + " --quiet --resume";
    };
    require_success(command(folder.file("whole.h5")));
    const auto reference = bits(folder.file("whole.h5"));
    std::mt19937 engine(200);
    std::uniform_real_distribution<double> moment(0.05, 2.0);
    int killed = 0, whole = 0;
    while (killed < 200) {
        const int ranks = 1 + killed % 3;
        const pid_t child = start(command(out), ranks == 1 ? "" : "env " + mpirun(ranks));
        std::this_thread::sleep_for(std::chrono::duration<double>(0.5 * moment(engine)));
        const Outcome rival = shell("timeout -s KILL " + std::to_string(moment(engine)) + " " +
                                    GEARPOD_PROGRAM + command(out));
        CHECK((rival.code == 0 || rival.code == 2 || rival.code == 137));
        if (rival.code == 2) {
            INFO(rival.output);
            CHECK(rival.mentions("is using it"));
        }
        kill(-child, SIGKILL);
        const int status = status_of(child);
        killed += WIFSIGNALED(status) || rival.code == 137 ? 1 : 0;
        if (std::filesystem::exists(out) && !std::filesystem::exists(out + ".part")) {
            CHECK(bits(out) == reference);
            std::filesystem::remove(out);
            ++whole;
        }
    }
    Outcome last = program(command(out));
    for (int i = 0; i < 50 && last.mentions("is using it"); ++i) {
        std::this_thread::sleep_for(std::chrono::milliseconds(200));  // ranks may outlive mpirun
        last = program(command(out));
    }
    INFO(last.output << whole << " times whole in between");
    CHECK(last.code == 0);
    CHECK(bits(out) == reference);
}

// Bits of a results file, or all files of a folder with their names.
std::string content(const fs::path& path) {
    if (path.extension() == ".h5") {
        const auto all = bits(path.string());
        return {reinterpret_cast<const char*>(all.data()), all.size() * sizeof(all.front())};
    }
    if (!fs::is_directory(path)) {
        return bytes_of(path.string());
    }
    std::string all;
    for (const fs::path& name : std::set<fs::path>(fs::directory_iterator(path), {})) {
        all += name.string() + content(name);
    }
    return all;
}

// Half an hour's test, ctest -C long -R kills.
TEST_CASE("Killed two hundred times, commands that write results lose none and repeat their bits",
          "[.kills]") {
    const Folder folder;
    const std::string ideal = study("planet-crack-ideal.toml"), out = folder.file("out");
    const auto half = [&](int number) {
        const std::string file = folder.file(std::to_string(number) + ".h5");
        require_success(run_of(file) + " --quiet --part " + std::to_string(number) + "/2");
        return file;
    };
    const std::string parts = half(1) + " " + half(2), recording = folder.file("x.csv");
    require_success("simulate " + ideal + " --instance 0 --meshes 400 --out " + recording);
    require_success(run_of(folder.file("whole.h5")) + " --quiet");
    const std::vector<std::pair<std::string, std::string>> commands{
        {out + ".h5", run_of(out + ".h5") + " --resume --quiet"},
        {out + ".h5",
         "lives " + ideal + life_arguments() + " --resume --quiet --out " + out + ".h5"},
        {out + ".h5", "merge " + parts + " --force --out " + out + ".h5"},
        {out, "sweep " + ideal +
                  " --instances 8 --set ensemble.threshold_instances=20 --vary "
                  "sensor.gain=[1,2] --quiet --out " +
                  out},
        {out + ".h5",
         "features " + recording + " --study " + ideal + " --quiet --force --out " + out + ".h5"}};
    std::mt19937 engine(34);
    for (const auto& [result, command] : commands) {
        INFO(command);
        const auto before = std::chrono::steady_clock::now();
        require_success(command);
        const std::chrono::duration<double> whole = std::chrono::steady_clock::now() - before;
        const auto reference = content(result);
        const long files = folder.files();
        fs::remove_all(result);
        std::uniform_real_distribution<double> moment(0.0, whole.count());
        for (int killed = 0; killed < 34;) {
            const pid_t child = start(command);
            std::this_thread::sleep_for(std::chrono::duration<double>(moment(engine)));
            kill(-child, SIGKILL);
            if (WIFSIGNALED(status_of(child))) {
                ++killed;
            } else {
                CHECK(content(result) == reference);
                fs::remove_all(result);
            }
        }
        require_success(command);
        CHECK(content(result) == reference);
        CHECK(folder.files() == files);
        fs::remove_all(result);
    }
}

TEST_CASE("Signals and the time limit end a run cleanly, save its state and exit with 4") {
    const auto [folder, out] = TemporaryFile("r.h5");
    for (const int number : {SIGINT, SIGTERM, SIGUSR1, SIGXCPU}) {
        const std::uintmax_t before = size_of(out + ".part");
        const pid_t child = start(run_of(out, 5000) + " --resume --quiet");
        await_batches(out + ".part", before);
        kill(child, number);
        const int status = status_of(child);
        INFO("signal " << number);
        REQUIRE(WIFEXITED(status));
        CHECK(WEXITSTATUS(status) == 4);
        CHECK(fs::exists(out + ".part"));
        CHECK(mc::read_results(out).provenance_value("state").starts_with("interrupted by SIG"));
        check_mentions(require_success("report " + out), {"of 5035 gearboxes (interrupted by SIG"});
    }
    const Outcome limited =
        program(run_of(out, 5000) + " --resume --progress json --time-limit 00:00:02");
    CHECK(limited.code == 4);
    CHECK_FALSE(limited.mentions("\"finished\":true"));
    check_mentions(limited,
                   {"\"finished\":false", "stopped by the time limit", "continue with --resume"});
    CHECK(program(run_of(out, 5000)).mentions("--resume"));
    check_refused(run_of(out, 5000) + " --resume --time-limit 2h");
}

// Every batch of this study takes a minute of processor time.
TEST_CASE("Signals and the time limit stop an unfinished batch, which is discarded") {
    const auto [folder, out] = TemporaryFile("r.h5");
    const std::string slow = "run " + study("published/yang-pitch-errors.toml") +
                             " --set numerics.steps_per_mesh=2000 --quiet --out " + out;
    const double before_s = children_s();
    CHECK(program(slow + " --time-limit 00:00:02").code == 4);
    const pid_t child = start(slow + " --resume");
    std::this_thread::sleep_for(1500ms);
    kill(child, SIGTERM);
    const int status = status_of(child);
    REQUIRE(WIFEXITED(status));
    CHECK(WEXITSTATUS(status) == 4);
    CHECK(
        shell(mpirun(2) + GEARPOD_PROGRAM + " " + slow + " --resume --time-limit 00:00:01").code ==
        4);
    CHECK(children_s() - before_s < 40.0);
    CHECK(mc::read_results(out).status.empty());
    fs::remove(out + ".part");
}

TEST_CASE("Stopped by signals inside of batches and resumed, a run keeps its bits", "[mpi]") {
    const Folder folder;
    const std::string out = folder.file("r.h5");
    const auto command = [&](const std::string& file) {
        return run_of(file, 20, 17, "crack-in-sun.toml") + " --quiet";
    };
    require_success(command(folder.file("whole.h5")));
    int stopped = 0;
    for (int i = 0; i < 30; ++i) {
        const std::string stop = "timeout -s TERM " + std::to_string(0.3 + 0.1 * (i % 7)) + " env ";
        const Outcome part = shell(stop + (i % 2 == 0 ? "" : mpirun(2)) + GEARPOD_PROGRAM + " " +
                                   command(out) + " --resume");
        INFO(part.output);
        if (part.mentions("is using it")) {
            std::this_thread::sleep_for(200ms);  // mpirun ends before its ranks do
            continue;
        }
        REQUIRE(part.code != 2);
        if (part.code == 0) {
            break;
        }
        ++stopped;
    }
    CHECK(stopped > 0);
    require_success(command(out) + " --resume");
    CHECK(bits(out) == bits(folder.file("whole.h5")));
}

TEST_CASE("Rows named twice are computed once") {
    const auto [folder, out] = TemporaryFile("r.h5");
    require_success(run_of(out, 2) + " --quiet --signals 1,1,0 --signals 1");
    CHECK_FALSE(fs::exists(out + ".part"));
}

TEST_CASE("An extended ensemble computes only new gearboxes, with the bits of a single run") {
    const auto [folder, out] = TemporaryFile("r.h5");
    require_success(run_of(out, 20) + " --quiet");
    check_mentions(require_success(run_of(out) + " --resume"), {"r.h5: 4 of 7 batches"});
    CHECK(bits(out) == reference());
    check_mentions(program(run_of(out) + " --resume"), {"r.h5: 7 of 7 batches"});
    CHECK(bits(out) == reference());
    CHECK(folder.files() == 1);

    check_refused(run_of(out, 20) + " --resume",
                  {"r.h5: cannot be continued: it has 50 test gearboxes"});
    check_refused(run_of(out) + " --resume --seed 9", {"has seed 2, this run has 9"});
    check_refused(run_of(out) + " --resume --set operation.torque_N_m=400", {"another study"});
    std::string damaged = bytes_of(out);
    damaged[damaged.size() / 2] = static_cast<char>(~damaged[damaged.size() / 2]);
    write_bytes(out, damaged);
    CHECK(program(run_of(out) + " --resume").mentions("r.h5: is damaged"));
    CHECK(folder.files() == 1);
}

TEST_CASE("An extended threshold sample computes only new gearboxes, with or without graded ones") {
    const auto [folder, out] = TemporaryFile("r.h5");
    for (const int test : {50, 20}) {
        require_success(run_of(out, test, 20) + " --quiet --force");
        const Outcome grown = require_success(run_of(out) + " --resume");
        // One of the old sample's two batches is full, and all or one of the four test gearboxes.
        CHECK(grown.mentions(test == 50 ? "r.h5: 5 of 7 batches" : "r.h5: 2 of 7 batches"));
        CHECK(bits(out) == reference());
    }
    check_refused(run_of(out, 50, 20) + " --resume", {"threshold_instances = 35"});
    // Trend features refer to the first eight of the sample.
    require_success(run_of(out, 20, 7) + " --quiet --force");
    check_refused(run_of(out) + " --resume");
    CHECK(folder.files() == 1);
}

TEST_CASE("Ranks with another study, or without it, end the run with one line", "[mpi]") {
    const Folder folder;
    const std::string out = folder.file("r.h5"), other = folder.file("other.toml");
    fs::copy_file(study("planet-crack-ideal.toml"), other);
    const std::string binary = GEARPOD_PROGRAM;
    const auto with_second = [&](const std::string& arguments) {
        return shell(mpirun(1) + binary + " " + run_of(out) + " : --oversubscribe -n 1 " +
                     arguments);
    };
    check_refused(with_second(binary + " " + run_of(out) + " --set operation.torque_N_m=400"),
                  {"rank 1 on ", "read another study", "torque_N_m"});
    check_refused(with_second(binary + " run " + folder.file("none.toml")),
                  {"rank 1 on ", "none.toml"});
    // Same program with one byte appended.
    write_bytes(folder.file("gearpod"), bytes_of(binary) + "x");
    fs::permissions(folder.file("gearpod"), fs::perms::owner_all);
    check_refused(with_second(folder.file("gearpod") + " " + run_of(out)),
                  {"runs another program"});
    CHECK_FALSE(fs::exists(out));
    CHECK_FALSE(fs::exists(out + ".part"));
}

TEST_CASE("A rank that dies ends the run, and finished batches are kept", "[mpi]") {
    const auto [folder, out] = TemporaryFile("r.h5");
    // The second rank kills itself once there are batches.
    const std::string mortal = "sh -c '( until [ -s " + out + ".part ] && [ $(stat -c %s " + out +
                               ".part) -gt 8192 ]; do sleep 0.05; done; kill -9 $$ ) & exec " +
                               GEARPOD_PROGRAM + " " + run_of(out, 5000) + "'";
    const Outcome run = shell("timeout 100 env " + mpirun(1) + GEARPOD_PROGRAM + " " +
                              run_of(out, 5000) + " : --oversubscribe -n 1 " + mortal);
    INFO(run.output);
    CHECK(run.code != 0);
    CHECK(run.code != 124);
    const Outcome resumed = program(run_of(out, 5000) + " --resume --time-limit 00:00:01");
    INFO(resumed.output);
    CHECK(resumed.code == 4);
    CHECK(resumed.mentions("continuing"));
    CHECK_FALSE(resumed.mentions(": 0 of"));
}

TEST_CASE("A full disk while results are written leaves a checkpoint from which to resume") {
    const auto [folder, out] = TemporaryFile("r.h5");
    // Limit in blocks of 512 bytes; the checkpoint fits, the results do not.
    const std::size_t blocks = 90;
    const Outcome full = shell("ulimit -f " + std::to_string(blocks) + "; " + GEARPOD_PROGRAM +
                               " " + run_of(out) + " --quiet");
    INFO(full.output);
    CHECK(full.code == 4);
    check_mentions(full, {"cannot be written (File too large)", "kept in " + out + ".part"});
    CHECK_FALSE(fs::exists(out));
    require_success(run_of(out) + " --quiet --resume");
    CHECK(bits(out) == reference());
    CHECK(folder.files() == 1);
}

TEST_CASE("A folder without write permission is reported before the run") {
    const Folder folder;
    fs::create_directory(folder.file("locked"));
    fs::permissions(folder.file("locked"), fs::perms::owner_read | fs::perms::owner_exec |
                                               fs::perms::others_read | fs::perms::others_exec);
    // The user root ignores permissions.
    const std::string nobody =
        geteuid() == 0 ? "setpriv --reuid=65534 --regid=65534 --clear-groups " : "";
    check_refused(shell(nobody + GEARPOD_PROGRAM + " " + run_of(folder.file("locked/r.h5"))),
                  {"locked/r.h5: cannot be written: Permission denied"});
    CHECK(fs::is_empty(folder.file("locked")));
}

}  // namespace gearpod::test_runs
