#include <bit>
#include <cmath>
#include <numbers>

#include "machine/elementary_functions.hpp"
#include "machine/instruction_sets.hpp"
#include "signals/noise/normals.hpp"

namespace gearpod::signals {
namespace {

constexpr int kPairs = kNormalBlock / 2;

// Converts a word to a number in [1, 2^64], rounded once. Its upper and lower halves each become
// the lowest bits of a double. The word is made odd, which selects the middle of each pair of
// words.
GEARPOD_INLINE double to_double(std::uint64_t word) {
    constexpr std::uint64_t kHighBits = 0x4530000000000000;  // 2^84
    constexpr std::uint64_t kLowBits = 0x4330000000000000;   // 2^52
    const std::uint64_t odd = word | 1;
    const double high = std::bit_cast<double>((odd >> 32) | kHighBits);
    const double low = std::bit_cast<double>((odd & 0xffffffff) | kLowBits);
    return (high - (0x1p84 + 0x1p52)) + low;
}

// Box-Muller transform of all blocks. The upper 52 bits of the angle's word give an angle in
// (-pi/4, pi/4), in the middle of each step. Of the two lowest bits, one rotates it to the opposite
// side and the other reflects it about the diagonal.
GEARPOD_INLINE void all_blocks(long blocks, const std::uint64_t* __restrict words,
                               double* __restrict normals) {
    for (long block = 0; block < blocks; ++block) {
        const std::uint64_t* __restrict radius = words + block * 2 * kPairs;
        const std::uint64_t* __restrict angle = radius + kPairs;
        double* __restrict first = normals + block * 2 * kPairs;
        double* __restrict second = first + kPairs;
#pragma omp simd
        for (int l = 0; l < kPairs; ++l) {
            const double r = std::sqrt(2.0 * machine::lane_minus_log(to_double(radius[l])));
            const std::uint64_t bits = angle[l];
            const double step = std::bit_cast<double>((bits >> 12) | 0x3ff0000000000000);
            const double fraction = (step - 1.5) + 0x1p-53;  // exact
            const double x = fraction * (0.5 * std::numbers::pi);
            const double s = r * machine::lane_sine(x);
            const double c = std::bit_cast<double>(
                std::bit_cast<std::uint64_t>(r * machine::lane_cosine(x)) ^ (bits << 63));
            const bool reflected = (bits & 2) != 0;
            first[l] = reflected ? s : c;
            second[l] = reflected ? c : s;
        }
    }
}

}  // namespace

void normal_blocks(long blocks, const std::uint64_t* words, double* normals) {
    machine::run_kernel<all_blocks>(blocks, words, normals);
}

}  // namespace gearpod::signals
