// The loosest tolerance at which a solver that chooses its steps keeps an error.
#pragma once

#include <functional>
#include <optional>

#include "mc/numerics/pilot.hpp"

namespace gearpod::peers {

// One tolerance tried.
struct Attempt {
    double tolerance = 0.0;
    double steps = 0.0;  // a mesh period
    mc::PilotError error;
    bool within = false;  // the error asked for
};

// Marches at a tolerance; nothing if it did not come to the end.
using Trial = std::function<std::optional<Attempt>(double tolerance)>;

// By decades from 1e-3 on, between 1e-1 and 1e-9, and then half a decade back: the loosest
// tolerance found that keeps the error; if none does, the tightest that came to the end, if any.
std::optional<Attempt> loosest_tolerance(const Trial& trial);

}  // namespace gearpod::peers
