// The squared sensor signal folded modulo one planet turn.
//
// Windows repeat every Z_p meshes, so the energy of a windowed tooth signal needs only
//
//     F_b = sum over the Z_r planet turns i of y(mesh j + i Z_p, phase p/P)^2,    b = j P + p,
//
// never the Z_p Z_r P samples themselves. A sample depends on the distinct mesh (TileSignals) and
// on the carrier's mesh index k mod M_c alone, so each such pair is evaluated once and the folds
// are sums over pairs; teeth that see the same pairs share one sum. With a planet crack and the
// ring fixed, for one, each tooth meets every carrier index once: E + 1 different sums in all.
#pragma once

#include <span>

#include "signals/noise/tones.hpp"
#include "signals/path/transmission_path.hpp"
#include "signals/tile_signals.hpp"
#include "signals/windowing/fold_plan.hpp"

namespace gearpod::signals {

// F in (m/s^2)^2, [b][lane], Z_p P bins, for every lane's path exponent (1/rad^2, one per lane).
// A lane's values do not depend on its neighbours, and are the same bits for 8 lanes, 4 and 1.
// Throws std::invalid_argument if the shapes disagree.
void fold_squares(const TileSignals& tile, const FoldPlan& plan, const PathGrid& path,
                  std::span<const double> path_exponent, machine::AlignedVector& folded);

// The same for the signal with tones: a pass over all samples of the span, unless there are none.
void fold_squares(const TileSignals& tile, const FoldPlan& plan, const PathGrid& path,
                  std::span<const double> path_exponent, const Tones& tones,
                  machine::AlignedVector& folded);

}  // namespace gearpod::signals
