// Stiffness of healthy tooth pairs through a mesh, N/m. Positions and phases in mesh periods.
// Sources: Tian (2004), Eqs. 2.35, 2.63; Liang (2016), Eqs. 2.2.32-2.2.33, 3.2.23-3.2.24.
#pragma once

#include <span>
#include <vector>

#include "gears/mesh_geometry.hpp"
#include "stiffness/chebyshev.hpp"
#include "stiffness/material.hpp"
#include "stiffness/tooth_profile.hpp"

namespace gearpod::stiffness {

enum class Side { before, after };

// A value; all members are const after construction and may be shared by threads.
class PairStiffness {
  public:
    PairStiffness(const gears::MeshGeometry& geometry, const Material& material, Profile profile);
    // A tooth pair of one stiffness wherever it touches (lumped gearboxes); with contact ratio 1
    // the mesh is constant.
    static PairStiffness constant(double stiffness_N_m, double contact_ratio = 1);
    static PairStiffness constant(double stiffness_N_m, double contact_ratio,
                                  double pitch_position);

    double contact_ratio() const { return contact_ratio_; }
    double pitch_position() const { return pitch_position_; }

    // One tooth pair, tau mesh periods after its engagement began; 0 outside [0, contact ratio] (to
    // 1e-10).
    double tooth_pair(double tau) const;
    // The same for many positions in ascending order.
    void tooth_pair(std::span<const double> tau, std::span<double> stiffness) const;

    // All tooth pairs in contact at a phase (any real number) counted from the start of an
    // engagement. At a transition (to 1e-10): the limit from the chosen side.
    double mesh(double phase, Side side = Side::after) const;
    // Phases in [0, 1), ascending, where the number of touching pairs changes: 0 (a pair engages)
    // and the fraction of the contact ratio (a pair leaves); only 0 if the two coincide, none if
    // the mesh is constant.
    const std::vector<double>& transitions() const { return transitions_; }
    // Mesh stiffness averaged over a mesh period.
    double mean() const;

  private:
    PairStiffness() = default;
    void find_transitions();

    double contact_ratio_ = 1, pitch_position_ = 0;
    ChebyshevSeries series_;
    std::vector<double> transitions_;
};

}  // namespace gearpod::stiffness
