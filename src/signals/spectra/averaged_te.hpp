// Time-synchronous average of the transmission error over planet turns relative to the carrier:
// Park et al. (2016), section IV-A. One planet turn has Z_p meshes, and the span has Z_r turns.
#pragma once

#include "signals/tile_signals.hpp"

namespace gearpod::signals {

// Mean over the Z_r turns, rad, [j * P_te + p'][lane], with the mean of each lane removed. Encoders
// take te_phases = P_te samples of the tile's P per mesh period. Throws std::invalid_argument if
// the shapes disagree or P_te does not divide P.
void average_te(const TileSignals& tile, const Timeline& timeline, const SpanLayout& layout,
                int te_phases, machine::AlignedVector& te_turn);

// Adds `share` times one mesh period's te[p][lane] at the encoders' phases to sum[p'][lane].
void add_te_mesh(std::span<const double> te, double share, int te_phases, std::span<double> sum);

// Subtracts its mean from each lane of values[..][lane].
void remove_lane_means(machine::AlignedVector& values, int lanes);

}  // namespace gearpod::signals
