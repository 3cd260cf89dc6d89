#include "gears/flank_relief.hpp"

#include <algorithm>

namespace gearpod::gears {

namespace {

// Relief at a distance from the end of contact.
double relief_at(double amount, double length, ReliefShape shape, double distance) {
    if (!(amount > 0) || distance >= length) {
        return 0;
    }
    const double part = 1 - distance / length;
    return amount * (shape == ReliefShape::linear ? part : part * part);
}

}  // namespace

double relief_gap(const MeshGeometry& mesh, const FlankRelief& gear_1, const FlankRelief& gear_2,
                  double tau) {
    const double since = tau * mesh.base_pitch();
    const double until = (mesh.contact_ratio() - tau) * mesh.base_pitch();
    return relief_at(gear_1.root_m, gear_1.root_length_m, gear_1.shape, since) +
           relief_at(gear_1.tip_m, gear_1.tip_length_m, gear_1.shape, until) +
           relief_at(gear_2.tip_m, gear_2.tip_length_m, gear_2.shape, since) +
           relief_at(gear_2.root_m, gear_2.root_length_m, gear_2.shape, until);
}

std::vector<double> relief_kinks(const MeshGeometry& mesh, const FlankRelief& gear_1,
                                 const FlankRelief& gear_2) {
    const double ratio = mesh.contact_ratio(), pitch = mesh.base_pitch();
    std::vector<double> kinks;
    const auto add = [&](double amount, double tau) {
        if (amount > 0 && tau > 0 && tau < ratio) {
            kinks.push_back(tau);
        }
    };
    add(gear_1.root_m, gear_1.root_length_m / pitch);
    add(gear_2.tip_m, gear_2.tip_length_m / pitch);
    add(gear_1.tip_m, ratio - gear_1.tip_length_m / pitch);
    add(gear_2.root_m, ratio - gear_2.root_length_m / pitch);
    std::sort(kinks.begin(), kinks.end());
    return kinks;
}

}  // namespace gearpod::gears
