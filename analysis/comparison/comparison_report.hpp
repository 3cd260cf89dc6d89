// Comparison of results files, as shown in the terminal, in JSON and on the page. Every file (B, C,
// ...) is compared with the first, A.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "analysis/comparison/comparison.hpp"
#include "analysis/smallest_fault.hpp"

namespace gearpod::analysis {

struct ComparedFeature {
    std::string feature;
    double noise_level = 0.0;
    bool same = false;  // every pair of values is equal
    Comparison comparison;
};

struct ComparedFile {
    std::string path, title;
    long gearboxes = 0;
    std::vector<double> noise_levels;
    std::vector<std::optional<SmallestFault>> smallest;  // by noise level
    // By noise level; a missing smallest fault then carries no information.
    std::vector<bool> without_threshold;
    std::string shortage;  // result of sample_shortage()
    // Comparison with A; empty for A itself.
    long pairs = 0;                      // number of graded gearboxes common to both
    std::string unpaired;                // reason why gearboxes are not paired, or ""
    std::vector<std::string> differing;  // inputs whose values differ in the pairs
    std::vector<std::string> left_out;   // features that only one of the two files has
    std::vector<ComparedFeature> features;
};

struct ComparisonReport {
    std::vector<ComparedFile> files;
    SizeUnit size;
    double confidence = 0.95;
    double noise_level = 1.0;  // noise level shown in the terminal
    // Healthy gearboxes have several records, and the comparison uses thresholds set by the first
    // record of each.
    bool first_records = false;
};

std::string comparison_text(const ComparisonReport& report);

// JSON form:
// {"kind": "comparison", "size", "confidence", "noise_level", "first_records",
//  "files": [{"path", "title", "gearboxes", "smallest_faults": [{"noise_level", "fault": {...},
//    "without_threshold"}],
//    "shortage": result of sample_shortage() or null, "pairs", "unpaired", "differing_inputs",
//    "left_out", "features": [{"name", "noise_level", "same",
//      "sizes": [{"size_low", "size_high", "tested": [A, B], "pd": [A, B], "difference", "lower",
//        "upper", "p_value", "only": [A, B] of pairs}],
//      "a90", "auc": {"values": [A, B], "difference", "lower", "upper", "p_value", "refusal"}}]}]}
// Differences are this file minus A; an open bound is null.
nlohmann::json comparison_json(const ComparisonReport& report);

}  // namespace gearpod::analysis
