// Squared sensor signal folded modulo one planet turn.
//
// Windows repeat every Z_p meshes, so the energy of a windowed tooth signal needs only
//
//     F_b = sum over the Z_r planet turns i of y(mesh j + i Z_p, phase p/P)^2,    b = j P + p,
//
// not the Z_p Z_r P samples themselves. A sample depends only on the distinct mesh (TileSignals)
// and on the carrier's mesh index k mod M_c. Each such pair is evaluated once, the folds are sums
// over pairs, and teeth with the same pairs share one sum. With a planet crack and a fixed ring,
// for example, each tooth meets every carrier index once, which gives E + 1 different sums.
#pragma once

#include <span>

#include "signals/noise/tones.hpp"
#include "signals/path/transmission_path.hpp"
#include "signals/tile_signals.hpp"
#include "signals/windowing/fold_plan.hpp"

namespace gearpod::signals {

// Folded squares F in (m/s^2)^2, [b][lane], Z_p P bins, for the path exponent of every lane
// (1/rad^2). A lane's values do not depend on the other lanes, and have the same bits for any
// number of lanes. Throws std::invalid_argument if the shapes disagree.
void fold_squares(const TileSignals& tile, const FoldPlan& plan, const PathGrid& path,
                  std::span<const double> path_exponent, machine::AlignedVector& folded);

// Folded squares of the signal with tones. Tones require a pass over all samples of the span.
void fold_squares(const TileSignals& tile, const FoldPlan& plan, const PathGrid& path,
                  std::span<const double> path_exponent, const Tones& tones,
                  machine::AlignedVector& folded);

}  // namespace gearpod::signals
