#include <cmath>

#include "machine/dispatch.hpp"
#include "signals/noisy_bins.hpp"

namespace gearpod::signals {
namespace {

GEARPOD_INLINE void all_bins(long bins, const double* __restrict folded,
                             const double* __restrict along, const double* __restrict across,
                             double sigma, double* __restrict noisy) {
#pragma omp simd
    for (long b = 0; b < bins; ++b) {
        const double parallel = std::fma(sigma, along[b], std::sqrt(folded[b]));
        noisy[b] = std::fma(parallel, parallel, sigma * sigma * across[b]);
    }
}

}  // namespace

GEARPOD_KERNEL(noisy_bins,
               (long bins, const double* folded, const double* along, const double* across,
                double sigma, double* noisy),
               (bins, folded, along, across, sigma, noisy),
               all_bins(bins, folded, along, across, sigma, noisy))

}  // namespace gearpod::signals
