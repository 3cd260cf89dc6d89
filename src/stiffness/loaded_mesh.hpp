// The static transmission error of a gear pair under load, with flanks that are not perfect: how
// far the gears approach along the line of action while they turn slowly under a constant force,
//
//     F = sum_j k_j max(0, d - e_j),
//
// over the tooth pairs that touch: k_j the stiffness and e_j the gap of each (relief), which only
// push. Munro (1989); Smith, Gear Noise and Vibration (2003): with relief from the end of single
// contact on whose amount at the tip is the deflection of one pair, d is constant at that load.
// Pairs coupled through elastic bodies have the k_j of all of them in contact, as the march has.
//
// Across the face the teeth are thin slices (helical_mesh.hpp), each of which only pushes: those of
// helical teeth are touched one after the other, and crowning, a parabola that leaves its amount at
// both ends, gives each a gap of its own. Crowned spur teeth that touch on their whole width
// approach by a third of the crowning more.
#pragma once

#include <functional>
#include <vector>

#include "stiffness/mesh_stiffness.hpp"

namespace gearpod::stiffness {

class LoadedMesh {
  public:
    // gap(tau): m, of a slice of the tooth pair tau mesh periods after its engagement began; kinks:
    // where it is not smooth, ascending; crowning: of both gears together. The mesh must outlive
    // it.
    LoadedMesh(const MeshStiffness& mesh, std::function<double(double)> gap,
               std::vector<double> kinks, double force_N, double crowning_m = 0);

    double force_N() const { return force_; }
    // d, m, at a position within the stretch of `inside` (mesh_stiffness.hpp).
    double approach(double tau, double inside) const;
    // What the gaps add to the approach of perfect flanks, F / k: the pair's static transmission
    // error for the mesh laws that know the total alone; and its rate, m per mesh period.
    double error(double tau, double inside) const;
    double error_rate(double tau, double inside) const;

    // Least, largest and mean approach over a mesh period.
    struct Range {
        double least = 0, largest = 0, mean = 0;
        double peak_to_peak() const { return largest - least; }
    };
    Range range() const;

    // Phases in [0, 1), ascending, at which the approach jumps or kinks, the first 0.
    const std::vector<double>& phases() const { return phases_; }

  private:
    struct TouchingPair {
        double stiffness, gap;
    };
    static double approach_of(std::vector<TouchingPair> pairs, double force);
    // The tooth pairs of a slice that stands at tau, `part` of the width.
    void add_slice(double tau, double inside, double part, double gap,
                   std::vector<TouchingPair>& pairs) const;
    // `part` of the width where the slices' positions run from `begin` to `end`, smoothly.
    void add_slices(double begin, double end, double tau, std::vector<TouchingPair>& pairs) const;

    const MeshStiffness& mesh_;
    const MeshStiffness& slice_;  // of the whole width
    std::function<double(double)> gap_;
    double force_, crowning_, overlap_;
    std::vector<double> slice_phases_;  // where the slices' stiffness jumps or their gap kinks
    std::vector<double> phases_;
};

}  // namespace gearpod::stiffness
