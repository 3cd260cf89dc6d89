// How far a tooth's root gives way with the gear body, and how far its neighbours' roots do: the
// displacement along the line of action, m/N, of one tooth under a force on it or on another one.
#pragma once

#include "stiffness/teeth/material.hpp"
#include "stiffness/teeth/tooth_profile.hpp"

namespace gearpod::stiffness {

// Compliance of a tooth's own foundation by powers of the force's lever over the root's width, u_f
// / S_f. A crack that takes part of the root's width makes that lever longer, f > 1.
struct FoundationCompliance {
    double squared = 0, linear = 0, constant = 0;  // m/N
    double total(double f = 1) const { return (squared * f + linear) * f + constant; }
};

// Immutable; shared by threads.
class FilletFoundation {
  public:
    virtual ~FilletFoundation() = default;
    // Of a tooth touched at the contact angle (alpha_1 or beta_1).
    virtual FoundationCompliance self(double contact_angle) const = 0;
    // Displacement of tooth j, touched at angle_j, by a unit force on tooth i, touched at angle_i,
    // m/N. teeth_apart: from i to j, positive in the direction in which the force pushes the teeth.
    // The same with i and j exchanged and teeth_apart negated (Maxwell).
    virtual double coupling(double angle_i, double angle_j, int teeth_apart) const = 0;
};

enum class FoundationModel { none, sainsot, elastic_ring };

}  // namespace gearpod::stiffness
