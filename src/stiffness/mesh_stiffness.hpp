// Mesh stiffness of one gear pair: in total and per tooth pair, healthy or while a faulty tooth
// passes.
//
// Positions tau count mesh periods since the start of one tooth pair's engagement; the pairs that
// engaged before and after it stand at tau + 1, tau - 1 and so on. A stretch is an interval of tau
// in which no tooth pair enters or leaves and the fault causes no jump. `inside` is a position
// strictly within a stretch and determines the pairs in contact. Values at the ends of the stretch
// are the limits from within it.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "stiffness/teeth/tooth_fault.hpp"

namespace gearpod::stiffness {

// Gear pair while a faulty tooth passes. Immutable.
class FaultyMesh {
  public:
    virtual ~FaultyMesh() = default;
    // Mesh periods from the first faulty tooth's engagement until the last faulty tooth leaves.
    virtual double duration() const = 0;
    // Total stiffness, N/m, at ascending positions within one stretch. tau counts from the
    // engagement of the first faulty tooth, 0 <= tau <= duration().
    virtual void total(std::span<const double> tau, double inside,
                       std::span<double> stiffness) const = 0;
    // Contribution of one tooth pair, which engages `tooth` periods after the first faulty tooth
    // (before it if negative). 0 where the pair does not touch. A mesh with coupled tooth pairs
    // computes these curves at the first call.
    virtual void tooth_pair(int tooth, std::span<const double> tau, double inside,
                            std::span<double> stiffness) const = 0;
    // Stiffness of one slice of that tooth pair (MeshStiffness::slices).
    virtual void slice_stiffness(int tooth, int /*slice*/, std::span<const double> tau,
                                 double inside, std::span<double> stiffness) const {
        tooth_pair(tooth, tau, inside, stiffness);
    }
    // Sum over the tooth pairs on their nominal paths of contact, N/m (MeshStiffness::path_total).
    virtual void path_total(std::span<const double> tau, double inside,
                            std::span<double> stiffness) const {
        total(tau, inside, stiffness);
    }
    // Spur pair with the fault that represents the slices of a helical pair (MeshStiffness::slice).
    virtual const FaultyMesh& slice() const { return *this; }
    // Ascending positions at which the fault itself makes the total jump.
    virtual std::vector<double> jumps() const { return {}; }
};

// Healthy gear pair. Immutable; shared by threads.
class MeshStiffness {
  public:
    virtual ~MeshStiffness() = default;
    // Duration of a tooth pair's engagement, mesh periods.
    virtual double contact_ratio() const = 0;
    // Mesh periods from the start of an engagement to the contact at the pitch point.
    virtual double pitch_position() const = 0;
    // Position of the contact on the flank, averaged over the face: -1/2 at the start of the path
    // of contact, 1/2 at its end. Linear in tau for spur teeth.
    virtual double flank_position(double tau) const { return tau / contact_ratio() - 0.5; }
    // Nominal path of contact, in positions tau. It is the whole engagement unless teeth may touch
    // before and after it (gapped_mesh.hpp).
    virtual double path_begin() const { return 0; }
    virtual double path_end() const { return contact_ratio(); }
    // Spur pair that represents the slices of a helical pair, as wide as all of them together. A
    // spur pair returns itself.
    virtual const MeshStiffness& slice() const { return *this; }
    // Total stiffness, N/m, at ascending positions within one stretch.
    virtual void total(std::span<const double> tau, double inside,
                       std::span<double> stiffness) const = 0;
    // Sum over the tooth pairs on their nominal paths of contact, N/m. Mesh damping is proportional
    // to it. Equal to the total unless tooth pairs have gaps.
    virtual void path_total(std::span<const double> tau, double inside,
                            std::span<double> stiffness) const {
        total(tau, inside, stiffness);
    }
    // Load share, 0 to 1, of the tooth pair at tau; 0 outside its engagement.
    virtual void share(std::span<const double> tau, double inside,
                       std::span<double> share) const = 0;
    // Number of slices across the face into which a tooth pair is divided where its gap varies.
    virtual int slices() const { return 1; }
    // True if tooth pairs have individual gaps: relief, crowning or corner contact.
    virtual bool has_gaps() const { return false; }
    // One slice of the tooth pair at tau: its stiffness in N/m (0 outside its engagement), its gap
    // in m and its position on the flank (flank_position).
    virtual void slice_stiffness(int slice, std::span<const double> tau, double inside,
                                 std::span<double> stiffness) const;
    virtual double slice_gap(int /*slice*/, double /*tau*/) const { return 0; }
    // Gap of that slice by wear of unit depth, if the flanks of one gear wear (gears::FlankWear).
    virtual double slice_wear(int /*slice*/, double /*tau*/) const { return 0; }
    virtual double slice_flank_position(int /*slice*/, double tau) const {
        return flank_position(tau);
    }
    // Share of the face of that slice that is on the nominal path of contact, 0 to 1.
    virtual double slice_on_path(int /*slice*/, double /*tau*/) const { return 1; }
    // Phases in [0, 1), ascending, that bound the stretches: starts and ends of engagements, and
    // kinks of the total. The first is 0, the start of an engagement.
    virtual std::vector<double> transitions() const = 0;
    // Gear pair with a fault on one of its gears. Mesh and fault must outlive the result. Throws
    // std::invalid_argument if the model cannot represent the change by the fault.
    virtual std::unique_ptr<const FaultyMesh> with_fault(const ToothFault& fault) const = 0;
};

// Calls with_fault() and returns a mesh that owns the fault.
std::shared_ptr<const FaultyMesh> faulty_mesh(const MeshStiffness& mesh,
                                              std::unique_ptr<const ToothFault> fault);

// Transitions of a mesh with the given contact ratio: 0 and the fraction of the ratio. Only 0 if
// both coincide (to 1e-10).
std::vector<double> contact_transitions(double contact_ratio);

// Total stiffness at any position; at an end of a stretch the limit from above or from below.
enum class Limit { from_above, from_below };
double total_at(const MeshStiffness& mesh, double tau, Limit limit = Limit::from_above);
// Total stiffness with a fault. `transitions` are those of the healthy mesh.
double total_at(const FaultyMesh& mesh, std::span<const double> transitions, double tau,
                Limit limit = Limit::from_above);

// Mean of the total stiffness over a mesh period, with a relative error below 1e-12.
double mean_total(const MeshStiffness& mesh);

}  // namespace gearpod::stiffness
