#include "mc/scene/faults.hpp"

#include <algorithm>
#include <cmath>

#include "mc/scene/scene_error.hpp"
#include "mc/study/schema/sizes.hpp"
#include "stiffness/faults/broken.hpp"
#include "stiffness/faults/chip.hpp"
#include "stiffness/faults/pitting.hpp"
#include "stiffness/faults/reduction.hpp"
#include "stiffness/faults/spatial_crack.hpp"
#include "stiffness/faults/tooth_crack.hpp"

namespace gearpod::mc {
namespace {

using stiffness::ToothFaultFamily;

// A faulty tooth's side: the mesh in which it acts, and its gear there, 1 or 2.
struct FaultPlace {
    std::size_t mesh;
    int gear;
};

std::vector<FaultPlace> places_of(const Fault& fault) {
    switch (fault.member.value()) {
        case Member::planet:
            switch (fault.side.value()) {
                case FaultSide::sun:
                    return {{0, 2}};
                case FaultSide::ring:
                    return {{1, 1}};
                case FaultSide::both:
                    return {{0, 2}, {1, 1}};
            }
            break;
        case Member::ring:
            return {{1, 2}};
        case Member::gear:
            return {{0, 2}};
        default:
            break;
    }
    return {{0, 1}};
}

stiffness::CrackGrowth growth_of(const Fault& f) {
    stiffness::CrackGrowth growth;
    growth.depth_m = f.growth_depth_m;
    growth.end_depth_m = f.growth_end_depth_m;
    growth.length_m = f.growth_length_m;
    growth.height_m = f.growth_height_m;
    growth.end_height_m = f.growth_end_height_m;
    growth.angle_rad = f.angle_rad;
    growth.end_angle_rad = f.end_angle_rad.value_or(f.angle_rad);
    growth.height_wave = f.height_wave;
    growth.height_waves = f.height_waves;
    growth.slices = f.slices;
    return growth;
}

std::unique_ptr<const ToothFaultFamily> make_family(const Study& study, const SceneMesh& mesh,
                                                    int gear) {
    const Fault& f = study.fault;
    switch (f.kind) {
        case FaultKind::spatial_crack:
            return std::make_unique<const stiffness::SpatialCrack>(
                *mesh.geometry, material_of(study), profile_of(study), gear, growth_of(f),
                mesh.body[gear - 1]);
        case FaultKind::chip:
            return std::make_unique<const stiffness::ToothChip>(
                *mesh.geometry, *study.gearbox.face_width_m, gear, f.chip_height_m);
        case FaultKind::pitting:
            return std::make_unique<const stiffness::ToothPitting>(
                *mesh.geometry, material_of(study), profile_of(study), gear,
                stiffness::PitBand{*f.pit_radius_m, *f.pit_length_m, *f.pit_depth_m, f.teeth});
        case FaultKind::broken:
            return std::make_unique<const stiffness::BrokenTooth>();
        case FaultKind::reduction:
            return std::make_unique<const stiffness::Reduction>();
        default:
            return std::make_unique<const stiffness::ToothCrack>(
                *mesh.geometry, material_of(study), profile_of(study), gear, f.angle_rad);
    }
}

void check_sizes(const Study& study, const ToothFaultFamily& family) {
    for (const double size : fault_sizes(study)) {
        const std::vector<std::string> problems = family.problems(size);
        if (!problems.empty()) {
            throw SceneError(fault_size_key(study).path(), problems.front(), "");
        }
    }
}

lockstep::PlanetTurns planet_turns(const Study& study) {
    const gears::PlanetPlaces places = gears::planet_places(planetary_train(study));
    lockstep::PlanetTurns turns;
    for (const int place : places.place) {
        turns.position.push_back(static_cast<double>(place) / places.places);
    }
    return turns;
}

lockstep::PlanetSide side_of(FaultSide side) {
    switch (side) {
        case FaultSide::sun:
            return lockstep::PlanetSide::sun;
        case FaultSide::both:
            return lockstep::PlanetSide::both;
        case FaultSide::ring:
            break;
    }
    return lockstep::PlanetSide::ring;
}

lockstep::FaultPattern make_pattern(const Study& study, const lockstep::PairSet& pairs) {
    const Fault& f = study.fault;
    const int teeth = teeth_of(study, *f.member).value();
    switch (*f.member) {
        case Member::sun:
            return lockstep::sun_fault_pattern(pairs, planet_turns(study), teeth);
        case Member::ring:
            return lockstep::ring_fault_pattern(pairs, planet_turns(study), teeth);
        case Member::planet:
            return lockstep::planet_fault_pattern(pairs, f.planet - 1, side_of(*f.side), teeth);
        default:
            return lockstep::shaft_fault_pattern(pairs, teeth);
    }
}

}  // namespace

SceneFault::SceneFault(const Study& study, const std::vector<SceneMesh>& meshes,
                       const lockstep::PairSet& pairs) {
    if (study.fault.kind == FaultKind::none) {
        return;
    }
    for (const FaultPlace& place : places_of(study.fault)) {
        const SceneMesh& mesh = meshes[place.mesh];
        try {
            laws_.push_back({mesh.stiffness.get(), make_family(study, mesh, place.gear)});
        } catch (const std::invalid_argument& error) {
            throw SceneError("fault.kind", error.what(), "");
        }
        check_sizes(study, *laws_.back().family);
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
            // Reversed, the engagement runs from its end to its start.
            const double since = pairs.reversed ? law.mesh->contact_ratio() - tau : tau;
            phases.push_back(lockstep::phase_in_period(passage.start + since));
        }
    }
    return phases;
}

}  // namespace gearpod::mc
