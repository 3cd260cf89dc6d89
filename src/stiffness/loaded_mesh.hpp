// Quasi-static contact of a gear pair under load: how far the gears approach along the line of
// action while they turn slowly under a constant force,
//
//     F = sum over touching tooth pairs j and slices s of k_js max(0, d - e_js),
//
// with the stiffness k and the gap e of each slice (relief, crowning, corner contact), which can
// push but not pull. d is the loaded static transmission error. Munro (1989); Smith, Gear Noise and
// Vibration (2003): with relief from the end of single contact on whose amount at the tip is the
// deflection of one pair, d is constant at that load.
#pragma once

#include <vector>

#include "stiffness/mesh_stiffness.hpp"

namespace gearpod::stiffness {

// A slice of a tooth pair as a spring that only pushes: stiffness, N/m, and gap, m.
struct ContactSpring {
    double stiffness = 0, gap = 0;
};

// The approach d at which springs carry a force together, m. Reorders the springs by their gaps.
// Without a force the smallest gap; infinite without any spring.
double approach_of(std::vector<ContactSpring>& springs, double force_N);

// Secant stiffness: that force over the approach, N/m; without a force the sum of the stiffnesses.
double secant_stiffness(std::vector<ContactSpring>& springs, double force_N);

class LoadedMesh {
  public:
    // The mesh must outlive it. force_N: along the line of action, positive or 0.
    LoadedMesh(const MeshStiffness& mesh, double force_N) : mesh_(mesh), force_(force_N) {}

    double force_N() const { return force_; }
    // d, m, at a position within the stretch of `inside` (mesh_stiffness.hpp).
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

// The springs of all tooth pairs that are engaged at a position within the stretch of `inside`.
void add_springs(const MeshStiffness& mesh, double tau, double inside,
                 std::vector<ContactSpring>& springs);

}  // namespace gearpod::stiffness
