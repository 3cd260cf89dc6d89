// Results of the time integration that the signals are computed from: the distinct mesh periods of
// a tile of gearboxes and their order.
//
// With steady load and speed a linear gearbox repeats every mesh. A damaged tooth is an event that
// leaves the healthy periodic orbit and decays back to it. A handful of distinct mesh periods (0:
// healthy, 1..E: the meshes of the event) therefore represents the Z_p Z_r meshes of the windowing
// span.
#pragma once

#include <span>
#include <vector>

#include "machine/ids.hpp"
#include "machine/lanes.hpp"

namespace gearpod::signals {

// Span of meshes that is evaluated: every tooth of a planet meets every tooth of the ring once.
struct SpanLayout {
    int planet_teeth = 0;    // Z_p
    int ring_teeth = 0;      // Z_r, planet turns (relative to the carrier) in the span
    int carrier_meshes = 1;  // M_c, meshes per carrier turn: Z_r ring fixed, Z_s sun fixed;
                             // 1: stationary carrier

    int meshes() const { return planet_teeth * ring_teeth; }
};

// Distinct mesh of each mesh of the repeating pattern, which has Z_p meshes for a planet crack, Z_s
// for a sun crack, Z_r for a ring crack and 1 if healthy. Mesh k of the span is distinct mesh
// timeline[k mod size].
using Timeline = std::vector<int>;

// Views of the recorded mesh periods, whose arrays the integration owns.
struct TileSignals {
    int lanes = 0;    // W, 16, 8, 4 or 1
    int planets = 0;  // N
    int phases = 0;   // P, samples per mesh period, at phases p/P

    // Low-pass-filtered accelerations, m/s^2, one array [p][channel][lane] per distinct mesh.
    // Channels 2n and 2n+1 are the components of source n's absolute acceleration along the carrier
    // frame's x and y axes: of the planets, then of further sources.
    std::vector<const double*> accel;
    std::vector<const double*> te;  // rad, one array [p][lane] per distinct mesh
    int further_sources = 0;

    int sources() const { return planets + further_sources; }
    int channels() const { return 2 * sources(); }
    int meshes() const { return static_cast<int>(accel.size()); }
};

// Copies one lane of a lane-interleaved array: out[i] = interleaved[i * lanes + lane].
void copy_lane(std::span<const double> interleaved, int lanes, LaneId lane, std::span<double> out);

// Copies the lanes from `first` on, one after the other: out[n * values + i] is the i-th of the
// `values` values of lane first + n. Reads the array once for all of them.
void copy_lanes(std::span<const double> interleaved, int lanes, int first, std::span<double> out);

// Throws std::invalid_argument, with the reason, unless lanes are 16, 8, 4 or 1, planets 1..8,
// phases positive, every mesh has both arrays, and the timeline names only recorded meshes.
void check_tile(const TileSignals& tile, const Timeline& timeline);

}  // namespace gearpod::signals
