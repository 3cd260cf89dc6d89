// What a march hands to the signals: the distinct mesh periods of a tile of gearboxes and the order
// in which they follow each other.
//
// With steady load and speed a linear gearbox repeats every mesh; a damaged tooth is an event that
// leaves the healthy orbit and decays back to it. A handful of distinct mesh periods (0: healthy,
// 1..E: the meshes of the event) therefore stands for the Z_p Z_r meshes that windowing looks at.
#pragma once

#include <span>
#include <vector>

#include "machine/lanes.hpp"

namespace gearpod::signals {

// The meshes looked at: every tooth of a planet meets every tooth of the ring once.
struct SpanLayout {
    int planet_teeth = 0;    // Z_p
    int ring_teeth = 0;      // Z_r, the planet turns (relative to the carrier) in the span
    int carrier_meshes = 1;  // M_c, meshes per carrier turn: Z_r ring fixed, Z_s sun fixed;
                             // 1: the carrier stands still

    int meshes() const { return planet_teeth * ring_teeth; }
};

// Which distinct mesh the k-th mesh of the repeating pattern holds: Z_p meshes for a planet crack,
// Z_s sun, Z_r ring, 1 healthy. Mesh k of the span holds timeline[k mod size].
using Timeline = std::vector<int>;

// Views of the recorded mesh periods; the arrays belong to the march.
struct TileSignals {
    int lanes = 0;    // W, 16, 8, 4 or 1
    int planets = 0;  // N
    int phases = 0;   // P, samples per mesh period, at phases p/P

    // m/s^2, one array [p][channel][lane] per distinct mesh: low-pass filtered; channel 2n, 2n+1
    // are the components of planet n's absolute acceleration along the carrier frame's x and y
    // axes.
    std::vector<const double*> accel;
    std::vector<const double*> te;  // rad, one array [p][lane] per distinct mesh

    int channels() const { return 2 * planets; }
    int meshes() const { return static_cast<int>(accel.size()); }
};

// One lane of a lane-interleaved array, contiguous: out[i] = interleaved[i * lanes + lane].
void copy_lane(std::span<const double> interleaved, int lanes, int lane, std::span<double> out);

// The lanes from `first` on, one after the other: out[n * values + i] is lane first + n's i-th of
// `values` values. Reads the array once for all of them.
void copy_lanes(std::span<const double> interleaved, int lanes, int first, std::span<double> out);

// Throws std::invalid_argument, saying what is wrong, unless lanes are 16, 8, 4 or 1, planets 1..8,
// phases positive, every mesh has both arrays, and the timeline names only recorded meshes.
void check_tile(const TileSignals& tile, const Timeline& timeline);

}  // namespace gearpod::signals
