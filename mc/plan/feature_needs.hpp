// Features of a study, the length of the signals that they need, and the length of its records.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "features/feature.hpp"
#include "mc/study/study.hpp"
#include "signals/tile_signals.hpp"
#include "signals/windowing/vibration_separation.hpp"

namespace gearpod::mc {

// used_features(): features that a study uses, in its order. needs_of(): signals of its test
// records and of their changes that they need.
std::vector<const features::Feature*> used_features(const Study& study);
features::SignalSet needs_of(std::span<const features::Feature* const> features);

// Needs by the signal that they refer to: the test record, the baseline record, and the change
// between them.
struct ComparedNeeds {
    features::SignalSet record, baseline, change;
};
ComparedNeeds compared_needs(std::span<const features::Feature* const> features);

// True if features with these needs use the sensor's samples.
bool needs_samples(features::SignalSet needs);
// Smallest number of mesh periods of its signal that a feature needs.
int least_meshes(const features::Feature& feature, const Study& study,
                 const signals::SpanLayout& span);
// Number of mesh periods of sensor signal that features with these needs use.
int meshes_needed(const Study& study, const signals::SpanLayout& span, features::SignalSet needs);

// Number of a central gear's turns that fit into the span, or the smallest number that is enough.
signals::GearTurns central_turns(const signals::SpanLayout& span, int teeth);

// Length of a record if it is not the span, in seconds or in turns of the carrier. `section` is
// that of the keys record_s and record_turns.
struct RecordLength {
    std::string section;
    std::optional<double> seconds, carrier_turns;

    bool given() const { return seconds || carrier_turns; }
    const char* key() const { return seconds ? "record_s" : "record_turns"; }
    std::string text() const;  // "10 s"
};
// Length of the records of `run`, from [sensor]; has_record_length(): true if it is given.
// life_record_length(): length of the recordings of `lives`, from [life] or else from [sensor].
RecordLength record_length(const Study& study);
bool has_record_length(const Study& study);
RecordLength life_record_length(const Study& study);

// Smallest number of turns of the monitored gear in a record.
inline constexpr int kLeastRecordTurns = 3;
// Number of whole turns of the monitored gear in a record at this mesh frequency; may be 0. The
// length must be given.
int whole_turns(const RecordLength& length, const signals::SpanLayout& span,
                double mesh_frequency_Hz);
// Throws SceneError if a record of this length has fewer than kLeastRecordTurns turns, or if it is
// given in turns of a carrier that stands still.
void check_record_length(const RecordLength& length, const signals::SpanLayout& span,
                         double mesh_frequency_Hz);

// Number of mesh periods of the sensor signal from which the records of `run` are taken: those that
// the study's features need, or the span and a record. Throws SceneError if its features need
// longer records.
int signal_meshes(const Study& study, const signals::SpanLayout& span, double mesh_frequency_Hz);

}  // namespace gearpod::mc
