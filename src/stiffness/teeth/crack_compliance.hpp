// Compliance that a crack adds to a tooth, by linear elastic fracture mechanics: the energy release
// rate, integrated over the crack's area (Irwin 1957; Paris' appendix in H. Tada, P. C. Paris, G.
// R. Irwin, The Stress Analysis of Cracks Handbook; A. D. Dimarogonas, S. A. Paipetis, Analytical
// Methods in Rotor Dynamics, 1983),
//
//     delta c = 2 (1 - nu^2) / E  L  integral over the depth of (K_I^2 + K_II^2) / F^2 da,
//
// in plane strain, with the intensities of crack_path.hpp. The beam keeps all its sections. A crack
// that the force presses shut counts as open (linear, as in the finite elements).
#pragma once

#include <vector>

#include "stiffness/teeth/crack_path.hpp"
#include "stiffness/teeth/material.hpp"

namespace gearpod::stiffness {

class CrackCompliance {
  public:
    // depth_m: along the crack, not negative.
    CrackCompliance(const CrackPath& path, const Material& material, double depth_m);

    // The crack has cut the tooth, which then carries nothing.
    bool broken() const { return broken_; }
    // m/N, for a contact above the crack's start at this angle; not for a broken tooth.
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
