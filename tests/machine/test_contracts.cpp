#include <concepts>

#include "machine/contracts.hpp"
#include "machine/ids.hpp"
#include "tests/test.hpp"

namespace gearpod::test_contracts {

using machine::ContractViolation;

int halved(int value) {
    GEARPOD_CHECK_CONTRACT("precondition", value % 2 == 0);
    const int half = value / 2;
    GEARPOD_CHECK_CONTRACT("postcondition", std::vector<int>{half, 7}.size() == 2 && half < 100);
    return half;
}

TEST_CASE("A violated contract is reported with its file, line and condition", "[contracts]") {
    CHECK(halved(4) == 2);
    CHECK_THROWS_AS(halved(3), ContractViolation);
    CHECK_THROWS_WITH(halved(3), Catch::EndsWith("test_contracts.cpp:12: precondition value % 2 == "
                                                 "0 is violated"));
    CHECK_THROWS_WITH(
        halved(400), Catch::Contains("postcondition") && Catch::EndsWith("half < 100 is violated"));
}

TEST_CASE("Contracts are checked only in builds that ask for it", "[contracts]") {
    int evaluated = 0;
    EXPECTS(++evaluated > 0);
    ENSURES(++evaluated > 0);
#ifdef GEARPOD_CONTRACTS
    CHECK(evaluated == 2);
    CHECK_THROWS_AS(EXPECTS(evaluated > 2), ContractViolation);
    CHECK_THROWS_AS(ENSURES(evaluated > 2), ContractViolation);
#else
    CHECK(evaluated == 0);
    EXPECTS(evaluated > 2);
#endif
}

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

}  // namespace gearpod::test_contracts
