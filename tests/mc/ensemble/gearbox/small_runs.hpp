// Runs of a small study, and what several tests of its sensors compare.
#pragma once

#include "tests/mc/program.hpp"
#include "tests/numbers.hpp"

namespace gearpod::test {

inline const std::string kSmall =
    std::string(GEARPOD_SOURCE_DIR) + "/tests/features/reference/small.toml";

// 20 healthy and 20 faulty gearboxes.
inline const std::string kFewGearboxes =
    " --set ensemble.threshold_instances=20 --set ensemble.instances=20"
    " --set fault.reduction=0.4 ";

// Results of `run` on that study with 20 healthy and 20 faulty gearboxes.
inline mc::Results run_small(const Folder& folder, const std::string& name,
                             const std::string& options) {
    const std::string path = folder.file(name);
    require_success("run " + kSmall + kFewGearboxes + "--out " + path + " " + options);
    return mc::read_results(path);
}

// Results of that run without options, computed once.
inline const mc::Results& plain_small_run() {
    static const Folder folder;
    static const mc::Results results = run_small(folder, "plain.h5", "");
    return results;
}

// Columns of a CSV table by their names without units.
using Columns = std::map<std::string, std::vector<double>>;

inline Columns columns_of(const std::string& path) {
    std::istringstream stream(bytes_of(path));
    std::string line;
    std::getline(stream, line);
    std::vector<std::string> names;
    Columns columns;
    std::istringstream head(line);
    for (std::string name; std::getline(head, name, ',');) {
        names.push_back(name.substr(0, name.find(" [")));
    }
    while (std::getline(stream, line)) {
        std::istringstream cells(line);
        std::size_t at = 0;
        for (std::string cell; std::getline(cells, cell, ',');) {
            columns[names.at(at++)].push_back(std::stod(cell));
        }
    }
    return columns;
}

// Signals of gearbox 2 of the study; they repeat after 455 mesh periods.
inline Columns signals_of_small(const Folder& folder, const std::string& options,
                                int meshes = 455) {
    const std::string path = folder.file("s.csv");
    require_success("simulate " + kSmall + " --instance 2 --meshes " + std::to_string(meshes) +
                    " --out " + path + " --force " + options);
    return columns_of(path);
}

// Value of a feature in printed output; 0 if it is not there.
inline double printed_value(const Outcome& outcome, const std::string& name) {
    std::istringstream lines(outcome.output);
    for (std::string line; std::getline(lines, line);) {
        std::istringstream words(line);
        std::string first;
        double number = 0.0;
        if (words >> first >> number && first == name) {
            return number;
        }
    }
    return 0.0;
}

inline const std::vector<double>& values(const std::vector<mc::FeatureResult>& features,
                                         const std::string& name) {
    return std::ranges::find(features, name, &mc::FeatureResult::name)->values;
}

inline void check_same_bits(const std::vector<double>& a, const std::vector<double>& b) {
    CHECK(bits_of(a) == bits_of(b));
}

// Checks that all features of two runs have the same bits, at the first sensor and the next one.
inline void check_same_features(const mc::Results& a, const mc::Results& b) {
    REQUIRE(a.features.size() == b.features.size());
    for (std::size_t f = 0; f < a.features.size(); ++f) {
        INFO(a.features[f].name);
        check_same_bits(a.features[f].values, b.features[f].values);
        check_same_bits(a.variants[0].features[f].values, b.variants[0].features[f].values);
    }
}

// Relative change of features by the mean of a simulated signal, which `features` removes.
inline constexpr double kMean = 5e-4;

// Output of `features` for the exported samples of gearbox 25 of such a run, which has 455 mesh
// periods.
inline Outcome features_of_export(const Folder& folder, const std::string& sensor,
                                  const std::string& options) {
    const std::string signal = folder.file("signal.h5");
    require_success("simulate " + kSmall + " --instance 25 --meshes 455 --out " + signal +
                    kFewGearboxes + options);
    return require_success("features " + signal + " --sensor " + sensor + " --study " + kSmall);
}

// Checks that a run with these options has the same bits merged from parts of other threads.
inline void check_equal_bits_over_parts(const std::string& options) {
    const Folder folder;
    const auto whole = bits(run_small(folder, "whole.h5", options));
    run_small(folder, "1.h5", options + " --part 1/2 --set numerics.threads=3");
    run_small(folder, "2.h5", options + " --part 2/2 --set numerics.threads=1");
    require_success("merge --out " + folder.file("merged.h5") + " " + folder.file("1.h5") + " " +
                    folder.file("2.h5"));
    CHECK(bits(folder.file("merged.h5")) == whole);
}

}  // namespace gearpod::test
