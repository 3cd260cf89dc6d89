// What a gearbox that is split (splitting.hpp) has taken from another one.
#pragma once

#include <cstdint>

namespace gearpod::analysis {

// A share s of the other's draws: a normal number becomes (1 - s) own + sqrt(1 - (1 - s)^2) other,
// and what is not made of normal numbers is the other's with probability s. Both leave draws the
// law that they have, and are as likely the other way round.
struct DrawExchange {
    std::uint64_t index = 0;  // of the other gearbox
    double share = 0.0;
};

}  // namespace gearpod::analysis
