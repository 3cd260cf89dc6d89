// Vibration separation: one averaged turn for each planet, assembled from windows around its
// passages of the sensor. P. D. McFadden, J. Sound Vib. 144 (1991) 163-172; I. M. Howard, Proc.
// Australian Vibration and Noise Conf. (1990) 171-178.
//
// A planet passes the sensor once per carrier turn of M_c mesh periods. Its mesh is then the
// nearest one, and its window shows one tooth. The next passage shows the tooth M_c further, and
// Z_p passages show every tooth once if Z_p and M_c have no common divisor.
#pragma once

#include <span>
#include <vector>

#include "signals/tile_signals.hpp"

namespace gearpod::signals {

// Averaged turn of Z_p P samples of every planet, with planets at equal distances. Windows are
// periodic Hann windows two mesh periods wide, so that those of successive teeth add up to 1. The
// first sample of the first window maximises the windows' energy over all planets and carrier
// turns; of equal ones it is the first. Planets are in the order of their windows.
//
// `samples` begins at any position and has P samples per mesh period. The largest number of carrier
// turns is used that is a multiple of Z_p. Empty if there are fewer than Z_p turns, if the carrier
// stands still or if some teeth never pass. `span` gives Z_p and M_c.
std::vector<std::vector<double>> planet_averages(std::span<const double> samples,
                                                 const SpanLayout& span, int planets, int per_mesh);

}  // namespace gearpod::signals
