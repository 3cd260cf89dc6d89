// Rectangular window: every planet counts the same at every angle, as for a sensor that turns with
// the carrier.
#pragma once

namespace gearpod::signals {

inline double rectangular(double /*x_rad*/) {
    return 1.0;
}

}  // namespace gearpod::signals
