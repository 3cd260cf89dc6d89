// Time-synchronous averages and folds of a signal on the mesh-phase grid.
//
// A turn of a gear with T teeth (relative to the carrier) is T mesh periods, T P samples. Turns are
// superimposed sample by sample: McFadden's windowed average of an epicyclic gear, as in Liang
// (2016), section 5.3, with every mesh mapped to its tooth.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

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

}  // namespace gearpod::signals
