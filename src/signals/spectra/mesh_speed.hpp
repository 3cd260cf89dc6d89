// Whether the mesh lines of a signal lie where its mesh phase says.
//
// In steady running all lines of a gearbox are multiples of the carrier's turn (of the wheel's, of
// a fixed-shaft pair), those of a mesh crowding around the multiples k of the mesh frequency. A
// comb of these, stretched by `ratio`, is laid over the lines that stand out of the spectrum; where
// it fits best is the speed of the signal over the one that was assumed. A stretch by a tooth of
// the comb lays the lines of k = 1 on their neighbours, but those of its harmonics k teeth away,
// where there is less; with few harmonics such a ratio may fit nearly as well, and is told.
#pragma once

#include <optional>
#include <span>

namespace gearpod::signals {

struct MeshSpeed {
    double ratio = 1.0;   // of the speed that the lines fit best to the assumed one
    double fit = 0.0;     // share of the lines' amplitudes that the comb covers there
    double stated = 0.0;  // and at a ratio of 1
    double other = 0.0;   // another ratio that fits nearly as well; 0: none
    int harmonics = 0;    // that have lines
};

// `samples`: evenly spaced in mesh phase, `per_mesh` a mesh period; `turn_meshes`: mesh periods of
// a turn. Looks for ratios from 0.94 to 1.06. Empty if there is too little to say it by: fewer than
// four turns, fewer than three harmonics with lines, or lines that fit nowhere.
std::optional<MeshSpeed> mesh_speed(std::span<const double> samples, int per_mesh, int turn_meshes);

}  // namespace gearpod::signals
