// Checks the alignment of a table in columns.
#include <catch2/catch.hpp>

#include "mc/sweep/columns.hpp"

namespace test_columns {

using namespace gearpod::mc;

TEST_CASE("All columns but the last are right-aligned") {
    CHECK(aligned_columns({{"key", "count", "best"}, {"1.5", "20", "te_rms"}}, 1) ==
          "key  count  best\n1.5     20  te_rms\n");
}

TEST_CASE("A wide table is split, and its parts begin with the same columns") {
    const std::string wide(70, 'x');
    CHECK(aligned_columns({{"key", wide, wide, "last"}, {"2", "a", "b", "c"}}, 1) ==
          "key  " + wide + "\n  2  " + std::string(69, ' ') + "a\n\nkey  " + wide +
              "  last\n  2  " + std::string(69, ' ') + "b  c\n");
}

}  // namespace test_columns
