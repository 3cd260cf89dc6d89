// Contact of single tooth pairs during a mesh period, evaluated at the integrator's steps: a lower
// bound of the compression of each, and the contact loss ratio. The latter is the fraction of its
// engagement in which a tooth pair carries no load.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "lockstep/plan/tooth_pairs.hpp"
#include "machine/ids.hpp"

namespace gearpod::lockstep {

// True for mesh periods in which contact loss is counted. These are one in kContactMeshes,
// including mesh period 0. Multiples of the golden ratio spread them evenly over a span and over
// the teeth of every gear.
inline constexpr unsigned kContactMeshes = 144;
// With a positive `first`, counts the first `first` mesh periods instead.
constexpr bool counts_contact(int mesh, int first = 0) {
    if (first > 0) {
        return mesh < first;
    }
    return static_cast<std::uint32_t>(mesh) * 2654435769u < 0xffffffffu / kContactMeshes;
}

// Sums over time, mesh periods.
struct ContactTime {
    std::vector<double> engaged;   // [pair]: tooth pairs on the nominal path of contact
    machine::AlignedVector apart;  // [pair][lane]: part of this without contact

    // Contact loss ratio, [pair][lane]; NaN for a pair whose teeth were not engaged.
    machine::AlignedVector ratio() const;
};

class ToothContact {
  public:
    // `mesh_period_s` has one value per lane. The plan must outlive the object.
    ToothContact(const IntegrationPlan& plan, std::vector<double> mesh_period_s);

    // Lower bound of the compression of the tooth pairs, [stretch][pair][tooth pair][lane], m. It
    // is infinite where a tooth pair is not engaged, and minus infinite if the motion is not
    // finite. It covers all positions at which the integrator evaluates the contact forces of a
    // step. `gaps` are those of the mesh period (tooth_gaps). With `periodic_orbit`, the record of
    // a mesh period without errors, it bounds the difference from that record; such bounds add up
    // to bounds of sums.
    machine::AlignedVector least_compression(const MeshRecord& record,
                                             std::span<const PairGaps> gaps,
                                             const MeshRecord* periodic_orbit) const;

    // Adds the time during which tooth pairs are separated within the nominal path of contact, in
    // mesh periods, [pair][lane], for the lanes in the mask. `overrides` are those of the mesh
    // period.
    void add_separation_time(const MeshRecord& record, const MeshOverrides& overrides,
                             std::span<const bool> lanes, machine::AlignedVector& apart) const;
    // Time that the tooth pairs of a gear pair spend on the nominal path, mesh periods per mesh
    // period.
    double time_engaged(PairId pair) const { return engaged_[pair]; }

    // Same for the start of one step with positions `q`, [degree of freedom][lane]. Adds `weight`
    // to the engaged time of each tooth pair on the nominal path, and to the time apart of each
    // separated one.
    void add_position(int step, const machine::AlignedVector& q, const MeshOverrides& overrides,
                      double weight, ContactTime& time) const;

  private:
    struct Entry {
        std::size_t degree = 0;
        double weight = 0.0;
    };
    // Slice of a tooth pair at a stage node.
    struct Tooth {
        std::size_t contact = 0, tooth = 0;  // indices in the tables of springs and of tooth pairs
        double position = 0.0;  // on the path of contact (StiffnessNodes::tooth_position)
        double shared = 0.0;    // part of its gap common to all lanes, m
        double wear = 0.0;      // part by wear of unit depth
        double on_path = 0.0;   // share of its face on the nominal path of contact
    };
    // Stage node of a step, with the tooth pairs of a gear pair engaged at it.
    struct Node {
        int step = 0;
        bool first = false;   // first stage node of its step
        double part = 0.0;    // position within the step, 0 to 1
        double length = 0.0;  // of the step, mesh periods
        double error = 0.0;   // static transmission error of the gear pair, m
        std::vector<Tooth> teeth;
    };
    class LaneGaps;

    void add_node(PairId pair, int step, std::size_t node);
    void least_deflection(const Node& node, const double* deflection_start, const double* rate,
                          double* least) const;
    void add_separation(const Node& node, PairId pair, const double* d, LaneGaps& lane_gaps,
                        const double* weight, machine::AlignedVector& apart) const;
    void deflect(const MeshRecord& record, PairId pair, double sign, std::size_t first_degree,
                 machine::AlignedVector& d) const;

    const IntegrationPlan& plan_;
    const std::vector<double> mesh_period_s_;
    const std::size_t contacts_;
    std::vector<std::vector<Node>> nodes_;  // [pair], by step and stage node
    std::vector<std::vector<Entry>> row_;   // [pair]: sparse weights of its deflection
    std::vector<double> engaged_;           // [pair]
};

}  // namespace gearpod::lockstep
