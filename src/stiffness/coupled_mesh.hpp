// Gear pair whose tooth pairs share the load. Beams and Hertz contacts are as in AdditiveMesh. The
// gear bodies deform under each tooth root and, through the body, under its neighbours
// (foundation/fillet_foundation.hpp). Contacts may stiffen with the force they carry
// (src/stiffness/contact/load_sharing.hpp). The total is the mesh force over the approach of the
// gears along the line of action. Source: Yang (2022), section 2.1, extended to any number of pairs
// in contact.
//
// Curves are Chebyshev series in the position. Their error is below 1e-11 (healthy) and 1e-8 of the
// mean (faulty).
#pragma once

#include <vector>

#include "gears/mesh_geometry.hpp"
#include "stiffness/contact/load_sharing.hpp"
#include "stiffness/foundation/fillet_foundation.hpp"
#include "stiffness/mesh_stiffness.hpp"
#include "stiffness/teeth/chebyshev.hpp"
#include "stiffness/teeth/material.hpp"
#include "stiffness/teeth/tooth_profile.hpp"

namespace gearpod::stiffness {

struct CoupledMeshOptions {
    FoundationModel foundation = FoundationModel::none;
    Contact contact = Contact::linear;
    // Radius of the circle on which each gear's body is fixed (make_foundation).
    double body_radius_1_m = 0, body_radius_2_m = 0;
    double force_N = 0;  // mesh force along the line of action, for load-dependent contacts
    // Error of the curves relative to their largest value; 0: smallest possible error.
    double tolerance = 0;
};

class CoupledMesh : public MeshStiffness {
  public:
    // Throws std::invalid_argument for an impossible body or force, or for more than 8 pairs in
    // contact.
    CoupledMesh(const gears::MeshGeometry& geometry, const Material& material, Profile profile,
                const CoupledMeshOptions& options);

    double contact_ratio() const override { return geometry_.contact_ratio(); }
    double pitch_position() const override { return geometry_.pitch_position(); }
    void total(std::span<const double> tau, double inside,
               std::span<double> stiffness) const override;
    void share(std::span<const double> tau, double inside, std::span<double> share) const override;
    std::vector<double> transitions() const override { return transitions_; }
    std::unique_ptr<const FaultyMesh> with_fault(const ToothFault& fault) const override;

    // Displacement along the line of action of the pair at tau_j caused by a unit force on the pair
    // at tau_i, through both gear bodies, m/N. The positions are whole mesh periods apart.
    double coupling(double tau_i, double tau_j) const;
    // Compliances of one healthy tooth, m/N: as a beam, and of its foundation.
    double beam(int which, double tau) const { return beams_[which - 1](tau); }
    double foundation(int which, double tau) const;
    // Foundation of a gear, null if the gear has none.
    const FilletFoundation* body(int which) const { return bodies_[which - 1].get(); }

  private:
    friend class FaultyCoupledMesh;
    // Total and load shares of the pairs, youngest first, between two transitions.
    struct HealthyStretch {
        double begin, end;
        ChebyshevSeries total;
        std::vector<ChebyshevSeries> shares;
    };
    // Healthy pairs in contact at phase, 0 <= phase < 1 (or the limit at its end). They stand at
    // phase, phase + 1, ...
    SharedLoad healthy_load(double phase, int pairs) const;
    TouchingPairs touching(double phase, int pairs) const;
    const HealthyStretch& stretch_at(double phase) const;
    // Positions within a stretch of a mesh period, as phases.
    static std::vector<double> phases(std::span<const double> tau, double period,
                                      const HealthyStretch& stretch);

    double tolerance_;  // see CoupledMeshOptions
    gears::MeshGeometry geometry_;
    HertzContact contact_;
    double force_N_;
    std::unique_ptr<const FilletFoundation> bodies_[2];
    ChebyshevSeries beams_[2];    // over tau, m/N
    ChebyshevSeries foundation_;  // both gears together
    std::vector<double> transitions_;
    std::vector<HealthyStretch> stretches_;
};

}  // namespace gearpod::stiffness
