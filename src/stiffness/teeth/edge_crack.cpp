#include "stiffness/teeth/edge_crack.hpp"

#include <array>
#include <cmath>

namespace gearpod::stiffness {
namespace {

using Coefficients = std::array<double, 7>;
constexpr Coefficients kTension{1.1214, -1.5743, 6.3317, -13.043, 15.883, -10.388, 2.7895};
constexpr Coefficients kBending{1.1214, -2.9181, 7.905, -15.893, 19.67, -13.025, 3.5138};

double with_ligament(const Coefficients& coefficients, double share) {
    double sum = 0.0;
    for (auto c = coefficients.rbegin(); c != coefficients.rend(); ++c) {
        sum = sum * share + *c;
    }
    return sum / std::pow(1.0 - share, 1.5);
}

}  // namespace

double edge_crack_tension(double share) {
    return with_ligament(kTension, share);
}

double edge_crack_bending(double share) {
    return with_ligament(kBending, share);
}

double edge_crack_shear(double share) {
    return (1.122 + share * (-0.561 + share * (0.085 + share * 0.180))) / std::sqrt(1.0 - share);
}

}  // namespace gearpod::stiffness
