#include "mc/plan/fault_plan.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "mc/plan/drivetrain.hpp"
#include "mc/plan/scene_error.hpp"
#include "mc/plan/scene_stiffness.hpp"
#include "mc/study/gears.hpp"
#include "mc/study/schema/sizes.hpp"

namespace gearpod::mc {
namespace {

std::string location_of(const Study& study) {
    const Fault& fault = study.fault;
    return !fault.side ? fmt::format("the {}", member_name(*fault.member))
                       : fmt::format("planet {}, {} side{}", fault.planet,
                                     choice_text(study, "fault", "side"),
                                     *fault.side == FaultSide::both ? "s" : "");
}

}  // namespace

FaultPlan make_fault_plan(const Study& study) {
    FaultPlan plan;
    plan.size_key = &fault_size_key(study);
    if (study.fault.kind == nullptr) {
        return plan;
    }
    const FaultKind& kind = *study.fault.kind;
    plan.kind = kind.name();
    plan.words = kind.words();
    plan.title = kind.title();
    plan.location = location_of(study);
    plan.sizes = fault_sizes(study);
    if (has_gears(study)) {
        plan.origin = kind.origin(study, plan.sizes);
        plan.share = kind.share(study);
    }
    plan.groups = !size_edges(study).empty();
    return plan;
}

std::string FaultPlan::name_at(double size) const {
    return fmt::format("{}_{:g}{}", kind, size / unit().to_si, unit().suffix);
}

namespace {

void check_sizes(const FaultPlan& plan, const stiffness::ToothFaultFamily& family) {
    for (const double size : plan.sizes) {
        const std::vector<std::string> problems = family.problems(size);
        if (!problems.empty()) {
            throw SceneError(plan.size_key->path(), problems.front(), "");
        }
    }
}

lockstep::PlanetPositions planet_positions(const Study& study) {
    const gears::PlanetPositions planets = gears::planet_positions(planetary_train(study));
    lockstep::PlanetPositions turns;
    for (const int step : planets.step) {
        turns.position.push_back(static_cast<double>(step) / planets.steps);
    }
    return turns;
}

lockstep::FaultPattern make_pattern(const Study& study, const lockstep::PairSet& pairs) {
    const Fault& f = study.fault;
    const int teeth = teeth_of(study, *f.member).value();
    switch (*f.member) {
        case Member::sun:
            return lockstep::sun_fault_pattern(pairs, planet_positions(study), teeth);
        case Member::ring:
            return lockstep::ring_fault_pattern(pairs, planet_positions(study), teeth);
        case Member::planet:
            return lockstep::planet_fault_pattern(pairs, f.planet - 1, *f.side, teeth);
        case Member::pinion:
        case Member::gear:
            return lockstep::shaft_fault_pattern(pairs, teeth);
        case Member::carrier:
            return {};
    }
    return {};
}

// Pairs in which the flanks of the faulty member meet its mates.
std::vector<int> pairs_of_member(const Fault& fault, int meshes, const lockstep::PairSet& pairs) {
    const int per_mesh = pairs.pairs() / meshes;
    std::vector<int> all;
    for (const FaultPlace& place : fault_places(fault)) {
        for (int n = 0; n < per_mesh; ++n) {
            if (fault.member != Member::planet || n == fault.planet - 1) {
                all.push_back(static_cast<int>(place.mesh) * per_mesh + n);
            }
        }
    }
    return all;
}

}  // namespace

SceneFault::SceneFault(const Study& study, const std::vector<SceneMesh>& meshes,
                       const lockstep::PairSet& pairs)
    : plan_(make_fault_plan(study)) {
    if (study.fault.kind == nullptr) {
        return;
    }
    if (study.fault.kind->wears_flanks()) {
        worn_pairs_ = pairs_of_member(study.fault, static_cast<int>(meshes.size()), pairs);
        return;
    }
    for (const FaultPlace& place : fault_places(study.fault)) {
        const SceneMesh& mesh = meshes[place.mesh];
        try {
            laws_.push_back(
                {mesh.stiffness.get(),
                 study.fault.kind->family(study, {mesh.members, mesh.geometry, place.gear,
                                                  mesh.body[place.gear - 1], pairs.reversed})});
        } catch (const std::invalid_argument& error) {
            throw SceneError("fault.kind", error.what(), "");
        }
        check_sizes(plan_, *laws_.back().family);
    }
    pattern_ = make_pattern(study, pairs);
}

std::shared_ptr<const stiffness::FaultyMesh> SceneFault::mesh(int curve, double size) const {
    if (size <= 0.0 || laws_.empty()) {
        return nullptr;
    }
    const Law& law = laws_[static_cast<std::size_t>(curve)];
    return stiffness::faulty_mesh(*law.mesh, law.family->at(size));
}

double SceneFault::largest_size() const {
    double largest = 0.0;
    for (const Law& law : laws_) {
        largest = std::max(largest, law.family->largest_size());
    }
    return largest;
}

std::vector<double> SceneFault::jumps(const lockstep::PairSet& pairs) const {
    std::vector<double> phases;
    for (const lockstep::FaultPassage& passage : pattern_.passages) {
        const Law& law = laws_[static_cast<std::size_t>(passage.curve)];
        for (const double tau : law.family->jumps()) {
            // Reversed contact runs from the end of the engagement to its start.
            const double position = law.mesh->path_begin() + tau;
            const double since = pairs.reversed ? law.mesh->contact_ratio() - position : position;
            phases.push_back(lockstep::phase_in_period(passage.start + since));
        }
    }
    return phases;
}

std::vector<int> faulty_pairs(const SceneFault& fault) {
    std::vector<int> pairs(static_cast<std::size_t>(fault.curves()), -1);
    for (const lockstep::FaultPassage& passage : fault.pattern().passages) {
        int& pair = pairs[static_cast<std::size_t>(passage.curve)];
        pair = pair < 0 ? passage.pair : pair;
    }
    return pairs;
}

}  // namespace gearpod::mc
