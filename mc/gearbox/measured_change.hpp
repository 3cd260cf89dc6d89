// What has changed in a measured gearbox since an earlier recording of it.
#pragma once

#include "mc/gearbox/measured_signal.hpp"

namespace gearpod::mc {

struct MeasuredChange {
    // The sensor's signal less the baseline's, over as many planet turns as both have; no
    // transmission error.
    MeasuredSignal signal;
    // Mesh periods by which the baseline was turned on to begin where the recording does; only
    // recordings of the whole span, or of one averaged planet turn, repeat and can be turned.
    double meshes = 0.0;
    double correlation = 0.0;  // of both, as they were then subtracted
};

// Without a sensor signal of a planet turn in both, or where they are not alike (a correlation
// below 0.2), throws SignalError with the reason; `baseline_file` names the baseline there.
MeasuredChange measured_change(const Scene& scene, const MeasuredSignal& record,
                               const MeasuredSignal& baseline, const std::string& baseline_file);

}  // namespace gearpod::mc
