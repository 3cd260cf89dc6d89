// Contribution of a tone to a sample. The folded signal and the time signal share it, so that both
// give the same bits.
#pragma once

#include <cmath>

#include "machine/dispatch.hpp"

namespace gearpod::signals {

// y plus one tone. The arguments are sine and cosine of the tone's angle at the mesh, and A sin and
// A cos of its angle at the phase (ToneTable).
GEARPOD_INLINE double plus_tone(double y, double mesh_sine, double mesh_cosine, double phase_sine,
                                double phase_cosine) {
    return std::fma(mesh_cosine, phase_sine, std::fma(mesh_sine, phase_cosine, y));
}

}  // namespace gearpod::signals
