// Time-synchronous averages and folds of a signal on the mesh-phase grid.
//
// A turn of a gear with T teeth (relative to the carrier) is T mesh periods, T P samples. Turns are
// superimposed sample by sample: McFadden's windowed average of an epicyclic gear, as in Liang
// (2016), section 5.3, with every mesh mapped to its tooth.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "signals/tile_signals.hpp"

namespace gearpod::signals {

// Mean over the whole turns of `bins` samples at the start of `samples`: bins values. Throws
// std::invalid_argument if there is no whole turn.
std::vector<double> synchronous_average(std::span<const double> samples, std::size_t bins);

// Sums over the same turns of the products of two signals of equal length, and of the squares of
// one (folded_signal.hpp). Throw likewise.
std::vector<double> fold_of_products(std::span<const double> a, std::span<const double> b,
                                     std::size_t bins);
std::vector<double> fold_of_squares(std::span<const double> samples, std::size_t bins);

// Root mean square, over the same turns, of the signal minus its average. The average contains all
// lines at whole multiples of the turn frequency. Throws likewise.
double rms_without_average(std::span<const double> samples, std::size_t bins);

// Time-synchronous average of the transmission error over planet turns relative to the carrier:
// Park et al. (2016), section IV-A. One planet turn has Z_p meshes, and the span has Z_r turns.

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
