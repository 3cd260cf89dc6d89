// Length of the records of a study, and of the signals from which they are taken.
#pragma once

#include <optional>
#include <string>

#include "mc/plan/feature_plan.hpp"
#include "mc/study/study.hpp"

namespace gearpod::mc {

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
int signal_meshes(const Study& study, const FeaturePlan& features, double mesh_frequency_Hz);

}  // namespace gearpod::mc
