// Points that fill a cube more evenly than independent ones, at random: Sobol's sequence (USSR
// Comput. Math. Math. Phys. 7 (1967), 86-112) with the direction numbers of Joe and Kuo (SIAM J.
// Sci. Comput. 30 (2008), 2635-2654), scrambled by Owen's nested permutations (J. Complexity 14
// (1998), 466-489). Every point is uniform over the cube; of 2^m of them each dyadic interval of a
// coordinate has its share.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "mc/random/philox.hpp"

namespace gearpod::mc {

// Coordinates are the first 32 bits of binary fractions.
class Sobol {
  public:
    explicit Sobol(std::size_t dimensions);

    // Of point `number` (0, 1, ... below 2^32), the first of which is the origin.
    std::uint32_t coordinate(std::uint32_t number, std::size_t dimension) const;

  private:
    static constexpr std::size_t kBits = 32;
    std::vector<std::uint32_t> directions_;  // dimensions x kBits
};

// Every bit is flipped or not by a random bit that belongs to all bits before it: a node of a tree,
// whose bits the stream has in its blocks.
std::uint32_t owen_scrambled(std::uint32_t coordinate, const Philox& stream);

}  // namespace gearpod::mc
