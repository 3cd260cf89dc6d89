// Tones of other machines in a sensor's signal.
#pragma once

#include <cmath>
#include <span>

#include "machine/instruction_sets.hpp"
#include "machine/lanes.hpp"
#include "signals/tile_signals.hpp"

namespace gearpod::signals {

// y plus one tone. The arguments are sine and cosine of the tone's angle at the mesh, and A sin and
// A cos of its angle at the phase (ToneTable).
GEARPOD_INLINE double plus_tone(double y, double mesh_sine, double mesh_cosine, double phase_sine,
                                double phase_cosine) {
    return std::fma(mesh_cosine, phase_sine, std::fma(mesh_sine, phase_cosine, y));
}

// Interfering tones that the rest of the machine adds to the accelerometer signal. Liang (2016),
// Table 5.1, lists those of his two-stage rig: drive motor 20 Hz, bevel mesh 360 Hz, first stage's
// sun 5 Hz, planet 1.9 Hz, mesh 118.2 Hz, and their harmonics. The sample of mesh k at phase p/P
// gains
//
//     sum over the tones of A sin(2 pi f (k + p/P) T_m + phi),
//
// where A is the amplitude after the sensor's low-pass.
//
// A tone does not repeat with the meshes, so its folded squares need every sample of the span. Its
// angle splits into a mesh part and a phase part, whose phasors are tabulated. A sample costs two
// fused multiply-adds per tone; a gearbox without tones has no extra cost.

// Tones of a tile's gearboxes. Every lane has the same number of tones.
struct Tones {
    machine::AlignedVector mesh_period_s;   // [lane]
    machine::AlignedVector frequency_Hz;    // [tone][lane]
    machine::AlignedVector amplitude_m_s2;  // [tone][lane]
    machine::AlignedVector phase_rad;       // [tone][lane], at the start of the span

    bool empty() const { return frequency_Hz.empty(); }
};

// Phasors of a tile's tones over the meshes and the phases of a span.
class ToneTable {
  public:
    // Throws std::invalid_argument unless the arrays have the shapes above for that many lanes.
    ToneTable(const Tones& tones, int lanes, int first_mesh, int meshes, int phases);

    int tones() const { return tones_; }
    // [tone][mesh][lane]: sin and cos of 2 pi f k T_m.
    const double* mesh_sine() const { return mesh_sine_.data(); }
    const double* mesh_cosine() const { return mesh_cosine_.data(); }
    // [p][tone][lane]: A sin and A cos of 2 pi f (p/P) T_m + phi.
    const double* phase_sine() const { return phase_sine_.data(); }
    const double* phase_cosine() const { return phase_cosine_.data(); }

  private:
    int tones_;
    machine::AlignedVector mesh_sine_, mesh_cosine_, phase_sine_, phase_cosine_;
};

// Adds the tones of one lane to its samples [k * P + p] of whole mesh periods, P = phases.
void add_tones(const Tones& tones, int lane, int phases, std::span<double> samples);

}  // namespace gearpod::signals
