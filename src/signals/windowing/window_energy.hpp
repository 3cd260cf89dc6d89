// The kernels behind Windowing; see windowing.hpp.
//
// They look at kSegments stretches of the folded signal abreast, each of the same number of whole
// mesh periods: element t of segment i lies at [t * kSegments + i], so that a window of every
// segment is read in whole, aligned registers wherever it begins. Eight on every instruction set:
// the bits are the same.
#pragma once

namespace gearpod::signals {

inline constexpr int kSegments = 8;

// For `outputs` first bins t of each segment:
//
//     energy[t] = sum over m < phases of weight_squared[m] bins[t + m].
//
// The weights are 1 at flat_first .. flat_first + flat_count - 1 and 0 before `first` and as far
// from the other end. The flat part is summed from blocks into which every mesh period is divided
// alike, none longer than the flat part: of the block that it begins in all from there on, of the
// block that it ends in all up to there, and what lies between. So nothing is subtracted, and the
// windows of equal teeth are summed in the same order.
struct WindowEnergyArguments {
    int phases = 0;
    int first = 0;
    int flat_first = 0;
    int flat_count = 0;
    long outputs = 0;
    long blocks = 0;                  // as far as `bins` hold signal
    const long* block_end = nullptr;  // [blocks]: the bin behind each block
    const int* end_of_bin = nullptr;  // [2 phases]: the block_end of each bin of two mesh periods
    const double* weight_squared = nullptr;
    const double* bins = nullptr;  // kOutputsAtOnce - 1 beyond the last window's
    double* upwards = nullptr;     // [bins]: the sum from the beginning of the block to here
    double* downwards = nullptr;   // [bins]: the sum from here to the end of the block
    double* energy = nullptr;      // kOutputsAtOnce - 1 beyond `outputs`
};

inline constexpr int kOutputsAtOnce = 8;

void window_energy(const WindowEnergyArguments& a);

// along[b] becomes along[b] sqrt(folded[b]), across[b] becomes along[b]^2 + across[b]; a multiple
// of kSegments values.
void mix_noise(long values, const double* folded, double* along, double* across);

// The windows' energies at one noise level, e = signal + 2 sigma cross + sigma^2 noise, at least 0;
// the largest of each segment and the smallest bin, modulo `phases`, that has it. sigma 0: the
// other two are not read.
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
