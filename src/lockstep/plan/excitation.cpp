#include "lockstep/plan/excitation.hpp"

#include <cmath>

namespace gearpod::lockstep {

double knots_per_s(double half_power_Hz) {
    constexpr double kHalfPower = 0.2275119577344975;  // the half-power point: sinc^8 is 1/2 there
    return half_power_Hz / kHalfPower;
}

double knot_deviation() {
    return std::sqrt(315.0 / 151.0);
}

}  // namespace gearpod::lockstep
