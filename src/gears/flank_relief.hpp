// Tip relief, root relief and crowning: material removed near the ends of contact and of the face
// width, from the flanks of all teeth of a gear. It is given as a gap along the line of action.
// Lengths are in metres; those of relief are along the line of action, inwards from the end of
// contact.
#pragma once

#include <vector>

#include "gears/mesh_geometry.hpp"

namespace gearpod::gears {

enum class ReliefShape { linear, parabolic };

struct FlankRelief {
    double tip_m = 0, tip_length_m = 0;    // amount at the tip, and its extent
    double root_m = 0, root_length_m = 0;  // at the end of contact near the root
    ReliefShape shape = ReliefShape::linear;
    double crowning_m = 0;  // at both ends of the face width, parabolic in between

    bool of_profile() const { return tip_m > 0 || root_m > 0; }
    bool any() const { return of_profile() || crowning_m > 0; }
    bool operator==(const FlankRelief&) const = default;
};

// Gap due to the profile relief of both flanks of a tooth pair, m, tau mesh periods after the start
// of its engagement. Contact runs from root to tip on gear 1, and from tip to root on gear 2.
double relief_gap(const MeshGeometry& mesh, const FlankRelief& gear_1, const FlankRelief& gear_2,
                  double tau);

// Positions within the engagement, ascending, at which a relief starts or ends: the kinks of the
// gap.
std::vector<double> relief_kinks(const MeshGeometry& mesh, const FlankRelief& gear_1,
                                 const FlankRelief& gear_2);

}  // namespace gearpod::gears
