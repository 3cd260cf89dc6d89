// Checks rare and misses: thresholds and misses at rates determined by gearbox-to-gearbox
// variation, against counted ones, and the same bits for any threads and ranks.
#include "mc/results/results_file.hpp"
#include "tests/mc/program_json.hpp"

namespace gearpod::test_rare {

using namespace test;

// Seven milliseconds per gearbox.
std::string study() {
    return std::string(GEARPOD_SOURCE_DIR) + "/tests/bench/rare_teeth.toml";
}

std::string run_some(const Folder& folder, const std::string& name, const std::string& more) {
    const std::string results = folder.file(name);
    require_success("run " + study() + " --quiet --out " + results + " " + more);
    return results;
}
// Results of a small run, computed once.
const std::string& few_results() {
    static const Folder folder;
    static const std::string results =
        run_some(folder, "few.h5", "--instances 16 --set ensemble.threshold_instances=40");
    return results;
}

// Number of rows of a group beyond a threshold of its first feature at the last of two noise
// levels, and number of all rows.
std::pair<double, double> count_above(const std::string& results, int group, double threshold,
                                      const std::string& feature) {
    const mc::Results rows = mc::read_results(results);
    std::size_t of = 0;
    while (rows.features[of].name != feature) {
        ++of;
    }
    double above = 0.0, all = 0.0;
    for (std::size_t row = 0; row < rows.status.size(); ++row) {
        if (rows.group[row] == group) {
            all += 1.0;
            above += rows.features[of].values[2 * row + 1] > threshold ? 1.0 : 0.0;
        }
    }
    return {above, all};
}

TEST_CASE("Thresholds of rare false alarms agree with counted ones") {
    const Folder folder;
    const auto result =
        json_of("rare " + few_results() +
                " --feature window_ratio --rate 0.01 --gearboxes 160 --quiet --json -");
    CHECK(result["kind"] == "rare-false-alarms");
    CHECK(result["gearboxes"] == 160 * (1 + 2 * 3));
    REQUIRE(result["rate"].is_number());
    CHECK(result["rate"] <= 0.01);
    CHECK(result["threshold_lower"] < result["threshold"]);
    CHECK(result["threshold_upper"] > result["threshold"]);
    CHECK(result["least_kept"] > 0.05);
    // Results of other healthy gearboxes.
    const std::string counted = run_some(
        folder, "counted.h5", "--instances 16 --seed 77 --set ensemble.threshold_instances=1000");
    const auto [above, all] = count_above(counted, 0, result["threshold"], "window_ratio");
    INFO(above << " of " << all << " counted");
    CHECK(result["lower"].get<double>() * all < above + 3.0 * std::sqrt(above + 1.0));
    CHECK(result["upper"].get<double>() * all > above - 3.0 * std::sqrt(above));
}

TEST_CASE("Misses due to gearbox variation agree with counted ones") {
    const Folder folder;
    const std::string results =
        run_some(folder, "found.h5",
                 "--instances 600 --set ensemble.threshold_instances=100 --set "
                 "'random.fault.depth_mm={distribution=\"levels\",values=[4]}' --set "
                 "detection.false_alarm_rate=0.3");
    const auto result = json_of("rare " + results +
                                " --feature te_kurtosis --size 4 --gearboxes 100 --quiet --json -");
    CHECK(result["kind"] == "rare-misses");
    CHECK(result["size_unit"] == "mm");
    REQUIRE(result["rate"].is_number());
    const auto [found, all] = count_above(results, 1, result["threshold"], "te_kurtosis");
    const double misses = all - found;
    INFO(misses << " of " << all << " counted");
    CHECK(misses > 5.0);
    CHECK(result["lower"].get<double>() * all < misses + 3.0 * std::sqrt(misses));
    CHECK(result["upper"].get<double>() * all > misses - 3.0 * std::sqrt(misses));
}

TEST_CASE("rare reports the number of gearboxes it simulated and what is unknown") {
    const std::string results = few_results();
    check_mentions(
        require_success("rare " + results +
                        " --feature window_ratio --rate 0.05 --gearboxes 60 "
                        "--quiet"),
        {"false-alarm rate 0.05 of window_ratio at noise x 1", "gearboxes computed, 60 per level"});
    check_mentions(require_success("rare " + results +
                                   " --feature window_ratio --rate 1e-3 --gearboxes 20 "
                                   "--quiet"),
                   {"unknown from 20 gearboxes per level"});
}

TEST_CASE("Invalid requests to rare are refused, every problem at once") {
    const Folder folder;
    const std::string results = few_results();
    const auto refused = [&](const std::string& options) {
        return check_refused("rare " + results + " " + options).output;
    };
    CHECK(refused("--feature nothing --rate 0.5 --gearboxes 3") ==
          "--rate: must be between 1e-09 and 0.1, but is 0.5\n"
          "--gearboxes: must be between 20 and 1000000, but is 3\n"
          "--feature: \"nothing\" is not in " +
              results + "; its features are te_kurtosis, te_fm0, window_ratio, window_z\n");
    CHECK(refused("--feature window_ratio --noise-level 3")
              .find("--rate: missing; give a false-alarm rate") == 0);
    CHECK(refused("--feature window_ratio --size 0 --noise-level 3") ==
          "--noise-level: 3 is not a noise level of the file; choose from 0, 1\n");
    CHECK(refused("--feature window_ratio --size 0") ==
          "--size: must be > 0 and finite, but is 0\n");
    CHECK(refused("--feature window_ratio --size 900").starts_with("--size: "));
    CHECK(program("rare " + results + " --feature window_ratio --size 1 --rate 0.01").code != 0);
    check_refused("rare " + folder.file("none.h5") + " --feature fm4 --rate 0.01");
}

// Results of a small study, computed once. Thresholds are set by 100 healthy gearboxes.
const std::string& small_results() {
    static const Folder folder;
    static const std::string results = [] {
        require_success("run " + test::study("planet-crack-ideal.toml") + " --quiet --out " +
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
    require_success("run " + test::study("planet-crack-ideal.toml") + " --quiet --out " + counted +
                    " --instances 500 --seed 77 --set ensemble.threshold_instances=8 --set "
                    "'sensor.noise_levels=[0,2]' --set 'features.use=[\"window_ratio\"]' --set "
                    "'random.fault.depth_mm={distribution=\"levels\",values=[1]}'");
    const auto [found, all] = count_above(counted, 1, threshold, "window_ratio");
    const double rate = 1.0 - found / all, error = std::sqrt(rate * (1.0 - rate) / all);
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

TEST_CASE("Rare false alarms and misses have the same bits for any number of threads and ranks") {
    for (const std::string& arguments :
         {" rare " + few_results() +
              " --feature window_ratio --rate 0.05 --gearboxes 40 --quiet --json -",
          " misses " + small_results() + " --gearboxes 40 --records 8" + kRequest}) {
        const std::string command = GEARPOD_PROGRAM + arguments;
        const Outcome one = require_success(shell("OMP_NUM_THREADS=1 " + command));
        CHECK(shell("OMP_NUM_THREADS=3 " + command).output == one.output);
        CHECK(shell(mpirun(2) + command).output == one.output);
    }
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

}  // namespace gearpod::test_rare
