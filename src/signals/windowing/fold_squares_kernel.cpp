// Folds of the squares of a signal, without and with tones. Both begin with the signal of every
// pair of distinct mesh and carrier index (folded_signal.hpp).
#include <algorithm>

#include "machine/instruction_sets.hpp"
#include "signals/noise/tones.hpp"
#include "signals/path/path_weights.hpp"
#include "signals/windowing/folded_signal.hpp"

namespace gearpod::signals {
namespace {

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
GEARPOD_INLINE void fold_all_squares(const FoldArguments& a) {
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

// Number of meshes processed together. Their samples at a block's phases stay in the first-level
// cache while all tones are added.
constexpr int kToneMeshes = 32;

// Adds tone t to y[mesh][phase][lane] of `count` meshes from k on, at B phases from p on.
template <int B, int W>
GEARPOD_INLINE void add_tone(const ToneTable& tones, long meshes, long t, long k, int count, long p,
                             double* __restrict y) {
    alignas(64) double sine[B * W], cosine[B * W];
    for (long b = 0; b < B; ++b) {
        for (int l = 0; l < W; ++l) {
            sine[b * W + l] = tones.phase_sine()[((p + b) * tones.tones() + t) * W + l];
            cosine[b * W + l] = tones.phase_cosine()[((p + b) * tones.tones() + t) * W + l];
        }
    }
    const double* __restrict mesh_sine = tones.mesh_sine() + (t * meshes + k) * W;
    const double* __restrict mesh_cosine = tones.mesh_cosine() + (t * meshes + k) * W;
    for (int i = 0; i < count; ++i) {
        for (int b = 0; b < B; ++b) {
            double* __restrict sample = y + (i * B + b) * W;
#pragma omp simd
            for (int l = 0; l < W; ++l) {
                sample[l] = plus_tone(sample[l], mesh_sine[i * W + l], mesh_cosine[i * W + l],
                                      sine[b * W + l], cosine[b * W + l]);
            }
        }
    }
}

// Folds every mesh of the span at B phases from p on: takes the signal of its pair, adds the tones
// and adds the square to its tooth's bin.
template <int B, int W>
GEARPOD_INLINE void fold_with_tones(const FoldArguments& a, long p) {
    const long phases = a.path->phases();
    const long pairs = static_cast<long>(a.plan->pairs().carrier.size());
    const long teeth = a.plan->layout().planet_teeth;
    const long meshes = a.plan->layout().meshes();
    const int* pair_of_mesh = a.plan->pair_of_mesh().data();
    for (long j = 0; j < teeth; ++j) {
        std::fill_n(a.folded + (j * phases + p) * W, B * W, 0.0);
    }
    alignas(64) double y[kToneMeshes * B * W];
    for (long k = 0; k < meshes; k += kToneMeshes) {
        const int count = static_cast<int>(std::min<long>(kToneMeshes, meshes - k));
        for (int i = 0; i < count; ++i) {
            for (long b = 0; b < B; ++b) {
                const double* pair = a.pairs + (b * pairs + pair_of_mesh[k + i]) * W;
                std::copy_n(pair, W, y + (i * B + b) * W);
            }
        }
        for (long t = 0; t < a.tones->tones(); ++t) {
            add_tone<B, W>(*a.tones, meshes, t, k, count, p, y);
        }
        for (int i = 0; i < count; ++i) {
            double* __restrict bin = a.folded + ((k + i) % teeth * phases + p) * W;
            const double* __restrict sample = y + i * B * W;
#pragma omp simd
            for (int l = 0; l < B * W; ++l) {
                bin[l] = std::fma(sample[l], sample[l], bin[l]);
            }
        }
    }
}

template <int W>
GEARPOD_INLINE void fold_all_with_tones(const FoldArguments& a) {
    whole_step_table<W>(a.path->positions(), a.exponent, a.whole_steps);
    const long phases = a.path->phases();
    for (long p = 0; p < phases;) {
        const long count = p + kTonePhases <= phases ? kTonePhases : 1;
        evaluate_phases<W, false>(a, p, count);
        if (count == kTonePhases) {
            fold_with_tones<kTonePhases, W>(a, p);
        } else {
            fold_with_tones<1, W>(a, p);
        }
        p += count;
    }
}

}  // namespace

void fold_squares_without_tones(int lanes, const FoldArguments& a) {
    machine::with_lanes<16>(lanes, [&]<int W>() { machine::run_kernel<fold_all_squares<W>>(a); });
}

void fold_tones(int lanes, const FoldArguments& a) {
    machine::with_lanes<16>(lanes,
                            [&]<int W>() { machine::run_kernel<fold_all_with_tones<W>>(a); });
}

}  // namespace gearpod::signals
