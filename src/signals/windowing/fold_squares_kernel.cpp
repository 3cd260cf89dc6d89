#include "machine/instruction_sets.hpp"
#include "signals/windowing/fold_pairs.hpp"

namespace gearpod::signals {
namespace {

// Computes sum s over its pairs. Four partial sums make consecutive additions independent.
template <int W>
GEARPOD_INLINE void sum_pairs(const FoldArguments& a, long s) {
    const int* pair = a.plan->sums().pair.data();
    const double* count = a.plan->sums().count.data();
    const int end = a.plan->sums().first[s + 1];
    int e = a.plan->sums().first[s];
    alignas(64) double partial[4][W] = {};
    for (; e + 4 <= end; e += 4) {
        for (int i = 0; i < 4; ++i) {
            const double* __restrict square = a.pairs + long{pair[e + i]} * W;
#pragma omp simd
            for (int l = 0; l < W; ++l) {
                partial[i][l] = std::fma(count[e + i], square[l], partial[i][l]);
            }
        }
    }
    for (; e < end; ++e) {
        const double* __restrict square = a.pairs + long{pair[e]} * W;
#pragma omp simd
        for (int l = 0; l < W; ++l) {
            partial[0][l] = std::fma(count[e], square[l], partial[0][l]);
        }
    }
    double* __restrict total = a.totals + s * W;
#pragma omp simd
    for (int l = 0; l < W; ++l) {
        total[l] = (partial[0][l] + partial[1][l]) + (partial[2][l] + partial[3][l]);
    }
}

// Copies the sum of each tooth to its bin at phase p.
template <int W>
GEARPOD_INLINE void copy_sums_to_bins(const FoldArguments& a, long p) {
    const long phases = a.path->phases();
    const int teeth = a.plan->layout().planet_teeth;
    for (int j = 0; j < teeth; ++j) {
        const double* __restrict total = a.totals + long{a.plan->sum_of_tooth()[j]} * W;
        double* __restrict bin = a.folded + (j * phases + p) * W;
#pragma omp simd
        for (int l = 0; l < W; ++l) {
            bin[l] = total[l];
        }
    }
}

template <int W>
GEARPOD_INLINE void fold_all(const FoldArguments& a) {
    whole_step_table<W>(a.path->positions(), a.exponent, a.whole_steps);
    const long sums = static_cast<long>(a.plan->sums().first.size()) - 1;
    for (long p = 0; p < a.path->phases(); ++p) {
        evaluate_phases<W, true>(a, p, 1);
        for (long s = 0; s < sums; ++s) {
            sum_pairs<W>(a, s);
        }
        copy_sums_to_bins<W>(a, p);
    }
}

}  // namespace

void fold_squares_without_tones(int lanes, const FoldArguments& a) {
    machine::with_lanes<16>(lanes, [&]<int W>() { machine::run_kernel<fold_all<W>>(a); });
}

}  // namespace gearpod::signals
