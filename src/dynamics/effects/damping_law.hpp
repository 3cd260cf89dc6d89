// Parts that all mesh-damping laws share. A law is a struct with
// - kText, its name in descriptions, and kParameters, its parameters in study files;
// - shape(k), the part of the damping that depends on the mesh stiffness k, N/m;
// - terms(p, m), how much of it a gearbox has: p are its parameters and m is the equivalent mass
//   m1 m2 / (m1 + m2) of the two gears, kg.
#pragma once

#include <array>
#include <string_view>

namespace gearpod::dynamics {

// Damping of a mesh, N s/m: factor times the law's shape of its stiffness, plus constant. The shape
// can thus be tabulated once over the mesh phase for all gearboxes.
struct DampingTerms {
    double factor = 0.0, constant = 0.0;
};

// Values of a law's parameters in SI units; the others are 0.
inline constexpr int kMostDampingParameters = 2;
using DampingParameters = std::array<double, kMostDampingParameters>;

// The same of W gearboxes.
template <int W, class Real = double>
struct DampingLanes {
    Real factor[W], constant[W];

    void set(int lane, const DampingTerms& terms) {
        factor[lane] = Real(terms.factor);
        constant[lane] = Real(terms.constant);
    }
};

struct DampingParameter {
    std::string_view key;     // "mesh_damping_time_s"
    std::string_view suffix;  // unit at the end of the key, "" for a pure number
    std::string_view unit;    // "s"; "1" for a pure number
    std::string_view doc;
};

}  // namespace gearpod::dynamics
