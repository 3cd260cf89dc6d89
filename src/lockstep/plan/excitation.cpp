#include "lockstep/plan/excitation.hpp"

#include <cmath>
#include <stdexcept>

namespace gearpod::lockstep {

double knots_per_s(double half_power_Hz) {
    constexpr double kHalfPower = 0.2275119577344975;  // the half-power point: sinc^8 is 1/2 there
    return half_power_Hz / kHalfPower;
}

double knot_deviation() {
    return std::sqrt(315.0 / 151.0);
}

void check_excitation(const Excitation* excitation, int recorded_meshes) {
    if (excitation != nullptr && !excitation->repeats() && recorded_meshes == 0) {
        throw std::invalid_argument("an excitation that does not repeat needs every mesh marched");
    }
}

}  // namespace gearpod::lockstep
