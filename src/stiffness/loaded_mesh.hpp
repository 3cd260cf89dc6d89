// Quasi-static contact of a gear pair under load. The approach d of the gears along the line of
// action, while they turn slowly under a constant force F, follows from
//
//     F = sum over tooth pairs j in contact and slices s of k_js max(0, d - e_js),
//
// with the stiffness k and the gap e of each slice (relief, crowning, corner contact). Contacts are
// unilateral: they carry compression only. d is the loaded static transmission error. Relief may
// start at the end of single contact, with the deflection of one pair as its amount at the tip.
// Then d is constant at that load (Munro 1989; Smith, Gear Noise and Vibration (2003)).
#pragma once

#include <vector>

#include "machine/contracts.hpp"
#include "stiffness/mesh_stiffness.hpp"

namespace gearpod::stiffness {

// Unilateral spring of a slice of a tooth pair: stiffness, N/m, and gap, m.
struct ContactSpring {
    double stiffness = 0, gap = 0;
};

// Approach d, m, at which the springs together carry a force. Reorders the springs by their gaps.
// Returns the smallest gap if the force is 0, and infinity without springs.
double approach_of(std::vector<ContactSpring>& springs, double force_N);

// Secant stiffness, N/m: the force over the approach; without a force, the sum of the stiffnesses.
double secant_stiffness(std::vector<ContactSpring>& springs, double force_N);

class LoadedMesh {
  public:
    // The mesh must outlive the object. force_N: along the line of action.
    LoadedMesh(const MeshStiffness& mesh, double force_N) : mesh_(mesh), force_(force_N) {
        EXPECTS(force_N >= 0.0);
    }

    double force_N() const { return force_; }
    // Approach d, m, at a position within the stretch of `inside` (mesh_stiffness.hpp).
    double approach(double tau, double inside) const;

    // Least, largest and mean approach over a mesh period.
    struct Range {
        double least = 0, largest = 0, mean = 0;
        double peak_to_peak() const { return largest - least; }
    };
    Range range() const;

  private:
    const MeshStiffness& mesh_;
    double force_;
};

// Appends the springs of all tooth pairs that are engaged at a position within the stretch of
// `inside`.
void add_springs(const MeshStiffness& mesh, double tau, double inside,
                 std::vector<ContactSpring>& springs);

}  // namespace gearpod::stiffness
