#include "mc/study/random/scrambled_sobol.hpp"

#include <boost/random/sobol.hpp>

namespace gearpod::mc {

Sobol::Sobol(std::size_t dimensions) : directions_(dimensions * kBits) {
    if (dimensions == 0) {
        return;
    }
    // Boost iterates in Gray code and omits the origin: after 2^(k + 1) - 2 steps only bit k of the
    // code is set.
    boost::random::sobol_engine<std::uint32_t, kBits> engine(dimensions);
    for (std::size_t k = 0; k < kBits; ++k) {
        engine.seed(static_cast<std::uint32_t>((std::uint64_t{2} << k) - 2));
        for (std::size_t d = 0; d < dimensions; ++d) {
            directions_[d * kBits + k] = engine();
        }
    }
}

std::uint32_t Sobol::coordinate(std::uint32_t number, std::size_t dimension) const {
    const std::uint32_t* direction = directions_.data() + dimension * kBits;
    std::uint32_t sum = 0;
    for (; number != 0; number >>= 1, ++direction) {
        sum ^= (number & 1U) != 0 ? *direction : 0U;
    }
    return sum;
}

std::uint32_t owen_scrambled(std::uint32_t coordinate, const Philox& stream) {
    constexpr unsigned kLevels = 8;  // of the tree in a block; its 256 bits are the nodes from 1 on
    std::uint32_t scrambled = 0;
    for (unsigned depth = 0; depth < 32; depth += kLevels) {
        const std::uint64_t above = std::uint64_t{coordinate} >> (32 - depth);
        const Philox::Block nodes = stream.block((std::uint64_t{1} << depth) | above);
        std::uint32_t node = 1;
        for (unsigned level = 0; level < kLevels; ++level) {
            const std::uint32_t bit = (coordinate >> (31 - depth - level)) & 1U;
            const auto flip = static_cast<std::uint32_t>(nodes[node / 64] >> (node % 64)) & 1U;
            scrambled = (scrambled << 1) | (bit ^ flip);
            node = 2 * node + bit;
        }
    }
    return scrambled;
}

}  // namespace gearpod::mc
