#include <cmath>

#include "machine/instruction_sets.hpp"
#include "signals/spectra/prime_stage.hpp"

namespace gearpod::signals {
namespace {

constexpr int W = kColumns;

// Replaces row r by the sum of rows r and q - r, and row q - r by their difference; `total` is the
// sum of all rows.
GEARPOD_INLINE void pair_rows(int prime, long row, double* __restrict rows,
                              double* __restrict total) {
    alignas(64) double sum[W];
#pragma omp simd
    for (int l = 0; l < W; ++l) {
        sum[l] = rows[l];
    }
    for (int r = 1; r < prime - r; ++r) {
        double* __restrict low = rows + r * row;
        double* __restrict high = rows + (prime - r) * row;
#pragma omp simd
        for (int l = 0; l < W; ++l) {
            const double both = low[l] + high[l];
            high[l] = low[l] - high[l];
            low[l] = both;
            sum[l] += both;
        }
    }
#pragma omp simd
    for (int l = 0; l < W; ++l) {
        total[l] = sum[l];
    }
}

GEARPOD_INLINE void results(const PrimeStageArguments& a, long k, int s) {
    const int half = (a.prime - 1) / 2;
    const double* cosine = a.cosine + (s - 1) * half - 1;
    const double* sine = a.sine + (s - 1) * half - 1;
    const double* __restrict real = a.real + k;
    const double* __restrict imaginary = a.imaginary + k;
    alignas(64) double even_real[W], even_imaginary[W], odd_real[W], odd_imaginary[W];
#pragma omp simd
    for (int l = 0; l < W; ++l) {
        even_real[l] = real[l];
        even_imaginary[l] = imaginary[l];
        odd_real[l] = odd_imaginary[l] = 0.0;
    }
    for (int r = 1; r <= half; ++r) {
        const long low = r * a.row;
        const long high = (a.prime - r) * a.row;
#pragma omp simd
        for (int l = 0; l < W; ++l) {
            even_real[l] = std::fma(cosine[r], real[low + l], even_real[l]);
            even_imaginary[l] = std::fma(cosine[r], imaginary[low + l], even_imaginary[l]);
            odd_real[l] = std::fma(sine[r], real[high + l], odd_real[l]);
            odd_imaginary[l] = std::fma(sine[r], imaginary[high + l], odd_imaginary[l]);
        }
    }
    const long here = s * a.row + k;
    const long mirrored = (a.prime - s) * a.row + k;
#pragma omp simd
    for (int l = 0; l < W; ++l) {
        a.out_real[here + l] = even_real[l] - odd_imaginary[l];
        a.out_imaginary[here + l] = even_imaginary[l] + odd_real[l];
        a.out_real[mirrored + l] = even_real[l] + odd_imaginary[l];
        a.out_imaginary[mirrored + l] = even_imaginary[l] - odd_real[l];
    }
}

GEARPOD_INLINE void all_columns(const PrimeStageArguments& a) {
    for (long k = 0; k < a.row; k += W) {
        pair_rows(a.prime, a.row, a.real + k, a.out_real + k);
        pair_rows(a.prime, a.row, a.imaginary + k, a.out_imaginary + k);
        for (int s = 1; s < a.prime - s; ++s) {
            results(a, k, s);
        }
    }
}

}  // namespace

void prime_stage(const PrimeStageArguments& a) {
    machine::run_kernel<all_columns>(a);
}

}  // namespace gearpod::signals
