#include <cmath>
#include <utility>

#include "machine/dispatch.hpp"
#include "signals/window_energy.hpp"

namespace gearpod::signals {
namespace {

// The tapers, four weights in a pass: few enough to stay in registers, fewer passes over the
// energy.
GEARPOD_INLINE void add_tapers(const WindowEnergyArguments& a) {
    double* __restrict energy = a.energy;
    const int flat_end = a.flat_first + a.flat_count;
    int m = a.flat_first > 0 ? 0 : flat_end;
    while (m < a.phases) {
        const int end = m < a.flat_first ? a.flat_first : a.phases;
        const double* __restrict x = a.extended + m;
        const double* w = a.weight_squared + m;
        if (end - m >= 4) {
            const double w0 = w[0], w1 = w[1], w2 = w[2], w3 = w[3];
#pragma omp simd
            for (long b = 0; b < a.bins; ++b) {
                const double low = std::fma(w1, x[b + 1], w0 * x[b]);
                const double high = std::fma(w3, x[b + 3], w2 * x[b + 2]);
                energy[b] += low + high;
            }
            m += 4;
        } else {
            const double w0 = w[0];
#pragma omp simd
            for (long b = 0; b < a.bins; ++b) {
                energy[b] = std::fma(w0, x[b], energy[b]);
            }
            m += 1;
        }
        if (m == a.flat_first) {
            m = flat_end;
        }
    }
}

GEARPOD_INLINE void add_shifted(long bins, const double* __restrict x, double* __restrict sum) {
#pragma omp simd
    for (long b = 0; b < bins; ++b) {
        sum[b] += x[b];
    }
}

GEARPOD_INLINE void double_blocks(long blocks, long length, const double* __restrict half,
                                  double* __restrict whole) {
#pragma omp simd
    for (long b = 0; b < blocks; ++b) {
        whole[b] = half[b] + half[b + length];
    }
}

// The flat part: its length in binary, from sums over blocks of 1, 2, 4, ... bins.
GEARPOD_INLINE void add_flat(const WindowEnergyArguments& a) {
    const long size = a.bins + a.phases - 1;
    const double* block = a.extended;  // block[b]: the sum over `length` bins from b on
    double* next = a.scratch;
    double* after_next = a.scratch + size;
    long offset = a.flat_first;
    for (long length = 1; length <= a.flat_count; length *= 2) {
        if ((a.flat_count & length) != 0) {
            add_shifted(a.bins, block + offset, a.energy);
            offset += length;
        }
        double_blocks(size - 2 * length + 1, length, block, next);
        block = next;
        std::swap(next, after_next);
    }
}

GEARPOD_INLINE void all_windows(const WindowEnergyArguments& a) {
    double* __restrict energy = a.energy;
#pragma omp simd
    for (long b = 0; b < a.bins; ++b) {
        energy[b] = 0.0;
    }
    add_flat(a);
    add_tapers(a);
    double largest = 0.0;
#pragma omp simd reduction(max : largest)
    for (long b = 0; b < a.bins; ++b) {
        largest = energy[b] > largest ? energy[b] : largest;
    }
    *a.largest = largest;
}

}  // namespace

GEARPOD_KERNEL(window_energy, (const WindowEnergyArguments& a), (a), all_windows(a))

}  // namespace gearpod::signals
