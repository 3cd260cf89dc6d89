// Contact of single tooth pairs during a mesh period, seen at the integrator's steps: a lower bound
// of how far each is pressed together, and the contact loss ratio, the share of its engagement in
// which it carries no load.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "lockstep/plan/tooth_errors.hpp"

namespace gearpod::lockstep {

// True for the mesh periods in which contact loss is counted: one in kContactMeshes, spread evenly
// over a span and over the teeth of every gear (multiples of the golden ratio), mesh 0 among them.
inline constexpr unsigned kContactMeshes = 144;
// With `first` above 0: for the first so many.
constexpr bool counts_contact(int mesh, int first = 0) {
    if (first > 0) {
        return mesh < first;
    }
    return static_cast<std::uint32_t>(mesh) * 2654435769u < 0xffffffffu / kContactMeshes;
}

// Sums over time, mesh periods.
struct ContactTime {
    std::vector<double> engaged;   // [pair]: tooth pairs on the nominal path of contact
    machine::AlignedVector apart;  // [pair][lane]: of that, without contact

    // [pair][lane], the contact loss ratio; NaN of a pair whose teeth were not engaged.
    machine::AlignedVector ratio() const;
};

class ToothContact {
  public:
    // `mesh_period_s` holds one value a lane. The plan must outlive the object.
    ToothContact(const MarchPlan& plan, std::vector<double> mesh_period_s);

    // A lower bound of how far the tooth pairs are pressed together, [stretch][pair][tooth
    // pair][lane], m; infinite where a tooth pair is not engaged, minus infinite where the motion
    // is not finite. It covers the positions at which the integrator evaluates the contact forces
    // of each step. `gaps` are those of the mesh (tooth_gaps). With `orbit`, the record of a mesh
    // period without errors, the bound is that of the difference from it; such bounds add up to
    // bounds of sums.
    machine::AlignedVector least_pressing(const MeshRecord& record, std::span<const PairGaps> gaps,
                                          const MeshRecord* orbit) const;

    // Adds the time of a mesh period during which tooth pairs are apart within the nominal path of
    // contact, mesh periods, [pair][lane], in the lanes of the mask.
    void add_time_apart(const MeshRecord& record, std::span<const PairGaps> gaps,
                        std::span<const bool> lanes, machine::AlignedVector& apart) const;
    // Time that the tooth pairs of a gear pair spend on the nominal path in a mesh period.
    double time_engaged(int pair) const { return engaged_[static_cast<std::size_t>(pair)]; }

    // The same of one step's start, at which the positions are `q`, [degree of freedom][lane]: adds
    // `weight` for each tooth pair on the nominal path, and for each that is apart.
    void add_position(int step, const machine::AlignedVector& q, std::span<const PairGaps> gaps,
                      double weight, ContactTime& time) const;

  private:
    struct Entry {
        std::size_t degree = 0;
        double weight = 0.0;
    };
    // A slice of a tooth pair at a stage node.
    struct Tooth {
        std::size_t contact = 0, tooth = 0;  // in the tables of springs and of tooth pairs
        double place = 0.0;                  // on the path of contact (StiffnessNodes::tooth_place)
        double shared = 0.0;                 // the part of its gap that all lanes have, m
        bool nominal = false;                // within the nominal path of contact
    };
    // A stage node of a step at which tooth pairs of a gear pair are engaged.
    struct Node {
        int step = 0;
        bool first = false;   // the first stage node of its step
        double part = 0.0;    // of the step
        double length = 0.0;  // of the step, mesh periods
        double error = 0.0;   // static transmission error of the gear pair, m
        std::vector<Tooth> teeth;
    };
    class OwnGaps;

    void add_node(int pair, int step, std::size_t node);
    void least_deflection(const Node& node, const double* at, const double* rate,
                          double* least) const;
    void add_apart(const Node& node, std::size_t pair, const double* d, OwnGaps& own,
                   const double* weight, machine::AlignedVector& apart) const;
    void deflect(const MeshRecord& record, int pair, double sign, std::size_t first_degree,
                 machine::AlignedVector& d) const;

    const MarchPlan& plan_;
    const std::vector<double> mesh_period_s_;
    const std::size_t contacts_;
    std::vector<std::vector<Node>> nodes_;  // [pair], by step and stage node
    std::vector<std::vector<Entry>> row_;   // [pair]: of its deflection
    std::vector<double> engaged_;           // [pair]
};

}  // namespace gearpod::lockstep
