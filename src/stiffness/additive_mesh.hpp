// Gear pair whose tooth pairs are independent springs. Each is two beams and a linear Hertz contact
// in series:
//
//     k = 1 / (1 / k_h + 1 / k_beam1 + 1 / k_beam2),    total = sum over the pairs in contact.
//
// Sources: Tian (2004), Eqs. 2.35, 2.63; Liang (2016), Eqs. 2.2.32-2.2.33, 3.2.23-3.2.24. A fault
// changes the terms of its tooth's pair: the beam of its own gear, and k_h in proportion to the
// width of the tooth in contact (Tian, Eq. 3.1). Curves are Chebyshev series in the position. Their
// error is below 1e-12 (healthy) and 1e-8 (faulty) of the healthy tooth pair, or below the given
// tolerance.
#pragma once

#include "gears/mesh_geometry.hpp"
#include "stiffness/mesh_stiffness.hpp"
#include "stiffness/piecewise_curves.hpp"
#include "stiffness/teeth/chebyshev.hpp"
#include "stiffness/teeth/material.hpp"
#include "stiffness/teeth/tooth_profile.hpp"

namespace gearpod::stiffness {

class AdditiveMesh : public MeshStiffness {
  public:
    // `tolerance` is the error of the curves relative to their largest value; 0: smallest possible
    // error.
    AdditiveMesh(const gears::MeshGeometry& geometry, const Material& material, Profile profile,
                 double tolerance = 0);

    double contact_ratio() const override { return contact_ratio_; }
    double pitch_position() const override { return pitch_position_; }
    void total(std::span<const double> tau, double inside,
               std::span<double> stiffness) const override;
    void share(std::span<const double> tau, double inside, std::span<double> share) const override;
    std::vector<double> transitions() const override { return transitions_; }
    std::unique_ptr<const FaultyMesh> with_fault(const ToothFault& fault) const override;

    // Stiffness of one healthy tooth pair, N/m; 0 outside [0, contact ratio] (to 1e-10).
    double tooth_pair(double tau) const;
    // Stiffness at many positions in ascending order, with the same bits as one by one.
    void tooth_pair(std::span<const double> tau, std::span<double> stiffness) const;
    ToothPairCurve faulty_pair(const ToothFault& fault) const;

  private:
    friend class FaultyAdditiveMesh;

    double contact_ratio_, pitch_position_;
    double contact_;            // compliance of the full contact, m/N
    ChebyshevSeries beams_[2];  // compliance of each gear's tooth as a beam, m/N
    ChebyshevSeries pair_;
    ToothPairFit fit_;
    std::vector<double> transitions_;
};

}  // namespace gearpod::stiffness
