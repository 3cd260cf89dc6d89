// Kernel of normals_from_words; see normals.hpp.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>

namespace gearpod::signals {

// Converts blocks of kNormalBlock words into as many normal variates.
void normal_blocks(long blocks, const std::uint64_t* words, double* normals);

// Standard normal variates by the transform of Box and Muller (1958). For uniform u1, u2
//
//     sqrt(-2 ln u1) cos(2 pi u2),   sqrt(-2 ln u1) sin(2 pi u2)
//
// are independent and exactly normal. All instruction sets round every operation used in the same
// way.

// Number of words in a block, which give as many variates. The first half of the words give u1, the
// second half u2; the first half of the variates are the cosines.
inline constexpr std::size_t kNormalBlock = 16;

// Converts words of 64 random bits into normal variates. u1 is at least 2^-64, so that |z| <= 9.42,
// and is rounded to 53 bits; u2 has 54 bits. Apart from that the relative error is below 2e-15.
// Throws std::invalid_argument unless both spans have the same size, a multiple of kNormalBlock.
void normals_from_words(std::span<const std::uint64_t> words, std::span<double> normals);

// Fills `values` with standard normals, taking the words of whole blocks from the engine. The
// engine is a 64-bit uniform random bit generator, optionally with fill(std::span<std::uint64_t>)
// for faster bulk generation. An engine with a member normals(values) generates the variates
// itself.
template <typename Engine>
void draw_normals(Engine& engine, std::span<double> values) {
    if constexpr (requires { engine.normals(values); }) {
        engine.normals(values);
        return;
    }
    constexpr std::size_t kAtOnce = 32 * kNormalBlock;
    std::array<std::uint64_t, kAtOnce> buffer;
    std::array<double, kNormalBlock> last;
    while (!values.empty()) {
        const std::size_t whole = values.size() / kNormalBlock * kNormalBlock;
        const std::size_t count = std::clamp(whole, kNormalBlock, kAtOnce);
        const auto words = std::span(buffer).first(count);
        if constexpr (requires { engine.fill(words); }) {
            engine.fill(words);
        } else {
            std::ranges::generate(words, [&] { return engine(); });
        }
        if (whole == 0) {
            normals_from_words(words, last);
            std::copy_n(last.begin(), values.size(), values.begin());
            return;
        }
        normals_from_words(words, values.first(count));
        values = values.subspan(count);
    }
}

}  // namespace gearpod::signals
