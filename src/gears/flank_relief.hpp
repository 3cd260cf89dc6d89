// Tip and root relief and crowning: what is ground off the flanks of all teeth of a gear near the
// ends of contact and of the face width, as a gap along the line of action. Lengths in metres,
// those of relief along the line of action from the end of contact inwards.
#pragma once

#include <vector>

#include "gears/mesh_geometry.hpp"

namespace gearpod::gears {

enum class ReliefShape { linear, parabolic };

struct FlankRelief {
    double tip_m = 0, tip_length_m = 0;    // amount at the tip; how far it reaches
    double root_m = 0, root_length_m = 0;  // at the end of contact near the root
    ReliefShape shape = ReliefShape::linear;
    double crowning_m = 0;  // at both ends of the face width, a parabola between them

    bool of_profile() const { return tip_m > 0 || root_m > 0; }
    bool any() const { return of_profile() || crowning_m > 0; }
    bool operator==(const FlankRelief&) const = default;
};

// Of the profiles of a tooth pair tau mesh periods after its engagement began, from both flanks.
// Gear 1 is touched at the root first and at the tip last, gear 2 the other way.
double relief_gap(const MeshGeometry& mesh, const FlankRelief& gear_1, const FlankRelief& gear_2,
                  double tau);

// Positions, ascending, at which a relief begins or ends within the engagement: the gap kinks.
std::vector<double> relief_kinks(const MeshGeometry& mesh, const FlankRelief& gear_1,
                                 const FlankRelief& gear_2);

}  // namespace gearpod::gears
