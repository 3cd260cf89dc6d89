// Energies of windows of signal plus noise, and the window with the largest one.
#pragma once

#include <cmath>

#include "machine/instruction_sets.hpp"

namespace gearpod::signals {

// signal + 2 sigma cross + sigma^2 noise. Apart from rounding, cross^2 <= signal * noise, so that
// the sum is not negative; negative values are set to 0.
GEARPOD_INLINE double noisy_energy(double sigma, double signal, double cross, double noise) {
    const double energy = std::fma(sigma * sigma, noise, std::fma(2.0 * sigma, cross, signal));
    return energy < 0.0 ? 0.0 : energy;
}

// Kernels of Windowing; see windowing.hpp.
//
// They process kSegments stretches of the folded signal in parallel, each of the same number of
// whole mesh periods. Element t of segment i lies at [t * kSegments + i], so that a window of every
// segment is read in whole, aligned registers wherever it begins. kSegments is eight on every
// instruction set, so that the bits are the same.
inline constexpr int kSegments = 8;

// Energies of the windows that begin at the `outputs` first bins t of each segment:
//
//     energy[t] = sum over m < phases of weight_squared[m] bins[t + m].
//
// The weights are 1 at flat_first .. flat_first + flat_count - 1 and 0 before `first` and for the
// same number of bins at the other end. The flat part is summed from blocks, none longer than the
// flat part, into which every mesh period is divided in the same way. It consists of the end of its
// first block, the whole blocks between, and the beginning of its last block. So nothing is
// subtracted, and the windows of equal teeth are summed in the same order.
struct WindowEnergyArguments {
    int phases = 0;
    int first = 0;
    int flat_first = 0;
    int flat_count = 0;
    long outputs = 0;
    long blocks = 0;                  // number of blocks that cover `bins`
    const long* block_end = nullptr;  // [blocks]: the bin after each block
    // [2 phases]: block_end of the block of each bin of two mesh periods
    const int* end_of_bin = nullptr;
    const double* weight_squared = nullptr;
    const double* bins = nullptr;  // padded by kOutputsAtOnce - 1 after the last window
    double* upwards = nullptr;     // [bins]: the sum from the beginning of the block to here
    double* downwards = nullptr;   // [bins]: the sum from here to the end of the block
    double* energy = nullptr;      // padded by kOutputsAtOnce - 1 after `outputs`
};

inline constexpr int kOutputsAtOnce = 8;

void window_energy(const WindowEnergyArguments& a);

// Replaces along[b] by along[b] sqrt(folded[b]) and across[b] by along[b]^2 + across[b], with the
// old along[b]. `values` is a multiple of kSegments.
void mix_noise(long values, const double* folded, double* along, double* across);

// Finds the largest window energy of each segment at one noise level, and the smallest bin, modulo
// `phases`, that has it. The energies are e = signal + 2 sigma cross + sigma^2 noise, at least 0.
// With sigma 0, `cross` and `noise` are not read.
struct LargestEnergyArguments {
    int phases = 0;
    int periods = 0;
    double sigma = 0.0;
    const double* signal = nullptr;
    const double* cross = nullptr;
    const double* noise = nullptr;
    double* largest = nullptr;  // [kSegments]
    double* phase = nullptr;    // [kSegments]
};

void largest_energy(const LargestEnergyArguments& a);

}  // namespace gearpod::signals
