// Standard normal variables by the transform of Box and Muller (1958): from uniform u1, u2
//
//     sqrt(-2 ln u1) cos(2 pi u2),   sqrt(-2 ln u1) sin(2 pi u2)
//
// are independent and exactly normal. Every operation is one that all instruction sets round alike.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>

namespace gearpod::signals {

// So many words make as many values: the first half give u1, the second half u2, the first half of
// the values are the cosines.
inline constexpr std::size_t kNormalBlock = 16;

// Any 64 bits are a good word. u1 runs from 2^-64, so that |z| <= 9.42, and is rounded to 53 bits,
// u2 has 54 of its own; but for that the relative error is below 2e-15. As many values as words, a
// multiple of kNormalBlock, or std::invalid_argument is thrown.
void normals_from_words(std::span<const std::uint64_t> words, std::span<double> normals);

// Takes the words of whole blocks from the engine: a 64-bit uniform random bit generator, with
// fill(std::span<std::uint64_t>) if it is quicker at many; or what has normals(values) of its own.
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
