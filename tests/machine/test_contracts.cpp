#include "machine/contracts.hpp"
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
    CHECK_THROWS_WITH(halved(3), Catch::EndsWith("test_contracts.cpp:9: precondition value % 2 == "
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

}  // namespace gearpod::test_contracts
