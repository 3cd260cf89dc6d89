#include "gears/flank_wear.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace gearpod::gears {

// The specific sliding grows from the pitch point towards both ends of the path.
FlankWear::FlankWear(const MeshGeometry& mesh, int worn_gear)
    : mesh_(mesh),
      worn_gear_(worn_gear),
      largest_(std::max(sliding(0), sliding(mesh.contact_ratio()))) {
    if (!std::isfinite(largest_)) {
        throw std::invalid_argument(
            "contact reaches the base circle of the worn gear, where the specific sliding has no "
            "bound");
    }
}

double FlankWear::sliding(double tau) const {
    return std::abs(mesh_.roll_angle(1, tau) - mesh_.roll_angle(2, tau)) /
           mesh_.roll_angle(worn_gear_, tau);
}

double FlankWear::shape(double tau) const {
    return sliding(std::clamp(tau, 0.0, mesh_.contact_ratio())) / largest_;
}

}  // namespace gearpod::gears
