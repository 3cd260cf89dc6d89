// Kernels of SensorResponse, and for one lane of synthesize. See sensor_signal.hpp and
// sensor.hpp.
#pragma once

#include "signals/noise/tones.hpp"
#include "signals/path/transmission_path.hpp"

namespace gearpod::signals {

// Path weights weight[c][p][n][lane] of a tile's gearboxes at every sample of a carrier turn.
struct PathWeights {
    const PathGrid* path = nullptr;
    const double* exponent = nullptr;  // [lane]
    double* whole_steps = nullptr;     // scratch, [M_c/2 + 1][lane]
    double* turn = nullptr;            // scratch, [c][n][lane]
    double* weight = nullptr;
};
void sensor_path_weights(int lanes, const PathWeights& a);

// Sensor response of a tile in one mesh period.
struct SensorResponseArguments {
    const PathGrid* path = nullptr;
    const double* weight = nullptr;    // at its carrier index, [p][n][lane]
    const double* accel = nullptr;     // [p][channel][lane]
    int sources = 0;                   // two channels each; the path's begin with its first source
    const ToneTable* tones = nullptr;  // null without tones
    int mesh = 0;                      // index of the mesh in `tones`, which has `meshes` meshes
    int meshes = 0;
    int carrier = 0;           // carrier index c
    double* signal = nullptr;  // [p][lane], m/s^2
    double* folded = nullptr;  // [p][lane], to which the squared signal is added; or null
};
void sensor_response(int lanes, const SensorResponseArguments& a);

// The same for one lane, in every build.
void path_weights_of_one_lane(const PathWeights& a);
void sensor_response_of_one_lane(const SensorResponseArguments& a);

}  // namespace gearpod::signals
