// Time-synchronous averages and folds of a signal on the mesh-phase grid.
//
// A turn of a gear (relative to the carrier) with T teeth is T mesh periods, T P samples. Turns are
// laid on top of each other sample by sample: McFadden's windowed average of an epicyclic gear, as
// in Liang (2016), section 5.3, with every mesh mapped to its tooth.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace gearpod::signals {

// Mean over the whole turns of `bins` samples that `samples` begins with: bins values. Throws
// std::invalid_argument if there is none.
std::vector<double> synchronous_average(std::span<const double> samples, std::size_t bins);

// Sum over the same turns of the products of two signals as long as each other, and of squares
// (folded_signal.hpp). Throws likewise.
std::vector<double> fold_of_products(std::span<const double> a, std::span<const double> b,
                                     std::size_t bins);
std::vector<double> fold_of_squares(std::span<const double> samples, std::size_t bins);

// Root mean square, over the same turns, of what the average leaves: of the signal without all
// lines at whole multiples of that turn's frequency. Throws likewise.
double rms_without_average(std::span<const double> samples, std::size_t bins);

}  // namespace gearpod::signals
