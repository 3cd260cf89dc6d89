#include <algorithm>

#include "machine/instruction_sets.hpp"
#include "signals/noise/tones.hpp"
#include "signals/windowing/fold_pairs.hpp"

namespace gearpod::signals {
namespace {

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
GEARPOD_INLINE void fold_all(const FoldArguments& a) {
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

void fold_tones(int lanes, const FoldArguments& a) {
    machine::with_lanes<16>(lanes, [&]<int W>() { machine::run_kernel<fold_all<W>>(a); });
}

}  // namespace gearpod::signals
