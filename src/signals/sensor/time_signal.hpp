// The kernels behind synthesize; see sensor.hpp.
#pragma once

#include "signals/noise/tones.hpp"
#include "signals/path/transmission_path.hpp"

namespace gearpod::signals {

// Path weights of one gearbox at every sample of a carrier turn: weight[p][c][n]. `whole_steps` is
// scratch of M_c/2 + 1 values.
void all_path_weights(const PathGrid& path, double exponent, double* whole_steps, double* weight);

// signal[p] of one mesh period at carrier index c from accel[p][channel] of one gearbox.
void mesh_signal(const PathGrid& path, const double* weight, int c, const double* accel,
                 double* signal);

// Adds the tones of one gearbox to the samples of the table's mesh i out of `meshes`.
void add_tones(const ToneTable& table, int i, int meshes, int phases, double* signal);

}  // namespace gearpod::signals
