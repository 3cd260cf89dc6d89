// Time-synchronous average of the transmission error over planet turns relative to the carrier:
// Park et al. (2016), section IV-A. One planet turn is Z_p meshes; Z_r turns make the span.
#pragma once

#include "signals/tile_signals.hpp"

namespace gearpod::signals {

// rad, [j * P_te + p'][lane]: the mean over the Z_r turns, each lane's own mean removed. Encoders
// take te_phases = P_te samples of the tile's P per mesh period. Throws std::invalid_argument if
// the shapes disagree or P_te does not divide P.
void average_te(const TileSignals& tile, const Timeline& timeline, const SpanLayout& layout,
                int te_phases, machine::AlignedVector& te_turn);

// Adds a share of one mesh period's te[p][lane] at the encoders' phases to sum[p'][lane].
void add_te_mesh(std::span<const double> te, double share, int te_phases, std::span<double> sum);

// Takes from each lane of values[..][lane] its own mean.
void remove_lane_means(machine::AlignedVector& values, int lanes);

}  // namespace gearpod::signals
