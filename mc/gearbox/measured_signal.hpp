// A measured signal on the mesh-phase grid of a study.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "mc/scene/scene.hpp"

namespace gearpod::mc {

// What is made of the mesh lines' own speed (signals/spectra/mesh_speed.hpp).
enum class SpeedCheck {
    refuse,  // a recording whose lines fit another speed clearly better
    follow,  // take that speed
    ignore,
};

// Which columns of a signal file to take; "" for those that it may do without.
struct SignalColumns {
    std::string sensor;                   // by default "sensor", if there is one
    std::string te;                       // by default "te", if there is one
    double sampling_Hz = 0.0;             // 0: from the file
    double samples_per_mesh = 0.0;        // of a recording sampled evenly in mesh phase; 0: in time
    std::optional<std::size_t> row = {};  // of a file with a record in each row
    std::string sensor_unit = {};         // where the file says none; "": m/s^2
    std::string tachometer = {};  // pulses of the member whose speed the study gives; "": none
    double pulses_per_turn = 1.0;
    std::string encoder = {};  // angle of that member; "": none
    SpeedCheck speed = SpeedCheck::refuse;
};

struct MeasuredSignal {
    // The mesh periods that features look at, as many as there are of them.
    std::vector<double> sensor;               // m/s^2, P a mesh period
    std::vector<double> te;                   // rad, P_te a mesh period
    bool has_sensor = false, has_te = false;  // whether there is such a column, however short
    int sensor_meshes = 0, te_meshes = 0;     // whole mesh periods of the recording
    std::string tracking;                     // how the samples got their mesh phase
    // Whether samples that were lost without a trace in its times would have been noticed.
    bool losses_noticed = true;
};

// Reads a file (signal_file.hpp) and resamples it where it is not on the grid already. A sample's
// mesh phase comes from
//
//     samples_per_mesh     as many samples in each mesh period; whole planet turns are taken for
//                          averages, which go on from their beginning
//     column mesh_phase    mesh periods
//     a tachometer         its pulses, counted; what is not between the first and the last is cut
//     an encoder           its angle, unwrapped
//     column speed_rpm     of the member whose speed the study gives, integrated over the time
//     otherwise            the study's speed, which is then constant
//
// and its time from sampling_Hz, the column time (s), or the rate that the file tells.
// Units are converted (signal_units.hpp); unknown ones are problems, as are missing and clipped
// samples (sample_times.hpp, signals/spectra/lost_samples.hpp), and a speed that the mesh lines do
// not fit. Throws SignalError with
// every problem, one a line. May be called by several threads: one reads at a time.
MeasuredSignal read_measured_signal(const std::string& path, const SignalColumns& columns,
                                    const Scene& scene);

}  // namespace gearpod::mc
