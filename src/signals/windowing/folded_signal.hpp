// Squares of the sensor signal, folded modulo one planet turn.
#pragma once

#include <span>
#include <vector>

#include "signals/noise/tones.hpp"
#include "signals/path/transmission_path.hpp"
#include "signals/tile_signals.hpp"

namespace gearpod::signals {

// Samples that have to be evaluated, and those that each planet tooth sums. A plan depends on the
// timeline only and serves any number of tiles.
class FoldPlan {
  public:
    // Throws std::invalid_argument if the layout has no meshes or the timeline is empty or
    // negative.
    FoldPlan(const Timeline& timeline, const SpanLayout& layout);

    // Pairs first[m]..first[m + 1] - 1 belong to distinct mesh m, at carrier indices carrier[q].
    struct Pairs {
        std::vector<int> first;
        std::vector<int> carrier;
    };
    // Sums of squares. Entries first[s]..first[s + 1] - 1 of sum s are pairs with their numbers of
    // occurrences.
    struct Sums {
        std::vector<int> first;
        std::vector<int> pair;
        std::vector<double> count;
    };

    const Pairs& pairs() const { return pairs_; }
    const Sums& sums() const { return sums_; }
    const std::vector<int>& sum_of_tooth() const { return sum_of_tooth_; }  // Z_p
    const std::vector<int>& pair_of_mesh() const { return pair_of_mesh_; }  // Z_p Z_r, of the span
    const SpanLayout& layout() const { return layout_; }
    int largest_mesh() const { return largest_mesh_; }

  private:
    SpanLayout layout_;
    int largest_mesh_ = 0;
    Pairs pairs_;
    Sums sums_;
    std::vector<int> sum_of_tooth_;
    std::vector<int> pair_of_mesh_;
};

// Kernels of fold_squares, without and with tones.

// Number of phases whose tones are added together.
inline constexpr int kTonePhases = 4;

// Input and output arrays of the kernels. Their shapes are those of TileSignals, PathGrid and
// FoldPlan, which must agree.
struct FoldArguments {
    const PathGrid* path = nullptr;
    const FoldPlan* plan = nullptr;
    const double* const* accel = nullptr;
    const double* exponent = nullptr;  // [lane]
    const ToneTable* tones = nullptr;  // over the whole span; null without tones
    double* whole_steps = nullptr;     // scratch, [M_c/2 + 1][lane]
    double* weight = nullptr;          // scratch, [carrier index][planet][lane]
    double* pairs = nullptr;   // scratch, [pair][lane]: y^2; with tones y, [phase][pair][lane]
    double* totals = nullptr;  // scratch, [sum][lane]
    double* folded = nullptr;  // [tooth * P + p][lane]
};

void fold_squares_without_tones(int lanes, const FoldArguments& a);
void fold_tones(int lanes, const FoldArguments& a);

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
