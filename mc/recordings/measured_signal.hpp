// Measured signal on the mesh-phase grid of a study.
#pragma once

#include <string>
#include <vector>

#include "mc/recordings/recording_columns.hpp"
#include "mc/scene/scene.hpp"

namespace gearpod::mc {

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
// (sample_times.hpp, signals/spectra/lost_samples.hpp), and a speed that does not fit the mesh
// lines. Throws SignalError with one line per problem. Thread-safe: one thread reads at a time.
MeasuredSignal read_measured_signal(const SignalSource& source, const SignalColumns& columns,
                                    const Scene& scene);

}  // namespace gearpod::mc
