// The kernels behind HeardSpan, and of one lane behind synthesize; see heard_span.hpp and
// sensor.hpp.
#pragma once

#include "signals/noise/tones.hpp"
#include "signals/path/transmission_path.hpp"

namespace gearpod::signals {

// weight[c][p][n][lane]: path weights of a tile's gearboxes at every sample of a carrier turn.
struct PathWeights {
    const PathGrid* path = nullptr;
    const double* exponent = nullptr;  // [lane]
    double* whole_steps = nullptr;     // scratch, [M_c/2 + 1][lane]
    double* turn = nullptr;            // scratch, [c][n][lane]
    double* weight = nullptr;
};
void heard_weights_1(const PathWeights& a);
void heard_weights_4(const PathWeights& a);
void heard_weights_8(const PathWeights& a);
void heard_weights_16(const PathWeights& a);

// One mesh period of a tile.
struct HeardMesh {
    const PathGrid* path = nullptr;
    const double* weight = nullptr;    // of its carrier index, [p][n][lane]
    const double* accel = nullptr;     // [p][channel][lane]
    const ToneTable* tones = nullptr;  // if any
    int mesh = 0;                      // place in that table, of so many:
    int meshes = 0;
    int carrier = 0;           // c
    double* signal = nullptr;  // [p][lane], m/s^2
    double* folded = nullptr;  // likewise: its squares are added to it; or null
};
void heard_mesh_1(const HeardMesh& a);
void heard_mesh_4(const HeardMesh& a);
void heard_mesh_8(const HeardMesh& a);
void heard_mesh_16(const HeardMesh& a);

}  // namespace gearpod::signals
