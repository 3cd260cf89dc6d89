// Compares gearboxes bit by bit between tiles of different lanes and numbers of gearboxes.
#pragma once

#include "tests/numbers.hpp"

namespace gearpod::test {

// Values bit by bit, so that NaN equals NaN.
using Bits = std::vector<std::uint64_t>;

inline Bits bits_of(std::span<const double> values) {
    return mapped(values, [](double value) { return std::bit_cast<std::uint64_t>(value); });
}

struct TileFilling {
    int lanes = 8;
    std::size_t gearboxes = 8;
};

// Checks the gearboxes of every filling against those of the first one. `compute` returns the bits
// of the first gearboxes, as many as the filling has.
template <class Compute>
void check_same_bits(const std::vector<TileFilling>& fillings, Compute compute) {
    const std::vector<Bits> reference = compute(fillings.front());
    REQUIRE(reference.size() == fillings.front().gearboxes);
    for (const TileFilling& filling : std::span(fillings).subspan(1)) {
        INFO(filling.gearboxes << " gearboxes in tiles of " << filling.lanes << " lanes");
        const std::vector<Bits> computed = compute(filling);
        REQUIRE(computed.size() == filling.gearboxes);
        for (std::size_t g = 0; g < computed.size(); ++g) {
            INFO("gearbox " << g);
            CHECK((computed[g] == reference[g]));
        }
    }
}

}  // namespace gearpod::test
