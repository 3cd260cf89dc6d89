// Compliance that a crack adds to a tooth, by linear elastic fracture mechanics. The energy release
// rate is integrated over the crack's area (Irwin 1957; Paris' appendix in H. Tada, P. C. Paris, G.
// R. Irwin, The Stress Analysis of Cracks Handbook; A. D. Dimarogonas, S. A. Paipetis, Analytical
// Methods in Rotor Dynamics, 1983),
//
//     delta c = 2 (1 - nu^2) / E  L  integral over the depth of (K_I^2 + K_II^2) / F^2 da,
//
// in plane strain, with the intensities of crack_path.hpp. The beam keeps all its sections. A crack
// closed by the force is treated as open (linear, as in the finite elements).
#pragma once

#include <vector>

#include "stiffness/teeth/crack_path.hpp"
#include "stiffness/teeth/material.hpp"

namespace gearpod::stiffness {

class CrackCompliance {
  public:
    // depth_m: along the crack, not negative.
    CrackCompliance(const CrackPath& path, const Material& material, double depth_m);

    // True if the crack has cut the tooth, which then carries no load.
    bool broken() const { return broken_; }
    // Added compliance, m/N, for a contact above the crack's start at this angle. Not valid for a
    // broken tooth.
    double added(double contact_angle) const;

  private:
    struct Point {
        double opening_weight, sliding_weight;
        CrackIntensity intensity;
    };
    bool broken_ = false;
    std::vector<Point> points_;
};

}  // namespace gearpod::stiffness
