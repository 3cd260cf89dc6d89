// Signal of every pair of distinct mesh and carrier index, the first step of both folds
// (folded_signal.hpp).
#pragma once

#include "signals/path/path_weights.hpp"
#include "signals/windowing/folded_signal.hpp"

namespace gearpod::signals {

// Evaluates y^2 or y of one mesh's pairs at phase p. The accelerations stay in registers over the
// carrier indices.
template <int N, int W, bool kSquared>
GEARPOD_INLINE void evaluate_pairs(const FoldArguments& a, long p, int mesh,
                                   double* pairs_of_phase) {
    const FoldPlan::Pairs& pairs = a.plan->pairs();
    const double* sine = a.path->sine() + p * a.path->positions();
    const double* cosine = a.path->cosine() + p * a.path->positions();
    alignas(64) double accel[2 * N * W];
    for (int i = 0; i < 2 * N * W; ++i) {
        accel[i] = a.accel[mesh][p * 2 * N * W + i];
    }
    for (long q = pairs.first[mesh]; q < pairs.first[mesh + 1]; ++q) {
        const long c = pairs.carrier[q];
        const double* __restrict weight = a.weight + c * N * W;
        double* __restrict pair = pairs_of_phase + q * W;
#pragma omp simd
        for (int l = 0; l < W; ++l) {
            const double y = resultant<N, W>(accel, weight, sine[c], cosine[c], l);
            pair[l] = kSquared ? y * y : y;
        }
    }
}

// Evaluates all pairs at `count` phases from p on. Only this part of the kernels is compiled for
// each number of planets; the folding of the pairs is compiled once.
template <int W, bool kSquared>
GEARPOD_INLINE void evaluate_phases(const FoldArguments& a, long p, long count) {
    const long pairs = static_cast<long>(a.plan->pairs().carrier.size());
    with_planets(
        a.path->planets(), [&]<int N>() __attribute__((always_inline)) {
            for (long b = 0; b < count; ++b) {
                path_weights<N, W>(*a.path, p + b, a.exponent, a.whole_steps, a.weight);
                for (int mesh = 0; mesh <= a.plan->largest_mesh(); ++mesh) {
                    evaluate_pairs<N, W, kSquared>(a, p + b, mesh, a.pairs + b * pairs * W);
                }
            }
        });
}

}  // namespace gearpod::signals
