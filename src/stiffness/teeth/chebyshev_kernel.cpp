// Clenshaw's recurrence over blocks of points. A block stays in registers during the loop over
// terms.
#include <cmath>
#include <cstddef>

#include "machine/instruction_sets.hpp"
#include "stiffness/teeth/chebyshev.hpp"

namespace gearpod::stiffness {

namespace {

constexpr int kBlock = 32;

struct Clenshaw {
    const double* coefficients;
    int terms;
    double scale, shift;  // x = scale t + shift
    double least;
};

GEARPOD_INLINE void evaluate_block(const Clenshaw& series, const double* t, double* values) {
    alignas(64) double x2[kBlock], b1[kBlock], b2[kBlock];
#pragma omp simd
    for (int i = 0; i < kBlock; ++i) {
        x2[i] = 2 * std::fma(series.scale, t[i], series.shift);
        b1[i] = b2[i] = 0;
    }
    for (int j = series.terms - 1; j > 0; --j) {
        const double c = series.coefficients[j];
#pragma omp simd
        for (int i = 0; i < kBlock; ++i) {
            const double b0 = std::fma(x2[i], b1[i], c - b2[i]);
            b2[i] = b1[i];
            b1[i] = b0;
        }
    }
    const double c0 = series.coefficients[0];
#pragma omp simd
    for (int i = 0; i < kBlock; ++i) {
        const double value = std::fma(0.5 * x2[i], b1[i], c0 - b2[i]);
        values[i] = value < series.least ? series.least : value;
    }
}

GEARPOD_INLINE void evaluate_blocks(const Clenshaw& series, const double* t, double* values,
                                    std::size_t count) {
    std::size_t done = 0;
    for (; done + kBlock <= count; done += kBlock)
        evaluate_block(series, t + done, values + done);
    if (done == count)
        return;
    alignas(64) double rest_t[kBlock], rest[kBlock];
    for (std::size_t i = 0; i < kBlock; ++i)
        rest_t[i] = t[done + i < count ? done + i : count - 1];
    evaluate_block(series, rest_t, rest);
    for (std::size_t i = done; i < count; ++i)
        values[i] = rest[i - done];
}

}  // namespace

void evaluate_chebyshev(std::span<const double> coefficients, double begin, double end,
                        std::span<const double> t, std::span<double> values, double least) {
    const double width = end - begin;
    const Clenshaw series{coefficients.data(), static_cast<int>(coefficients.size()), 2 / width,
                          -(begin + end) / width, least};
    machine::run_kernel<evaluate_blocks>(series, t.data(), values.data(), t.size());
}

}  // namespace gearpod::stiffness
