// Findings of a comparison of results files. Every file (B, C, ...) is compared with the first, A.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "analysis/comparison/comparison.hpp"
#include "analysis/reliability.hpp"
#include "analysis/report/report.hpp"
#include "machine/fields.hpp"

namespace gearpod::analysis {

struct ComparedFeature {
    std::string feature;
    double noise_level = 0.0;
    bool same = false;  // every pair of values is equal
    Comparison comparison;
};
GEARPOD_FIELDS(ComparedFeature, name, noise_level, same, comparison_)

struct ComparedFile {
    std::string path, title;
    long gearboxes = 0;
    std::vector<double> noise_levels;
    std::vector<std::optional<SmallestFault>> smallest;  // by noise level
    // True if no feature has a threshold at this noise level; an empty `smallest` then means
    // unknown, not undetected.
    std::vector<bool> without_threshold;
    std::string shortage;  // result of sample_shortage()
    // Comparison with A; empty for A itself.
    long pairs = 0;                      // number of test gearboxes common to both
    std::string unpaired;                // reason why gearboxes are not paired, or ""
    std::vector<std::string> differing;  // inputs whose values differ in the pairs
    std::vector<std::string> left_out;   // features that only one of the two files has
    std::vector<ComparedFeature> features;
};
GEARPOD_FIELDS(ComparedFile, path, title, gearboxes, noise_levels_, smallest_, without_threshold_,
               shortage_, pairs, unpaired_, differing_inputs, left_out, features_)

struct ComparedResults {
    std::vector<ComparedFile> files;
    SizeUnit size;
    double confidence = 0.95;
    double noise_level = 1.0;  // noise level shown first
    // Healthy gearboxes have several records, and the comparison uses thresholds set by the first
    // record of each.
    bool first_records = false;
};

// Sections: the headline with the smallest faults and the files; the differences of a90 and AUC of
// all files; for each file its differences from A. Keys end in the file's index from 0.
Report comparison_report(const ComparedResults& results);

// docs/reference/report-json.md lists the keys.
nlohmann::json comparison_json(const ComparedResults& results);

}  // namespace gearpod::analysis
