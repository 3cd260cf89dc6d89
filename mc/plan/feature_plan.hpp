// Features of a study: the signals that they need, and how those are analysed.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "features/feature.hpp"
#include "mc/study/study.hpp"
#include "signals/tile_signals.hpp"
#include "signals/windowing/tooth_statistics.hpp"

namespace gearpod::mc {

// Samples of a sensor that are needed: none if the folded squares of its windows are enough, those
// of the span, or those of the whole signal.
enum class SampleNeed { none, span, signal };

// Needs by the signal that they refer to: the test record, the baseline record, and the change
// between them.
struct ComparedNeeds {
    features::SignalSet record, baseline, change;

    // Needs of the test record and of its change together.
    features::SignalSet all() const {
        features::SignalSet both = record;
        return both |= change;
    }
};
// If signals are `superposed`, a change needs no samples of the record and of the baseline.
ComparedNeeds compared_needs(std::span<const features::Feature* const> features,
                             bool superposed = false);

// True if features with these needs use the sensor's samples.
bool needs_samples(features::SignalSet needs);

// Smallest number of turns of the monitored gear in a record.
inline constexpr int kLeastRecordTurns = 3;

struct FeaturePlan {
    std::vector<const features::Feature*> used;  // in the order of the study
    std::vector<PythonFeature> python;           // all that the study defines, used or not
    ComparedNeeds needs;                         // of those used
    // Number of baseline records, which are averaged; 0 if no used feature compares with them.
    int baselines = 0;
    double tukey_taper = 0.0;  // of the windows of the teeth
    int te_harmonics = 0;      // mesh harmonics of the transmission error
    signals::SpanLayout span;
    MemberArray<int> teeth{};  // 0: the gearbox has no such member, or it has no teeth
    int planets = 0;           // 0 in a fixed-shaft gearbox
    // Turns of the central gears that fit into the span, or the smallest number that is enough;
    // empty in a fixed-shaft gearbox.
    std::optional<signals::GearTurns> sun, ring;
    // Number of mesh periods of sensor signal that the used features need.
    int signal_meshes = 0;
    double low_pass_Hz = 0.0;    // highest frequency of the sensor's signal
    int average_recordings = 1;  // consecutive measured recordings averaged before features
    bool sensor = true;          // false if the gearboxes are quasi-static: only encoders measure

    // Turns of the sun or the ring that features use in a signal of so many mesh periods: those of
    // the span, or as many as fit; 0 if it is too short.
    signals::GearTurns central_turns(Member gear, int meshes) const;
    // Number of mesh periods of sensor signal that features with these needs use at most.
    int meshes_needed(features::SignalSet with_needs) const;
    // Smallest number of mesh periods of its signal that a feature needs.
    int least_meshes(const features::Feature& feature) const;
};

FeaturePlan make_feature_plan(const Study& study, const signals::SpanLayout& span);

// Features that a study uses, in its order.
std::vector<const features::Feature*> used_features(const Study& study);

}  // namespace gearpod::mc
