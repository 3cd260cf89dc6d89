// Compliance of tooth contacts, and the shares of the load of the tooth pairs that touch.
#pragma once

#include <array>

#include "stiffness/teeth/material.hpp"

namespace gearpod::stiffness {

// Compliance of the contact of two teeth, m/N.
//     linear          1 / k_h of material.hpp, independent of the load.
//     load_dependent  k_h = E^0.9 L^0.8 F^0.1 / 1.37 with the pair's own force F; Yang (2022),
//                     Eq. 19. Secant stiffness: F / k_h is the approach. For helical teeth times
//                     Material::contact_factor^1.1.
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

// Sharing of the mesh force among the tooth pairs in contact. All pairs have the same approach
// along the line of action. It results from the compliance of each pair, the compliance of its
// contact, and the deformation of the gear bodies by its neighbours' forces:
//
//     delta = sum_j c_ij F_j + c_h(F_i) F_i   for every pair i that carries load,   sum F_i = F.
//
// Without coupling and with linear contacts the pairs are springs in parallel. Yang (2022), Eqs.
// 21-24.
struct TouchingPairs {
    static constexpr int kMost = 8;
    int count = 0;
    // c_ij, m/N, symmetric. c_ii excludes the contact and is infinite if the pair carries no load.
    std::array<std::array<double, kMost>, kMost> compliance{};
    // Fraction of the face width in contact, and a factor on the contact's compliance.
    std::array<double, kMost> width{}, contact_factor{};
};

struct SharedLoad {
    double stiffness = 0;                              // F / delta, N/m; 0 if no pair carries load
    std::array<double, TouchingPairs::kMost> share{};  // F_i / F
};

// Load sharing, with shares accurate to 1e-14. A pair that its neighbours' forces would lift off
// carries no load.
SharedLoad share_load(const TouchingPairs& pairs, const HertzContact& contact, double force_N);

}  // namespace gearpod::stiffness
