// Sampling rate of a recording compared with the grid of a study.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "mc/plan/scene.hpp"
#include "mc/recordings/recording_columns.hpp"

namespace gearpod::mc {

struct RecordedSignals {
    bool sensor = false, te = false;
};

// Problems of the number of samples per mesh period: too few to resolve the mesh frequency or the
// sensor's frequency range, or so many that the study's grid would alias high frequencies. `phase`
// has the mesh phase of every sample.
std::vector<std::string> rate_problems(std::span<const double> phase, const Scene& scene,
                                       RecordedSignals has);

// Measured signal on the mesh-phase grid of a study.

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
// (recording_columns.hpp, signals/spectra/recording_checks.hpp), and a speed that does not fit the mesh
// lines. Throws SignalError with one line per problem. Thread-safe: one thread reads at a time.
MeasuredSignal read_measured_signal(const SignalSource& source, const SignalColumns& columns,
                                    const Scene& scene);

// Change of a measured gearbox since an earlier recording of it.

struct MeasuredChange {
    // Difference of the two sensor signals, over the planet turns that both have. No transmission
    // error.
    MeasuredSignal signal;
    // Mesh periods by which the baseline was shifted to align it with the recording. Only
    // recordings of the whole span or of one averaged planet turn are periodic and can be shifted.
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
MeasuredChange measured_change(const Scene& scene, const MeasuredSignal& record,
                               const MeasuredBaseline& baseline);

}  // namespace gearpod::mc
