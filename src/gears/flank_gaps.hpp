// Gaps of flanks along the line of action: tip relief, crowning, wear, and the corner
// contact outside the path.
#pragma once

#include <vector>

#include "gears/mesh_geometry.hpp"

namespace gearpod::gears {

// Tip relief and crowning: material removed near the tip and the ends of the face width, from the
// flanks of all teeth of a gear. It is given as a gap along the line of action. Lengths are in
// metres; that of relief is along the line of action, inwards from the end of contact.
struct FlankRelief {
    double tip_m = 0, tip_length_m = 0;  // amount at the tip, and its extent; linear in between
    double crowning_m = 0;               // at both ends of the face width, parabolic in between

    bool of_profile() const { return tip_m > 0; }
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

// Abrasive wear of the flanks of one gear by Archard's law at constant load and speed. A point of a
// flank wears in proportion to its sliding distance per engagement, and this to the specific
// sliding |v_1 - v_2| / v of the worn flank. v_1 and v_2 are the speeds of the contact along the
// two flanks; they are proportional to the roll angles. The sliding is zero at the pitch point.
//
// Load sharing between tooth pairs is ignored, and so is the change of the load by the wear itself.
// Sources: Archard (1953), J. Appl. Phys. 24, 981-988; Flodin and Andersson (1997), Wear 207,
// 16-23.
class FlankWear {
  public:
    // `worn_gear`: 1 or 2 of the mesh. Throws std::invalid_argument if contact reaches the gear's
    // base circle, where the specific sliding has no bound.
    FlankWear(const MeshGeometry& mesh, int worn_gear);

    // Depth of the wear along the line of action, tau mesh periods after the start of the nominal
    // path of contact, as a fraction of its largest value on the path. Outside of the path it keeps
    // the value at the path's end.
    double shape(double tau) const;

  private:
    double sliding(double tau) const;

    MeshGeometry mesh_;
    int worn_gear_;
    double largest_ = 1;  // specific sliding
};

// Gap between the flanks of a tooth pair before and after its nominal path of contact.
//
// While both gears turn at their exact ratio, the tip corner of one tooth clears its mate's
// involute flank outside the path of contact. Before the path these are the corner of gear 2 and
// the flank of gear 1, after it the corner of gear 1 and the flank of gear 2. The gap is the
// distance along the line of action by which the gear with the flank would have to turn to close
// it. It grows with the square of the distance from the path. Deflected gears close it early and
// open it late (corner contact, extended contact): Munro, Morrish and Palmer (1999), Proc. IMechE C
// 213, 543-557; Singh and Houser (1990), AGMA 90-FTM; Lin, Wang, Oswald and Coy (1993), NASA TM
// 106174.
//
// Assumptions: the corner is sharp, the flank continues as an involute (radially below its base
// circle), and the force keeps the direction of the line of action.

// Gap of a tooth pair, m, tau mesh periods after the start of its nominal path of contact; 0 on the
// path, 0 <= tau <= contact ratio.
double corner_gap(const MeshGeometry& mesh, double tau);

// Distances before the start and after the end of the path, in mesh periods, at which the corner
// gap reaches a given size.
struct CornerReach {
    double before = 0, after = 0;
};

// At most kLongestReach on either side. gap_m >= 0.
inline constexpr double kLongestReach = 0.45;
CornerReach corner_reach(const MeshGeometry& mesh, double gap_m);

}  // namespace gearpod::gears
