#include "signals/fold_squares.hpp"
#include "signals/path_weights.hpp"
#include "signals/planet_count.hpp"
#include "signals/resultant.hpp"
#include "signals/tone_sample.hpp"

namespace gearpod::signals {
namespace {

// y^2, or y, of one mesh's pairs at phase p. The accelerations stay in registers over the carrier
// indices.
template <int N, int W, bool kSquared>
GEARPOD_INLINE void evaluate_pairs(const FoldArguments& a, long p, int mesh) {
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
        double* __restrict pair = a.pairs + q * W;
#pragma omp simd
        for (int l = 0; l < W; ++l) {
            const double y = resultant<N, W>(accel, weight, sine[c], cosine[c], l);
            pair[l] = kSquared ? y * y : y;
        }
    }
}

// Sum s over its pairs. Four partial sums, so that additions do not wait for each other.
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

// Each tooth's bin at phase p takes its sum.
template <int W>
GEARPOD_INLINE void hand_out(const FoldArguments& a, long p) {
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

// Every mesh of the span at phase p with its tones, squared and added to its tooth's bin.
template <int W>
GEARPOD_INLINE void fold_with_tones(const FoldArguments& a, long p) {
    const long phases = a.path->phases();
    const int teeth = a.plan->layout().planet_teeth;
    const int meshes = a.plan->layout().meshes();
    const int tones = a.tones->tones();
    const int* pair_of_mesh = a.plan->pair_of_mesh().data();
    const double* __restrict phase_sine = a.tones->phase_sine() + p * tones * W;
    const double* __restrict phase_cosine = a.tones->phase_cosine() + p * tones * W;
    for (long j = 0; j < teeth; ++j) {
        double* __restrict bin = a.folded + (j * phases + p) * W;
        for (int l = 0; l < W; ++l) {
            bin[l] = 0.0;
        }
    }
    alignas(64) double y[W];
    for (long k = 0, j = 0; k < meshes; ++k, j = j + 1 < teeth ? j + 1 : 0) {
        const double* __restrict pair = a.pairs + long{pair_of_mesh[k]} * W;
        for (int l = 0; l < W; ++l) {
            y[l] = pair[l];
        }
        for (long t = 0; t < tones; ++t) {
            const double* __restrict sine = a.tones->mesh_sine() + (t * meshes + k) * W;
            const double* __restrict cosine = a.tones->mesh_cosine() + (t * meshes + k) * W;
#pragma omp simd
            for (int l = 0; l < W; ++l) {
                y[l] = plus_tone(y[l], sine[l], cosine[l], phase_sine[t * W + l],
                                 phase_cosine[t * W + l]);
            }
        }
        double* __restrict bin = a.folded + (j * phases + p) * W;
#pragma omp simd
        for (int l = 0; l < W; ++l) {
            bin[l] = std::fma(y[l], y[l], bin[l]);
        }
    }
}

template <int N, int W, bool kTones>
GEARPOD_INLINE void fold_phases(const FoldArguments& a) {
    whole_step_table<W>(a.path->positions(), a.exponent, a.whole_steps);
    const long sums = static_cast<long>(a.plan->sums().first.size()) - 1;
    const int meshes = a.plan->largest_mesh() + 1;
    for (long p = 0; p < a.path->phases(); ++p) {
        path_weights<N, W>(*a.path, p, a.exponent, a.whole_steps, a.weight);
        for (int mesh = 0; mesh < meshes; ++mesh) {
            evaluate_pairs<N, W, !kTones>(a, p, mesh);
        }
        if constexpr (kTones) {
            fold_with_tones<W>(a, p);
        } else {
            for (long s = 0; s < sums; ++s) {
                sum_pairs<W>(a, s);
            }
            hand_out<W>(a, p);
        }
    }
}

template <int W>
GEARPOD_INLINE void fold_all(const FoldArguments& a) {
    with_planets(
        a.path->planets(), [&]<int N>() __attribute__((always_inline)) {
            if (a.tones != nullptr) {
                fold_phases<N, W, true>(a);
            } else {
                fold_phases<N, W, false>(a);
            }
        });
}

}  // namespace

GEARPOD_KERNEL(fold_squares_1, (const FoldArguments& a), (a), fold_all<1>(a))
GEARPOD_KERNEL(fold_squares_8, (const FoldArguments& a), (a), fold_all<8>(a))

}  // namespace gearpod::signals
