// Change of a measured gearbox since an earlier recording of it.
#pragma once

#include "mc/recordings/measured_signal.hpp"

namespace gearpod::mc {

struct MeasuredChange {
    // Difference of the two sensor signals, over the planet turns that both have. No transmission
    // error.
    MeasuredSignal signal;
    // Mesh periods by which the baseline was shifted to align it with the recording. Only
    // recordings of the whole span or of one averaged planet turn are periodic and can be shifted.
    double meshes = 0.0;
    double correlation = 0.0;  // of both signals after alignment
};

// Throws SignalError if a recording has less than one planet turn of sensor signal, or if the
// correlation is below 0.2. `baseline_file` is the baseline's name in messages.
MeasuredChange measured_change(const Scene& scene, const MeasuredSignal& record,
                               const MeasuredSignal& baseline, const std::string& baseline_file);

}  // namespace gearpod::mc
