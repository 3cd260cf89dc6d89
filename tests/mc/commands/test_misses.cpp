// Checks misses: rates of misses against counted ones, and the same bits for any threads and ranks.
#include "mc/results/results_file.hpp"
#include "tests/mc/program_json.hpp"

namespace gearpod::test_misses {

using namespace test;

// Results of a small study, computed once. Thresholds are set by 100 healthy gearboxes.
const std::string& small_results() {
    static const Folder folder;
    static const std::string results = [] {
        require_success("run " + study("planet-crack-ideal.toml") + " --quiet --out " +
                        folder.file("ideal.h5") +
                        " --instances 40 --set ensemble.threshold_instances=100 --set "
                        "'sensor.noise_levels=[0,2]' --set "
                        "'features.use=[\"te_rms\",\"window_ratio\"]'");
        return folder.file("ideal.h5");
    }();
    return results;
}

const std::string kRequest = " --feature window_ratio --size 1 --quiet --json -";

TEST_CASE("Rates of misses agree with counted ones") {
    const Folder folder;
    const std::string& results = small_results();
    const auto result = json_of("misses " + results + " --gearboxes 60 --records 32" + kRequest);
    CHECK(result["noise_level"] == 2.0);
    REQUIRE(result["miss_rate"].is_number());
    // Other gearboxes of the same study, with one plain record each, against the same threshold.
    const double threshold = result["threshold"];
    const std::string counted = folder.file("counted.h5");
    require_success("run " + study("planet-crack-ideal.toml") + " --quiet --out " + counted +
                    " --instances 500 --seed 77 --set ensemble.threshold_instances=8 --set "
                    "'sensor.noise_levels=[0,2]' --set 'features.use=[\"window_ratio\"]' --set "
                    "'random.fault.depth_mm={distribution=\"levels\",values=[1]}'");
    const mc::Results rows = mc::read_results(counted);
    double misses = 0.0, all = 0.0;
    for (std::size_t row = 0; row < rows.status.size(); ++row) {
        if (rows.group[row] == 1) {
            all += 1.0;
            misses += rows.features[0].values[2 * row + 1] <= threshold ? 1.0 : 0.0;
        }
    }
    const double rate = misses / all, error = std::sqrt(rate * (1.0 - rate) / all);
    INFO(rate << " counted");
    CHECK(result["lower"].get<double>() < rate + 3.0 * error);
    CHECK(result["upper"].get<double>() > rate - 3.0 * error);
}

TEST_CASE("The miss rate of faults that are nearly always missed is at most 1") {
    const std::string request = "misses " + small_results() +
                                " --feature window_ratio --size 0.01 --gearboxes 60 --records 16 "
                                "--quiet";
    check_mentions(require_success(request), {"misses are not rare enough for this method"});
    const auto result = json_of(request + " --json -");
    CHECK(result["miss_rate"] <= 1.0);
    CHECK(result["miss_rate"] > 0.9);
    CHECK(result["upper"] <= 1.0);
    CHECK((result["counted_records"].is_null() || result["counted_records"] > 0.0));
}

TEST_CASE("Rates of misses have the same bits for any number of threads and ranks") {
    const std::string command = std::string(GEARPOD_PROGRAM) + " misses " + small_results() +
                                " --gearboxes 40 --records 8" + kRequest;
    const Outcome one = require_success(shell("OMP_NUM_THREADS=1 " + command));
    CHECK(shell("OMP_NUM_THREADS=3 " + command).output == one.output);
    CHECK(shell(mpirun(2) + command).output == one.output);
}

TEST_CASE("Invalid requests to misses are refused, every problem at once") {
    const std::string& results = small_results();
    check_refused("misses " + results + " --feature te_rms --size 0 --noise-level 3 --records 6",
                  {"--feature: \"te_rms\" does not use the acceleration signal",
                   "--size: must be > 0 and finite, but is 0",
                   "--noise-level: 3 is not a noise level of the file; choose from 0, 2",
                   "--records: must be a multiple of 4 up to 10000, but is 6"});
    const Outcome many = check_refused("misses " + results +
                                       " --feature window_ratio --size 1 --records 40000 "
                                       "--gearboxes 1");
    CHECK(many.output ==
          "--records: must be a multiple of 4 up to 10000, but is 40000\n"
          "--gearboxes: must be between 2 and 10000, but is 1\n");
    check_refused("misses " + results + " --feature nothing --size 1",
                  {"its features are te_rms, window_ratio"});
    const Outcome deep = check_refused("misses " + results + " --feature window_ratio --size 900");
    CHECK(deep.output.starts_with("--size: "));
    CHECK(std::count(deep.output.begin(), deep.output.end(), '\n') == 1);
    check_refused("misses /none/none.h5 --feature fm4 --size 1");
}

}  // namespace gearpod::test_misses
