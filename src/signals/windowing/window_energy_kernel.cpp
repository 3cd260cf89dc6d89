#include <cmath>

#include "machine/instruction_sets.hpp"
#include "signals/windowing/window_energy.hpp"

namespace gearpod::signals {
namespace {

constexpr int W = kSegments;

GEARPOD_INLINE void sum_blocks(const WindowEnergyArguments& a) {
    long first = 0;
    for (long block = 0; block < a.blocks; ++block) {
        const long end = a.block_end[block];
        alignas(64) double up[W] = {}, down[W] = {};
        for (long i = 0; i < end - first; ++i) {
            const long t = first + i;
            const long mirrored = end - 1 - i;
#pragma omp simd
            for (int l = 0; l < W; ++l) {
                up[l] += a.bins[t * W + l];
                down[l] += a.bins[mirrored * W + l];
                a.upwards[t * W + l] = up[l];
                a.downwards[mirrored * W + l] = down[l];
            }
        }
        first = end;
    }
}

GEARPOD_INLINE void clear(double* __restrict sum) {
#pragma omp simd
    for (int l = 0; l < W; ++l) {
        sum[l] = 0.0;
    }
}

// Sums the flat part of the window at bin `phase` of the mesh period that begins at `period`.
GEARPOD_INLINE void sum_flat(const WindowEnergyArguments& a, long period, int phase,
                             double* __restrict sum) {
    const int from = phase + a.flat_first;
    const int stop = from + a.flat_count;
    if (a.flat_count == 0) {
        clear(sum);
        return;
    }
    const double* __restrict down = a.downwards + (period + from) * W;
#pragma omp simd
    for (int l = 0; l < W; ++l) {
        sum[l] = down[l];
    }
    int begin = a.end_of_bin[from];
    while (begin < stop) {
        const int next = a.end_of_bin[begin] < stop ? a.end_of_bin[begin] : stop;
        const double* __restrict up = a.upwards + (period + next - 1) * W;
#pragma omp simd
        for (int l = 0; l < W; ++l) {
            sum[l] += up[l];
        }
        begin = next;
    }
}

// Adds a taper, weights begin .. end - 1, to kOutputsAtOnce windows that begin at bins[0], bins[W],
// ... Each weight is used for all of them while their sums stay in registers.
GEARPOD_INLINE void add_taper(const double* __restrict bins, const double* __restrict weight,
                              int begin, int end, double* __restrict energy) {
    constexpr int kSums = kOutputsAtOnce * W;
    alignas(64) double sum[kSums];
#pragma omp simd
    for (int i = 0; i < kSums; ++i) {
        sum[i] = energy[i];
    }
    for (int m = begin; m < end; ++m) {
        const double w = weight[m];
        const double* __restrict x = bins + m * W;
#pragma omp simd
        for (int i = 0; i < kSums; ++i) {
            sum[i] = std::fma(w, x[i], sum[i]);
        }
    }
#pragma omp simd
    for (int i = 0; i < kSums; ++i) {
        energy[i] = sum[i];
    }
}

GEARPOD_INLINE void all_windows(const WindowEnergyArguments& a) {
    sum_blocks(a);
    long period = 0;
    int phase = 0;
    for (long t = 0; t < a.outputs; t += kOutputsAtOnce) {
        double* energy = a.energy + t * W;
        for (int i = 0; i < kOutputsAtOnce; ++i) {
            if (t + i >= a.outputs) {
                clear(energy + i * W);
                continue;
            }
            sum_flat(a, period, phase, energy + i * W);
            if (++phase == a.phases) {
                phase = 0;
                period += a.phases;
            }
        }
        const double* bins = a.bins + t * W;
        add_taper(bins, a.weight_squared, a.first, a.flat_first, energy);
        add_taper(bins, a.weight_squared, a.flat_first + a.flat_count, a.phases - a.first, energy);
    }
}

GEARPOD_INLINE void mix(long values, const double* __restrict folded, double* __restrict along,
                        double* __restrict across) {
    for (long b = 0; b < values; b += W) {
#pragma omp simd
        for (long v = b; v < b + W; ++v) {
            across[v] = std::fma(along[v], along[v], across[v]);
            along[v] = along[v] * std::sqrt(folded[v]);
        }
    }
}

// Searches phase by phase, and replaces the place only for a larger energy.
template <bool kNoisy>
GEARPOD_INLINE void search(const LargestEnergyArguments& a) {
    alignas(64) double largest[W], best_phase[W], most[W];
    for (int l = 0; l < W; ++l) {
        largest[l] = -1.0;
        best_phase[l] = a.phases - 1;
    }
    const double* __restrict signal = a.signal;
    const double* __restrict cross = a.cross;
    const double* __restrict noise = a.noise;
    for (int p = 0; p < a.phases; ++p) {
        const double phase = p;
#pragma omp simd
        for (int l = 0; l < W; ++l) {
            most[l] = -1.0;
        }
        for (long period = 0; period < a.periods; ++period) {
            const long first = (period * a.phases + p) * W;
#pragma omp simd
            for (int l = 0; l < W; ++l) {
                const double e = kNoisy ? noisy_energy(a.sigma, signal[first + l], cross[first + l],
                                                       noise[first + l])
                                        : signal[first + l];
                most[l] = e > most[l] ? e : most[l];
            }
        }
#pragma omp simd
        for (int l = 0; l < W; ++l) {
            best_phase[l] = most[l] > largest[l] ? phase : best_phase[l];
            largest[l] = most[l] > largest[l] ? most[l] : largest[l];
        }
    }
    for (int l = 0; l < W; ++l) {
        a.largest[l] = largest[l];
        a.phase[l] = best_phase[l];
    }
}

GEARPOD_INLINE void search_all(const LargestEnergyArguments& a) {
    a.sigma == 0.0 ? search<false>(a) : search<true>(a);
}

}  // namespace

void window_energy(const WindowEnergyArguments& a) {
    machine::run_kernel<all_windows>(a);
}

void mix_noise(long values, const double* folded, double* along, double* across) {
    machine::run_kernel<mix>(values, folded, along, across);
}

void largest_energy(const LargestEnergyArguments& a) {
    machine::run_kernel<search_all>(a);
}

}  // namespace gearpod::signals
