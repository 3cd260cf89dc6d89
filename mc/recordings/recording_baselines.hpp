// Baselines of gearboxes from a list of recordings: per gearbox and operating condition, the mean
// of several aligned healthy recordings.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "mc/recordings/manifest.hpp"
#include "mc/recordings/measured_features.hpp"

namespace gearpod::mc {

struct BaselineOptions {
    // Number of first healthy recordings of each gearbox that form its baseline, unless the
    // manifest marks them (column baseline). 0: none.
    int records = 0;
    // Operating conditions; recordings with equal values of all of them share a baseline.
    std::vector<std::string> conditions;
    bool scaled = false;  // the baseline is scaled to each recording (MeasuredBaseline)
    int average = 1;      // number of consecutive recordings that are averaged before features

    // True if recordings are compared with a mean of others, or averaged.
    bool any(const RecordingList& list) const;
};

// Mean of signals of equal length; there must be one.
std::vector<double> mean_signal(const std::vector<std::span<const double>>& signals);

// Problems with these options for this list. `manifest` names the table.
Problems baseline_problems(const BaselineOptions& options, const RecordingList& list,
                           const std::string& manifest, bool has_baseline_file);

// Recordings of one gearbox at one operating condition.
struct RecordingGroup {
    std::string name;                     // "baseline of gearbox A at load 20", for messages
    std::vector<std::size_t> recordings;  // by time, or in the list's order without times
    std::vector<std::size_t> chosen;      // those of the baseline
};
std::vector<RecordingGroup> recording_groups(const BaselineOptions& options,
                                             const RecordingList& list);

// Mean of the aligned baseline recordings of one group.
//
// Every recording is shifted to the largest circular correlation with the mean in the angle domain,
// between samples (signals/spectra/alignment.hpp). The mean is formed twice: from shifts to the
// recording that resembles the others most, then from shifts to this first mean. Recordings whose
// correlation is below 0.2 or below half of the median are left out.
class GroupBaseline {
  public:
    // An earlier recording in place of the mean.
    explicit GroupBaseline(MeasuredBaseline given);
    // `signals`: one for each of group.chosen; an empty one was not readable. Adds statements on
    // recordings left out to `notes`. At least two must remain; otherwise refusal() is the reason.
    GroupBaseline(const RecordingGroup& group, const RecordingList& list,
                  const std::vector<MeasuredSignal>& signals, const RecordPlan& plan, bool scaled,
                  std::vector<std::string>& notes);

    const std::string& refusal() const { return refusal_; }
    std::size_t members() const { return members_.size(); }
    double least_correlation() const { return least_correlation_; }
    // Mean of all recordings of the baseline except those listed, so that no recording is compared
    // with itself.
    MeasuredBaseline without(std::span<const std::size_t> recordings) const;
    // Planet turns of the baseline in a recording, shifted to it. Throws SignalError as
    // measured_change().
    AlignedSensor aligned(const MeasuredSignal& record, const RecordPlan& plan) const;

  private:
    struct Member {
        std::size_t recording = 0;
        std::vector<double> sensor;
        double rounding = 0.0;
    };
    MeasuredBaseline mean_;  // of all members, or the given recording
    std::vector<Member> members_;
    double least_correlation_ = 1.0;  // of the members with the mean
    std::string refusal_;
};

}  // namespace gearpod::mc
