// Fault of a study, and mesh stiffness of its healthy gear pairs.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "gears/mesh_geometry.hpp"
#include "gears/tooth_deviations.hpp"
#include "lockstep/plan/fault_schedule.hpp"
#include "lockstep/plan/stiffness_nodes.hpp"
#include "machine/ids.hpp"
#include "mc/plan/drivetrain.hpp"
#include "mc/study/faults/fault_kind.hpp"
#include "mc/study/gears.hpp"
#include "mc/study/schema/schema.hpp"
#include "stiffness/foundation/fillet_foundation.hpp"
#include "stiffness/loaded_mesh.hpp"
#include "stiffness/mesh_stiffness.hpp"

namespace gearpod::mc {

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
    // "a crack in planet 1, sun side"; "" without a fault.
    std::string phrase() const { return given() ? words + " in " + location : ""; }
    // "crack_3mm", or "chip_0.1" for a pure number.
    std::string name_at(double size) const;
};
FaultPlan make_fault_plan(const Study& study);

// One kind of gear pair. It has no geometry if the stiffness is given instead of tooth shapes.
struct SceneMesh {
    MeshMembers members;
    std::optional<gears::MeshGeometry> geometry;
    std::unique_ptr<const stiffness::MeshStiffness> stiffness;
    // Quasi-static contact under the mean force of a pair, including the flanks' gaps.
    std::unique_ptr<const stiffness::LoadedMesh> loaded;
    // Elastic bodies of the two gears, if modelled.
    const stiffness::FilletFoundation* body[2] = {nullptr, nullptr};
};

// Radius of the circle on which a gear's body is held, m; 0 if the study gives none.
double body_radius_m(const Study& study, Member member);

// Upper estimate of the single pitch errors of a member's teeth, m: the tolerance of their grade
// plus three times a given rms, and at least the largest measured deviation.
double pitch_error_m(const Study& study, Member member);

// Given mean stiffness of a mesh, N/m, in the transverse plane.
double given_mean_stiffness(const Study& study, MeshKind mesh);

// Makes one mesh for each of meshes_of(kind). force_N: mean force of a pair, for load-dependent
// contact and for the flanks' gaps. Throws SceneError.
std::vector<SceneMesh> make_meshes(const Study& study, double force_N);

// All gear pairs of the gearbox and their phases.
lockstep::PairSet make_pairs(const std::vector<SceneMesh>& meshes, const Drivetrain& drivetrain);

// Mean stiffness of all pairs of a gearbox with constant stiffness, N/m; also without teeth.
std::vector<double> constant_pairs(const Study& study);

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
std::vector<PairId> faulty_pairs(const SceneFault& fault);

// Stiffness of a study's gear pairs, healthy and with the fault, and the scales of their tooth
// errors. Scenes share it unless they differ in numerics.stiffness_tolerance.

class SceneStiffness {
  public:
    // Throws SceneError.
    SceneStiffness(const Study& study, const Drivetrain& drivetrain);
    SceneStiffness(const SceneStiffness&) = delete;
    SceneStiffness& operator=(const SceneStiffness&) = delete;

    const std::vector<SceneMesh>& meshes() const { return meshes_; }
    const lockstep::PairSet& pairs() const { return pairs_; }
    const SceneFault& fault() const { return fault_; }
    // Mean stiffness of every pair over the mesh period, N/m.
    const std::vector<double>& mean_pairs() const { return mean_pairs_; }
    // Scales of the tooth errors of ISO 1328 grade 5; all 0 without a quality.
    const MemberArray<gears::DeviationScales>& tooth_scales() const { return tooth_scales_; }
    // Largest stiffness of every gear pair, with all tooth pairs in contact that can touch, N/m. It
    // bounds the integrator's step.
    std::vector<double> stiffest_pairs() const;
    // Phases in [0, 1) at which steps must end.
    std::vector<double> transitions() const;

  private:
    std::vector<SceneMesh> meshes_;
    lockstep::PairSet pairs_;
    SceneFault fault_;
    std::vector<double> mean_pairs_;
    MemberArray<gears::DeviationScales> tooth_scales_;
};

// Stiffness, N/m, of the gear pair `since` mesh periods after its faulty tooth started to engage;
// outside its engagement, that of the healthy pair.
double faulty_total(const lockstep::PairSet& pairs, PairId pair, const stiffness::FaultyMesh& mesh,
                    double since);

// Loaded static transmission error of a gear pair, m: approach of its gears along the line of
// action at a phase of the mesh period under the nominal load.
double loaded_approach(const SceneStiffness& stiffness, PairId pair, double phase);

}  // namespace gearpod::mc
