// Abrasive wear of the flanks of one gear by Archard's law at constant load and speed. A point of a
// flank wears in proportion to its sliding distance per engagement, and this to the specific
// sliding |v_1 - v_2| / v of the worn flank. v_1 and v_2 are the speeds of the contact along the
// two flanks; they are proportional to the roll angles. The sliding is zero at the pitch point.
//
// Load sharing between tooth pairs is ignored, and so is the change of the load by the wear itself.
// Sources: Archard (1953), J. Appl. Phys. 24, 981-988; Flodin and Andersson (1997), Wear 207,
// 16-23.
#pragma once

#include "gears/mesh_geometry.hpp"

namespace gearpod::gears {

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

}  // namespace gearpod::gears
