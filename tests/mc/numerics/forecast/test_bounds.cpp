// Checks the cost of accepted studies: describe ends soon and stays small, run reports in advance
// what exceeds the memory, and every count has an upper limit.
#include <sys/resource.h>

#include "tests/mc/program.hpp"

namespace gearpod::test_bounds {

using namespace test;

std::string levels(int count) {
    std::string list;
    for (int i = 0; i < count; ++i) {
        list += (i == 0 ? "" : ",") + std::to_string(i);
    }
    return "[" + list + "]";
}

// Runs the program in 2 GB; fails on an exit code of a shell or of a signal.
Outcome bounded(const std::string& arguments, int kilobytes = 2000000) {
    return shell(within_memory(kilobytes) + "timeout 60 " + GEARPOD_PROGRAM + " " + arguments);
}

// Processor time of all programs that have ended.
double children_processor_s() {
    rusage usage{};
    getrusage(RUSAGE_CHILDREN, &usage);
    return static_cast<double>(usage.ru_utime.tv_sec + usage.ru_stime.tv_sec) +
           1e-6 * static_cast<double>(usage.ru_utime.tv_usec + usage.ru_stime.tv_usec);
}

TEST_CASE("describe ends within its time and memory for any counts in a study") {
    const std::string study = test::study("crack-in-sun.toml");
    for (const std::string& set :
         {"sensor.noise_levels=" + levels(1000),
          std::string("ensemble.instances=1000000000' --set "
                      "'ensemble.threshold_instances=1000000000"),
          std::string("sensor.sampling_Hz=100000' --set 'features.te_harmonics=1000"),
          std::string("numerics.tolerance=1e-9"),
          std::string("numerics.steps_per_mesh=1000000' --set 'numerics.max_meshes=1000000")}) {
        const double start_s = children_processor_s();
        const Outcome outcome = bounded("describe " + study + " --seconds 2 --set '" + set + "'");
        INFO(set.substr(0, 40) << "\n" << outcome.output);
        CHECK((outcome.code == 0 || outcome.code == 2));
        CHECK(children_processor_s() - start_s < 40);  // two threads for 2 s, and the set-up
        CHECK_FALSE(outcome.mentions("std::"));
        CHECK_FALSE(outcome.mentions("nan"));
    }
}

TEST_CASE("Counts beyond their limits are refused with the limit") {
    const std::string study = test::study("crack-in-sun.toml");
    for (const auto& [set, words] :
         {std::pair{"sensor.noise_levels=" + levels(1001), "at most 1000"},
          std::pair{"random.fault.depth_mm={distribution='levels',values=" + levels(1001) + "}",
                    "at most 1000"},
          std::pair{std::string("sensor.sampling_Hz=1e7"), "at most 20000"},
          std::pair{std::string("ensemble.instances=1000000001"), "ensemble.instances"},
          std::pair{std::string("sensor.encoder_sampling_Hz=30\" --set \"features.use=['te_fm4']"),
                    "too few for te_fm4, te_m6a and te_m8a"},
          std::pair{std::string("features.te_harmonics=100000"), "features.te_harmonics"}}) {
        const Outcome outcome = bounded("describe " + study + " --set \"" + set + "\"");
        INFO(outcome.output.substr(0, 400));
        CHECK(outcome.code == 2);
        CHECK(outcome.mentions(words));
    }
}

#ifndef __SANITIZE_ADDRESS__
TEST_CASE("A run that exceeds the memory reports this before it begins") {
    const Folder folder;
    const std::string run = "run " + test::study("crack-in-sun.toml") +
                            " --set numerics.horizon=full --set sensor.sampling_Hz=60000 --set "
                            "numerics.threads=2 --out " +
                            folder.file("r.h5");
    check_refused(bounded(run, 1500000), {"the run needs at least", "--force"});
    CHECK(folder.empty());
    // A forced run ends with a message and keeps its results.
    const Outcome forced = bounded(run + " --force --quiet --time-limit 00:00:05", 1500000);
    INFO(forced.output);
    CHECK(forced.code == 4);
    CHECK_FALSE(forced.mentions("std::"));
}
#endif

}  // namespace gearpod::test_bounds
