// Fault of a study: its names, sizes and unit, and the gear pairs that it weakens or wears.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "lockstep/plan/fault_schedule.hpp"
#include "lockstep/plan/stiffness_nodes.hpp"
#include "mc/study/faults/fault_kind.hpp"
#include "mc/study/schema/schema.hpp"
#include "stiffness/mesh_stiffness.hpp"

namespace gearpod::mc {

struct SceneMesh;

struct FaultPlan {
    std::string kind;               // in study files, "spatial-crack"; "" without a fault
    std::string words = "a fault";  // in messages, "a spatial crack"
    std::string title;              // in descriptions, "tooth crack"
    std::string location;           // "planet 1, sun side"
    // Location on the tooth, and the datum from which the sizes are measured.
    std::string origin;
    SizeShare share{};  // part of the tooth that a size takes
    // Gives the size; without a fault, the depth of a crack, which is then 0.
    const Key* size_key = nullptr;
    // Sizes at which stiffness curves are shown: the levels, or the edges of groups, without 0.
    // Ascending, SI.
    std::vector<double> sizes;
    bool groups = false;  // the sizes are edges of groups

    bool given() const { return !kind.empty(); }
    const Unit& unit() const { return size_key->unit; }
    // "crack_3mm", or "chip_0.1" for a pure number.
    std::string name_at(double size) const;
};
FaultPlan make_fault_plan(const Study& study);

// Gear pairs that the faulty tooth weakens, when, and by how much; or pairs with worn flanks.
class SceneFault {
  public:
    // The meshes outlive the fault. Throws SceneError.
    SceneFault(const Study& study, const std::vector<SceneMesh>& meshes,
               const lockstep::PairSet& pairs);

    const FaultPlan& plan() const { return plan_; }
    // Passages of the faulty tooth; empty without a fault and for wear.
    const lockstep::FaultPattern& pattern() const { return pattern_; }
    // Number of meshes that the tooth weakens, each with its own stiffness curve.
    int curves() const { return static_cast<int>(laws_.size()); }
    // Pairs whose flanks wear; their depth is the fault's size.
    const std::vector<int>& worn_pairs() const { return worn_pairs_; }
    // Mesh with the faulty tooth of that size; null if the size is 0 or there is no fault.
    std::shared_ptr<const stiffness::FaultyMesh> mesh(int curve, double size) const;
    // Size at which the tooth transmits no load, or above which the fault model is undefined; 0 if
    // there is none.
    double largest_size() const;
    // Mesh phases at which a fault's stiffness jumps, whatever its size.
    std::vector<double> jumps(const lockstep::PairSet& pairs) const;

  private:
    struct Law {
        const stiffness::MeshStiffness* mesh;
        std::unique_ptr<const stiffness::ToothFaultFamily> family;
    };
    FaultPlan plan_;
    std::vector<Law> laws_;
    std::vector<int> worn_pairs_;
    lockstep::FaultPattern pattern_;
};

// First gear pair in which the faulty tooth engages, for each of its stiffness curves.
std::vector<int> faulty_pairs(const SceneFault& fault);

}  // namespace gearpod::mc
