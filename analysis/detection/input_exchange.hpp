// Exchange of random inputs between gearboxes in multilevel splitting (splitting.hpp).
#pragma once

#include <cstdint>

namespace gearpod::analysis {

// Replaces a share s of the random inputs by those of another gearbox. A normal number becomes (1 -
// s) own + sqrt(1 - (1 - s)^2) other; an input that is not built from normal numbers is replaced
// with probability s. Both keep the distribution of the inputs and are reversible.
struct InputExchange {
    std::uint64_t index = 0;  // number of the other gearbox
    double share = 0.0;
};

}  // namespace gearpod::analysis
