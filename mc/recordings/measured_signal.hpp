// Measured signals on the mesh-phase grid of a study, and their change since a baseline.
#pragma once

#include <algorithm>
#include <span>
#include <string>
#include <vector>

#include "mc/plan/feature_plan.hpp"
#include "mc/plan/record_plan.hpp"
#include "mc/recordings/recording_columns.hpp"
#include "signals/spectra/alignment.hpp"

namespace gearpod::mc {

// Parts of a study's plan with which recordings are read and measured.
struct MeasurementPlan {
    const RecordPlan& record;
    const FeaturePlan& features;
    InstanceInputs nominal;  // inputs of every recorded gearbox, which are not known
};

struct MeasuredSignal {
    // Mesh periods that features use, as far as the recording has them.
    std::vector<double> sensor;               // m/s^2, P values per mesh period
    std::vector<double> te;                   // rad, P_te values per mesh period
    bool has_sensor = false, has_te = false;  // true if the column exists, however short
    int sensor_meshes = 0, te_meshes = 0;     // whole mesh periods of the recording
    double sensor_rounding = 0.0;             // rms rounding error of a sample, m/s^2
    std::string tracking;                     // source of the mesh phase of the samples
    // True if lost samples would have been detected even if the times do not show them.
    bool losses_detectable = true;
    // Statements of the file that are not used, and assumptions.
    std::vector<std::string> notes;

    // Number of whole planet turns of sensor signal that features of the planets' teeth can use, at
    // most the span's. With fewer turns, each tooth meets fewer ring teeth and is averaged less.
    int planet_turns(const signals::SpanLayout& span) const {
        return has_sensor ? std::min(sensor_meshes / span.planet_teeth, span.ring_teeth) : 0;
    }
};

// Reads a recording (signal_file.hpp) and resamples it unless it is on the grid already. The mesh
// phase of a sample comes from
//
//     samples_per_mesh     a constant number of samples per mesh period; whole planet turns
//                          count as averages and are continued periodically
//     column mesh_phase    mesh periods
//     a tachometer         its counted pulses; samples outside the first and last pulse are removed
//     an encoder           its unwrapped angle
//     column speed_rpm     speed of the member whose speed the study gives, integrated over time
//     otherwise            the constant speed of the study
//
// and its time from sampling_Hz, from the column time (s), or from the sampling rate in the file.
// Units are converted (signal_units.hpp). Problems are unknown units, missing and clipped samples
// (recording_columns.hpp, signals/spectra/recording_checks.hpp), and a speed that does not fit the
// mesh lines. Throws SignalError with one line per problem. Thread-safe: one thread reads at a
// time.
MeasuredSignal read_measured_signal(const SignalSource& source, const SignalColumns& columns,
                                    const MeasurementPlan& plan);

// Throws SignalError if the recording cannot be read or lacks a column that is needed. Takes no
// study, so that commands can check this before they prepare one.
void check_columns(const SignalSource& source, const SignalColumns& columns);

// A sensor signal aligned with another of the same gearbox.
struct AlignedSensor {
    std::vector<double> sensor;  // m/s^2
    // With the other signal after alignment, or of the lines that decided.
    double correlation = 0.0;
    signals::Shift shift;
};
// Moves a signal over this number of planet turns to the start of the other. Only the whole span
// and one averaged planet turn are periodic; other signals stay as they are. Over the whole span
// the lines of planet and partner decide if their correlation is 0.5 and higher by 0.05, so that
// stronger lines of other stages do not.
AlignedSensor aligned_with(std::span<const double> other, std::span<const double> signal, int turns,
                           const signals::SpanLayout& span);

// Change of a measured gearbox since an earlier recording of it.
struct MeasuredChange {
    // Difference of the two sensor signals, over the planet turns that both have. No transmission
    // error.
    MeasuredSignal signal;
    // Mesh periods by which the baseline was shifted to align it with the recording.
    double meshes = 0.0;
    double correlation = 0.0;  // of both signals after alignment
    double scale = 1.0;        // factor on the baseline before the subtraction
};

// Least correlation of a recording with its baseline.
inline constexpr double kLeastCorrelation = 0.2;

// Earlier recording of the gearbox in healthy condition, or the mean of several.
struct MeasuredBaseline {
    std::string file;  // its name in messages
    MeasuredSignal signal;
    // True if the baseline is multiplied by the factor that leaves the least change (least
    // squares). A gain that drifts then leaves no change; the part of a fault that resembles the
    // baseline does not either.
    bool scaled = false;
};

// Throws SignalError if a recording has less than one planet turn of sensor signal, or if the
// correlation is below kLeastCorrelation.
MeasuredChange measured_change(const RecordPlan& plan, const MeasuredSignal& record,
                               const MeasuredBaseline& baseline);

}  // namespace gearpod::mc
