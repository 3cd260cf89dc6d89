// Records of every gearbox: the signals that are integrated, their samples, and the records that
// are cut from them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "mc/plan/feature_plan.hpp"
#include "mc/plan/gearbox_plan.hpp"
#include "mc/study/study.hpp"
#include "signals/tile_signals.hpp"

namespace gearpod::mc {

struct SensorPlan;  // sensor_plan.hpp

// Length of a record if it is not the span, in seconds or in turns of the carrier. `section` is
// that of the keys record_s and record_turns.
struct RecordLength {
    std::string section;
    std::optional<double> seconds, carrier_turns;

    bool given() const { return seconds || carrier_turns; }
    const char* key() const { return seconds ? "record_s" : "record_turns"; }
    std::string text() const;  // "10 s"
};
// Length of the records of `run`, from [sensor], and of the recordings of `lives`, from [life] or
// else from [sensor].
RecordLength record_length(const Study& study);
RecordLength life_record_length(const Study& study);

// Number of whole turns of the monitored gear in a record at this mesh frequency; may be 0. The
// length must be given.
int whole_turns(const RecordLength& length, const signals::SpanLayout& span,
                double mesh_frequency_Hz);
// Throws SceneError if a record of this length has fewer than kLeastRecordTurns turns, or if it is
// given in turns of a carrier that stands still.
void check_record_length(const RecordLength& length, const signals::SpanLayout& span,
                         double mesh_frequency_Hz);

struct RecordPlan {
    // Span after which every tooth of the monitored gear has met every tooth of its mate that it
    // can meet.
    signals::SpanLayout span;
    double mesh_frequency_Hz = 0.0;   // nominal, with the sign of Drivetrain
    int samples = 0, te_samples = 0;  // per mesh period, of the sensor and of the encoders
    // Sources of vibration whose acceleration is recorded, and how many of them are planets; one in
    // a fixed-shaft gearbox.
    int sources = 0, planet_sources = 0;
    // Mesh periods of sensor signal from which records are taken: the span, or more for the teeth
    // of the sun or the ring, or the span and a record of given length.
    int signal_meshes = 0;
    // Mesh periods that are recorded individually where every mesh period is integrated. If these
    // are fewer than those of the signal, they repeat.
    int recorded_meshes = 0;
    std::optional<RecordLength> length;  // empty: records are the whole signal
    // Samples that the records and the stages of the sensors need, whatever the features need.
    SampleNeed samples_needed = SampleNeed::none;
    // Number of successive gearboxes of a group whose records are the same window of their signals,
    // and of those whose records are computed together because their windows or the positions of
    // their coupled stages are the same; 1: none.
    std::uint64_t same_window = 1, same_positions = 1;
    // Number of baseline records that are averaged, 0 if no feature compares with the baseline, and
    // of those that are computed: one if their motion is the same.
    std::size_t baselines = 0, computed_baselines = 0;
    std::vector<double> noise_levels;
    std::uint64_t seed = 0;  // of the random windows and the noise
    std::shared_ptr<const Drivetrain> drivetrain;

    // Number of mesh periods after which the transmission path repeats; 1 if the carrier is fixed.
    int path_meshes() const { return span.carrier_meshes; }
    // Mesh period, and mean time between samples, of a gearbox with these inputs, s.
    double mesh_period_s(const InstanceInputs& inputs) const;
    double sample_s(const InstanceInputs& inputs) const { return mesh_period_s(inputs) / samples; }
    // Number of samples in a turn of the monitored gear.
    std::size_t turn_samples() const;
    // Number of mesh periods of sensor samples that must be computed for features with these needs;
    // 0: sensors are evaluated by the folded squares of their windows alone.
    int sensor_meshes(features::SignalSet needs) const;
    // Number of turns in a record of a gearbox with these inputs. It follows from the gearbox's
    // speed, but is at least kLeastRecordTurns. Requires a length.
    int turns(const InstanceInputs& inputs) const;
};

// Plan of a study's records with these numbers of samples per mesh period. Throws SceneError if
// features need longer records.
RecordPlan make_record_plan(const Study& study, const GearboxPlan& gearbox,
                            const FeaturePlan& features, std::span<const SensorPlan> sensors,
                            int samples, int te_samples);

// Length of a record at nominal speed, for example "10 s, 7 turns of 39 mesh periods".
std::string record_length_text(const RecordPlan& plan);
// Gears of a planetary stage whose single teeth records of given length show, and those that need
// longer ones; otherwise empty.
std::string shown_teeth_text(const RecordPlan& plan, const FeaturePlan& features);
// Records in words; "" without gears.
struct RecordFacts {
    std::string conditions;  // their length, and the teeth that meet in one
    std::string longer;      // next step if they are shorter than by default, otherwise ""
};
RecordFacts record_facts(const Study& study);

}  // namespace gearpod::mc
