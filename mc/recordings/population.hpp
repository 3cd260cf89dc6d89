// What healthy gearboxes of a results file, simulated or measured, say of one recording.
#pragma once

#include <string>
#include <vector>

#include "analysis/detection/detection.hpp"
#include "mc/gearbox/measured_features.hpp"
#include "mc/study/study.hpp"

namespace gearpod::mc {

struct PopulationFeature {
    std::string name;
    analysis::Alarm alarm = analysis::Alarm::high;
    double threshold = 0.0;
    long sample = 0;              // healthy ones that set it
    std::vector<double> healthy;  // ascending; these, and graded ones without a fault
    double auc = 0.0;             // NaN without faulty ones
};

struct Population {
    std::string file;
    bool recordings = false;  // else simulated
    double noise_level = 1.0;
    double false_alarm_rate = 0.0;
    std::vector<PopulationFeature> features;  // the best first, by area under the ROC
};

// Of a noise level that the file has. Throws std::runtime_error naming the file and why not: no
// results, other teeth than the study's, no such level, no healthy ones.
Population read_population(const std::string& path, double noise_level, const Study& study);

// Of one feature.
struct Verdict {
    const PopulationFeature* population = nullptr;
    double value = 0.0;
    bool alarm = false;
    double margin = 0.0;    // beyond the threshold, as a share of it; negative before it
    long less_extreme = 0;  // healthy ones
};

// `measured`: by measurable(), NaN: none. Of the features that recording and population
// have, in the population's order; `feature`, if named, is the first. Throws std::runtime_error if
// there is none, or not that one.
std::vector<Verdict> judge(const Population& population, const std::vector<double>& measured,
                           const std::string& feature);

std::vector<double> values_of(const std::vector<MeasuredFeature>& measured);

// One sentence on the first verdict and the tooth that stands out.
std::string verdict_sentence(const std::string& recording, const Population& population,
                             const Verdict& verdict, const std::vector<WorstTooth>& teeth);

}  // namespace gearpod::mc
