// Checks the number of a run's threads and their placement: OMP_NUM_THREADS, OMP_THREAD_LIMIT and
// numerics.threads, ranks on the same machine, OMP_PROC_BIND and OMP_PLACES.
#include <atomic>

#include "machine/team.hpp"
#include "tests/mc/program.hpp"
#include "tests/test.hpp"

namespace gearpod::test_thread_count {

using namespace test;

// Five batches.
std::string run_of(const Folder& folder) {
    return "run " + study("planet-crack-ideal.toml") +
           " --instances 48 --set ensemble.threshold_instances=32"
           " --set operation.carrier_speed_rpm=60 --set sensor.sampling_Hz=20000"
           " --set sensor.encoder_sampling_Hz=20000 --out " +
           folder.file("r.h5");
}

const std::string kProgram = std::string(GEARPOD_PROGRAM) + " ";

// Beginning of a command, independent of the environment of the tests.
std::string with(const std::string& environment) {
    return "unset OMP_NUM_THREADS OMP_THREAD_LIMIT OMP_PROC_BIND OMP_PLACES; " + environment + " ";
}

// Checks the run's message about its threads.
void check_threads(const std::string& environment, const std::string& more, int threads) {
    const Folder folder;
    check_mentions(
        require_success(shell(with(environment) + kProgram + run_of(folder) + more)),
        {" s with " + std::to_string(threads) + " thread" + (threads == 1 ? "." : "s.")});
}

TEST_CASE(
    "OMP_NUM_THREADS sets the number of threads, numerics.threads overrides it, the limit "
    "applies") {
    const std::string own = " --set numerics.threads=";
    check_threads("OMP_NUM_THREADS=3", "", 3);
    check_threads("OMP_NUM_THREADS=2,4", "", 2);
    check_threads("OMP_NUM_THREADS=3", own + "1", 1);
    check_threads("OMP_NUM_THREADS=1", own + "3", 3);
    check_threads("OMP_NUM_THREADS=3 OMP_THREAD_LIMIT=2", "", 2);
    check_threads("OMP_THREAD_LIMIT=2", own + "3", 2);
    // Threads in excess of the number of batches are not started.
    check_threads("OMP_NUM_THREADS=64", "", 5);
}

TEST_CASE("A malformed OMP_NUM_THREADS is ignored, and OpenMP reports it") {
    const int processors = std::min(5, machine::processors());
    check_threads("", "", processors);
    check_threads("OMP_NUM_THREADS=many", "", processors);
    check_threads("OMP_NUM_THREADS=0", "", processors);
    const Folder folder;
    CHECK(shell(with("OMP_NUM_THREADS=many") + kProgram + run_of(folder))
              .mentions("OMP_NUM_THREADS"));
}

TEST_CASE("Ranks share a machine's processors, but not the OMP_NUM_THREADS of each", "[mpi]") {
    const auto in_all = [](const std::string& environment) {
        const Folder folder;
        const Outcome run =
            shell(with(environment) + mpirun(2) + "--bind-to none " + kProgram + run_of(folder));
        INFO(run.output);
        const auto at = run.output.find(" s with ");
        REQUIRE(run.mentions(" threads in 2 ranks"));
        return std::stoi(run.output.substr(at + 8));
    };
    CHECK(in_all("OMP_NUM_THREADS=2") == 4);
    if (machine::processors() <= 4) {  // more threads would exceed the number of batches
        CHECK(in_all("") == 2 * std::max(1, machine::processors() / 2));
    }
}

TEST_CASE("A forecast uses the run's number of threads") {
    for (const int threads : {1, 3}) {
        const auto forecast = shell(
            with("OMP_NUM_THREADS=" + std::to_string(threads)) + kProgram + "describe " +
            study("planet-crack-ideal.toml") + " --full --set operation.carrier_speed_rpm=60" +
            " --set sensor.sampling_Hz=20000 --set sensor.encoder_sampling_Hz=20000");
        INFO(forecast.output);
        const std::string entry = "\n  threads ";
        const auto at = forecast.output.find(entry);
        REQUIRE(at != std::string::npos);
        CHECK(std::stoi(forecast.output.substr(at + entry.size())) == threads);
    }
}

TEST_CASE("Only the team is bound to places: one per thread, none for the main thread") {
    if (machine::processors() < 2) {
        WARN("one processor: there is nothing to bind to");
        return;
    }
    const Folder folder;
    const auto run = require_success(shell(
        with("OMP_NUM_THREADS=2 OMP_PROC_BIND=true OMP_PLACES=threads OMP_DISPLAY_AFFINITY=TRUE "
             "OMP_AFFINITY_FORMAT='<%n of %N at %A>'") +
        kProgram + run_of(folder) + " --quiet"));
    std::vector<std::string> places;
    for (const std::string thread : {"<0 of 2 at ", "<1 of 2 at "}) {
        const auto at = run.output.find(thread);
        REQUIRE(at != std::string::npos);
        const auto end = run.output.find('>', at);
        places.push_back(run.output.substr(at + thread.size(), end - at - thread.size()));
    }
    CHECK(places[0] != places[1]);
    CHECK(places[0].find_first_of("-,") == std::string::npos);
    CHECK(places[1].find_first_of("-,") == std::string::npos);
    CHECK_FALSE(run.mentions("of 3"));
}

// Checks OpenMP teams: every task runs once on as many threads as OpenMP grants, and exceptions are
// not lost.

TEST_CASE("Every index is processed once, for any team size") {
    for (const int threads : {1, 2, 3, 7}) {
        for (const std::size_t count : {0, 1, 2, 100}) {
            std::vector<std::atomic<int>> times(count);
            machine::for_each_index(count, threads, [&](std::size_t i) { ++times[i]; });
            for (const auto& each : times) {
                REQUIRE(each == 1);
            }
        }
    }
}

TEST_CASE("Every thread of a team receives the team's size") {
    for (const int threads : {1, 2, 5}) {
        std::atomic<int> calls{0};
        std::atomic<bool> same{true};
        machine::run_team(threads, [&](int granted) {
            ++calls;
            same = same && granted == threads;
        });
        CHECK(calls == threads);
        CHECK(same);
    }
}

TEST_CASE("An exception in a team is rethrown after the others have finished") {
    std::atomic<int> calls{0};
    const auto work = [&](std::size_t i) {
        ++calls;
        if (i == 3) {
            throw std::runtime_error("the fourth");
        }
    };
    CHECK_THROWS_WITH(machine::for_each_index(50, 2, work), "the fourth");
    CHECK(calls == 50);
    std::atomic<int> threads{0};
    CHECK_THROWS_WITH(machine::run_team(3, [&](int) { work(static_cast<std::size_t>(++threads)); }),
                      "the fourth");
    CHECK(threads == 3);
}

}  // namespace gearpod::test_thread_count
