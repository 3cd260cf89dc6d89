// Randomized quasi-Monte Carlo points: Sobol's sequence (USSR Comput. Math. Math. Phys. 7 (1967),
// 86-112) with the direction numbers of Joe and Kuo (SIAM J. Sci. Comput. 30 (2008), 2635-2654),
// scrambled by Owen's nested permutations (J. Complexity 14 (1998), 466-489). Every point is
// uniform over the cube, and 2^m points are equally distributed over the dyadic intervals of each
// coordinate.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "mc/study/random/philox.hpp"

namespace gearpod::mc {

// Sobol sequence; coordinates are the first 32 bits of binary fractions.
class Sobol {
  public:
    explicit Sobol(std::size_t dimensions);

    // Coordinate of point `number` (0, 1, ... below 2^32); the first point is the origin.
    std::uint32_t coordinate(std::uint32_t number, std::size_t dimension) const;

  private:
    static constexpr std::size_t kBits = 32;
    std::vector<std::uint32_t> directions_;  // dimensions x kBits
};

// Owen scrambling: each bit is flipped or not by a random bit that depends on all bits before it.
// These random bits form a binary tree stored in the blocks of `stream`.
std::uint32_t owen_scrambled(std::uint32_t coordinate, const Philox& stream);

}  // namespace gearpod::mc
