// Compliance of the gear body at a tooth's root and at its neighbours' roots: the displacement of
// one tooth along the line of action under a force on it or on another tooth, m/N.
#pragma once

#include "stiffness/teeth/material.hpp"
#include "stiffness/teeth/tooth_profile.hpp"

namespace gearpod::stiffness {

// Compliance of a tooth's own foundation by powers of the force's lever over the root's width, u_f
// / S_f. A crack that reduces the root's width increases that ratio by the factor f > 1.
struct FoundationCompliance {
    double squared = 0, linear = 0, constant = 0;  // m/N
    double total(double f = 1) const { return (squared * f + linear) * f + constant; }
};

// Foundation of one gear's teeth. Immutable; shared by threads.
class FilletFoundation {
  public:
    virtual ~FilletFoundation() = default;
    // Compliance of a tooth in contact at the contact angle (alpha_1 or beta_1).
    virtual FoundationCompliance self(double contact_angle) const = 0;
    // Displacement of tooth j, in contact at angle_j, under a unit force on tooth i, in contact at
    // angle_i, m/N. teeth_apart: from i to j, positive in the direction in which the force pushes
    // the teeth. Unchanged if i and j are exchanged and teeth_apart is negated (Maxwell).
    virtual double coupling(double angle_i, double angle_j, int teeth_apart) const = 0;
};

enum class FoundationModel { none, sainsot, elastic_ring };

}  // namespace gearpod::stiffness
