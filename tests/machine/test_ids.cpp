#include <concepts>

#include "machine/ids.hpp"
#include "tests/test.hpp"

namespace gearpod::test_ids {

TEST_CASE("ids of different kinds, and numbers, are never taken for each other", "[ids]") {
    STATIC_REQUIRE_FALSE(std::convertible_to<int, PairId>);
    STATIC_REQUIRE_FALSE(std::constructible_from<PairId, PlanetId>);
    STATIC_REQUIRE_FALSE(std::assignable_from<LaneId&, PairId>);
    STATIC_REQUIRE(std::constructible_from<LaneId, std::size_t>);
}

TEST_CASE("an id indexes and is counted like an int", "[ids]") {
    const std::vector<int> values{3, 1, 4};
    int sum = 0;
    for (LaneId lane{0}; lane < values.size(); ++lane) {
        sum += values[lane] * (lane + 1);
    }
    CHECK(sum == 17);
}

TEST_CASE("sun pairs come before ring pairs, each in the order of the planets", "[ids]") {
    for (PlanetId planet{0}; planet < 4; ++planet) {
        CHECK(sun_pair(planet) == planet);
        CHECK(ring_pair(planet, 4) == 4 + planet);
        CHECK(planet_of(ring_pair(planet, 4), 4) == planet_of(sun_pair(planet), 4));
    }
}

}  // namespace gearpod::test_ids
