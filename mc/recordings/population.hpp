// Comparison of one recording with the healthy gearboxes of a results file, simulated or measured.
#pragma once

#include <string>
#include <vector>

#include "analysis/detection/detection.hpp"
#include "mc/recordings/measured_features.hpp"
#include "mc/study/study.hpp"

namespace gearpod::mc {

struct PopulationFeature {
    std::string name;
    analysis::Alarm alarm = analysis::Alarm::high;
    double threshold = 0.0;
    long threshold_count = 0;  // number of healthy gearboxes that set the threshold
    // Values of these and of test gearboxes without a fault, ascending.
    std::vector<double> healthy;
    double least = kNan, most = kNan;  // of these and of the faulty ones
    double auc = 0.0;                  // NaN without faulty gearboxes
};

struct Population {
    std::string file;
    bool is_measured = false;  // false: simulated
    double noise_level = 1.0;
    double false_alarm_rate = 0.0;
    std::vector<PopulationFeature> features;  // by descending AUC
};

// Reads the population at one of the file's noise levels. Throws std::runtime_error naming the file
// if it is not a results file, has other tooth numbers than the study (`teeth`), lacks the noise
// level, or has no healthy gearboxes.
Population read_population(const std::string& path, double noise_level,
                           const MemberArray<int>& teeth);

// Comparison of one feature.
struct AlarmDecision {
    const PopulationFeature* population = nullptr;
    double value = 0.0;
    bool alarm = false;
    double margin = 0.0;    // relative distance beyond the threshold; negative: no alarm
    long less_extreme = 0;  // number of healthy gearboxes with a less extreme value
};

// Comparison of one recording with a population, into which the decisions point. The decisive
// feature comes first.
struct PopulationDecisions {
    std::vector<AlarmDecision> decisions;
    // Reason why simulated gearboxes do not describe the recording's machine, so that no alarm is
    // decided, or "": its level, sensor_rms, lies 3 times outside of theirs, healthy or faulty.
    std::string mismatch;
    std::string sentence;  // on the decisive feature and the teeth with the largest vibration
};

// Compares the features that both recording and population have, in the population's order.
// `feature` decides; "": the best ranked one. `measured` has the values of `features`, NaN: no
// value. Throws std::runtime_error if there is no common feature, or not the named one.
PopulationDecisions decide(const Population& population, const std::string& recording,
                           std::span<const features::Feature* const> features,
                           const std::vector<double>& measured, const std::string& feature,
                           const std::vector<WorstTooth>& teeth);

std::vector<double> values_of(const std::vector<MeasuredFeature>& measured);

}  // namespace gearpod::mc
