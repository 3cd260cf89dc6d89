// Comparison of two results files of `run`, gearbox by gearbox where seed and sizes agree.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analysis/comparison/comparison_report.hpp"
#include "mc/plan/study_facts.hpp"
#include "mc/results/results_file.hpp"

namespace gearpod::mc {

// Results file with the rows of its two groups.
struct ComparedSide {
    std::string path;
    Results frame;                             // includes the columns
    std::vector<std::size_t> threshold, test;  // rows
    std::optional<RunFacts> facts;             // empty if the study cannot be read
};

// Reads a results file. Throws std::runtime_error if it is not one of `run`, or damaged.
ComparedSide read_compared(const std::string& path);

// Reasons why two files cannot be compared, one line each; "" if they can.
std::string mismatch(const ComparedSide& a, const ComparedSide& b);

// Feature and noise level to compare; by default all.
struct ComparedSelection {
    std::string feature;
    double noise_level = 0.0;

    bool holds(const std::string& other, double level) const {
        return feature.empty() || (feature == other && noise_level == level);
    }
};

// Adds the comparison of `b` with `a` to the entry of `b`. The request's confidence and resamples
// are used.
void compare_with(const ComparedSide& a, const ComparedSide& b, analysis::ComparisonRequest request,
                  const ComparedSelection& selection, analysis::ComparedFile& file);

}  // namespace gearpod::mc
