// How the tooth pairs that touch share the mesh's force: all approach equally along the line of
// action, by their own compliance, their contact's and what their neighbours' forces do to the gear
// bodies,
//
//     delta = sum_j c_ij F_j + c_h(F_i) F_i   for every pair i that carries,   sum F_i = F.
//
// Without coupling and with a linear contact they are springs in parallel. Yang (2022),
// Eqs. 21-24.
#pragma once

#include <array>

#include "stiffness/contact/hertz_contact.hpp"

namespace gearpod::stiffness {

struct TouchingPairs {
    static constexpr int kMost = 8;
    int count = 0;
    // c_ij, m/N, symmetric; c_ii without the contact, infinite if the pair carries nothing.
    std::array<std::array<double, kMost>, kMost> compliance{};
    // The part of the face width on which they touch, and a factor on the contact's compliance.
    std::array<double, kMost> width{}, contact_factor{};
};

struct SharedLoad {
    double stiffness = 0;                              // F / delta, N/m; 0 if no pair carries
    std::array<double, TouchingPairs::kMost> share{};  // F_i / F
};

// Shares to 1e-14. A pair that its neighbours' forces would lift off carries nothing.
SharedLoad share_load(const TouchingPairs& pairs, const HertzContact& contact, double force_N);

}  // namespace gearpod::stiffness
