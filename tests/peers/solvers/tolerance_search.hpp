// Finds the loosest tolerance at which a solver with adaptive steps meets an error.
#pragma once

#include <functional>
#include <optional>

#include "mc/numerics/pilot.hpp"

namespace gearpod::peers {

// Result at one tolerance.
struct Attempt {
    double tolerance = 0.0;
    double steps = 0.0;  // per mesh period
    mc::PilotError error;
    bool within = false;  // meets the requested error
};

// Integrates at a tolerance; returns nothing if it did not reach the end.
using Trial = std::function<std::optional<Attempt>(double tolerance)>;

// Searches by decades from 1e-3 on, between 1e-1 and 1e-9, and then half a decade back. Returns the
// loosest tolerance that meets the error; if none does, the tightest that reached the end, if any.
std::optional<Attempt> loosest_tolerance(const Trial& trial);

}  // namespace gearpod::peers
