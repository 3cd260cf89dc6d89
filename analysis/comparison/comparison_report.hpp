// A comparison of results files, as the terminal, JSON and the page have it. Everything is held
// against the first file, A; the others are B, C, ...
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
    bool same = false;  // pairs have the same values, every one
    Comparison comparison;
};

struct ComparedFile {
    std::string path, title;
    long gearboxes = 0;
    std::vector<double> noise_levels;
    std::vector<std::optional<SmallestFault>> smallest;  // by noise level
    std::vector<bool> without_threshold;                 // the same: then none says nothing
    std::string shortage;                                // as sample_shortage() has it
    // Against A; for A itself empty.
    long pairs = 0;                      // graded gearboxes that are the same ones
    std::string unpaired;                // why none are, else empty
    std::vector<std::string> differing;  // inputs whose values differ in the pairs
    std::vector<std::string> left_out;   // features that only one of both has
    std::vector<ComparedFeature> features;
};

struct ComparisonReport {
    std::vector<ComparedFile> files;
    SizeUnit size;
    double confidence = 0.95;
    double noise_level = 1.0;  // that the terminal shows
    // Healthy gearboxes have several records, and thresholds are compared that the first ones set.
    bool first_records = false;
};

std::string comparison_text(const ComparisonReport& report);

// {"kind": "comparison", "size", "confidence", "noise_level", "first_records",
//  "files": [{"path", "title", "gearboxes", "smallest_faults": [{"noise_level", "fault": {...},
//    "without_threshold"}],
//    "shortage": what sample_shortage() says or null, "pairs", "unpaired", "differing_inputs",
//    "left_out", "features": [{"name", "noise_level", "same",
//      "sizes": [{"size_low", "size_high", "tested": [A, B], "pd": [A, B], "difference", "lower",
//        "upper", "p_value", "only": [A, B] of pairs}],
//      "a90", "auc": {"values": [A, B], "difference", "lower", "upper", "p_value", "refusal"}}]}]}
// Differences are this file's less A's; an open bound is null.
nlohmann::json comparison_json(const ComparisonReport& report);

}  // namespace gearpod::analysis
