// Relative difference of two signals.
#pragma once

#include "tests/test.hpp"

namespace gearpod::test {

// Root mean square of the difference over that of the second signal.
template <class Signal>
double relative_difference(const Signal& a, const Signal& b) {
    REQUIRE(a.size() == b.size());
    double difference = 0.0, squares = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        difference += (a[i] - b[i]) * (a[i] - b[i]);
        squares += b[i] * b[i];
    }
    return std::sqrt(difference / squares);
}

}  // namespace gearpod::test
