// Kernels of fold_squares, without and with tones; see folded_signal.hpp.
#pragma once

#include "signals/noise/tones.hpp"
#include "signals/path/transmission_path.hpp"
#include "signals/windowing/fold_plan.hpp"

namespace gearpod::signals {

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

}  // namespace gearpod::signals
