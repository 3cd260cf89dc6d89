// Checks a run on several machines: each evaluates a share of the detection statistics, and the
// text is that of one process.
#include <nlohmann/json.hpp>

#include "analysis/report/detection_json.hpp"
#include "mc/library/run/reliability_on_machines.hpp"
#include "mc/results/reliability_of_results.hpp"
#include "tests/mc/program.hpp"

namespace gearpod::test_machines {

using namespace test;
namespace fs = std::filesystem;

// Prefix of a command that Open MPI runs with one rank on one machine and two on another. Both are
// this machine: Open MPI starts a process on another machine by calling ssh, which a script
// replaces that calls the command itself.
std::string on_two_machines(const Folder& folder) {
    const std::string agent = folder.file("agent");
    std::ofstream(agent) << "#!/bin/sh\nshift\nexec sh -c \"$*\"\n";
    fs::permissions(agent, fs::perms::owner_all);
    return "OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 "
           "ASAN_OPTIONS=detect_leaks=0 " +
           std::string(GEARPOD_MPIEXEC) + " --oversubscribe --mca plm_rsh_agent " + agent +
           " --mca btl_tcp_if_include lo --mca oob_tcp_if_include lo -H first:1,second:2 ";
}

// Output of a run without its times and its number of ranks.
std::string tables(const Outcome& run) {
    const std::size_t first = run.output.find("These results hold"),
                      last = run.output.find("Time: ");
    INFO(run.output);
    REQUIRE(first < last);
    REQUIRE(last != std::string::npos);
    return run.output.substr(first, last - first);
}

TEST_CASE("Machines share the detection statistics, and the report is that of one process",
          "[mpi]") {
    if (std::string(GEARPOD_MPIEXEC).empty()) {
        return;
    }
    const Folder folder;
    const std::string command =
        std::string(GEARPOD_PROGRAM) + " run " + study("planet-crack-ideal.toml") +
        " --instances 140 --set ensemble.threshold_instances=100 --set numerics.threads=1 --out ";
    const Outcome one = shell(command + folder.file("one.h5"));
    const Outcome two = shell(on_two_machines(folder) + command + folder.file("two.h5"));
    INFO(two.output);
    REQUIRE(one.code == 0);
    REQUIRE(two.code == 0);
    check_mentions(two, {"3 threads in 3 ranks", "on 2 machines"});
    CHECK_FALSE(one.mentions("machines"));
    CHECK(tables(one) == tables(two));

    // Statistics of one pair as a message.
    const mc::Results results = mc::read_results(folder.file("one.h5"));
    auto reliability = mc::reliability_of(results, mc::ColumnRows(results), "", 2);
    REQUIRE(reliability);
    const auto text = [&] {
        return analysis::reliability_json(*reliability, results.request).dump();
    };
    const std::string before = text();
    for (analysis::FeatureReliability& feature : reliability->features) {
        for (analysis::LevelReliability& level : feature.levels) {
            const std::string bytes = mc::bytes_of(level);
            level = mc::value_of<analysis::LevelReliability>(bytes);
            CHECK(mc::bytes_of(level) == bytes);
        }
    }
    CHECK(text() == before);
}

}  // namespace gearpod::test_machines
