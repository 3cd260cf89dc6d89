// Compliance of the contact of two teeth, m/N.
//     linear          1 / k_h of material.hpp, independent of the load.
//     load_dependent  k_h = E^0.9 L^0.8 F^0.1 / 1.37 with the pair's own force F; Yang (2022),
//                     Eq. 19. Secant stiffness: F / k_h is the approach. For helical teeth times
//                     Material::contact_factor^1.1.
#pragma once

#include "stiffness/teeth/material.hpp"

namespace gearpod::stiffness {

enum class Contact { linear, load_dependent };

class HertzContact {
  public:
    HertzContact(const Material& material, Contact contact);
    bool load_dependent() const { return contact_ == Contact::load_dependent; }
    // width: fraction of the face width in contact, 0 to 1. The compliance is infinite where it is
    // 0.
    double compliance(double force_N, double width = 1) const;

  private:
    Contact contact_;
    double unit_;  // compliance at width 1 and, if load-dependent, at 1 N
};

}  // namespace gearpod::stiffness
