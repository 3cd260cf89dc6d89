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
