// How far a tooth's root gives way with the gear body, and how far its neighbours' roots do: the
// displacement along the line of action, m/N, of one tooth under a force on it or on another one.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "gears/gear.hpp"
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

// The root's half angle and the ratio of root and clamped radius where they lie outside the range
// for which the model is fitted, one sentence each; empty if it covers them.
std::vector<std::string> foundation_warnings(const gears::Gear& gear, Profile profile,
                                             FoundationModel model, double body_radius_m);

// body_radius_m: the circle on which the gear body is held, the bore of an external gear and the
// outer circle of an internal one. Null without a foundation: for FoundationModel::none, and for an
// internal gear under Sainsot's formula, which is fitted to external ones. Throws
// std::invalid_argument if the circle does not lie within the body (external: inside the root
// circle; internal: outside it).
std::unique_ptr<const FilletFoundation> make_foundation(const gears::Gear& gear,
                                                        const Material& material, Profile profile,
                                                        FoundationModel model,
                                                        double body_radius_m);

}  // namespace gearpod::stiffness
