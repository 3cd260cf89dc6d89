#include "mc/plan/scene_stiffness.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <ranges>

#include "dynamics/helical_pair.hpp"
#include "machine/contracts.hpp"
#include "mc/files/input/problems.hpp"
#include "mc/study/faults/fault_kind.hpp"
#include "mc/study/gears.hpp"
#include "mc/study/schema/sizes.hpp"
#include "stiffness/additive_mesh.hpp"
#include "stiffness/coupled_mesh.hpp"
#include "stiffness/gapped_mesh.hpp"
#include "stiffness/helical_mesh.hpp"
#include "stiffness/square_wave_mesh.hpp"

namespace gearpod::mc {
namespace {

std::string location_of(const Study& study) {
    const Fault& fault = study.fault;
    return fault.member != Member::planet ? fmt::format("the {}", member_name(*fault.member))
                                          : fmt::format("planet {}, {} side{}", fault.planet,
                                                        choice_text(study, "fault", "side"),
                                                        fault.side == FaultSide::both ? "s" : "");
}

// Stiffness levels as given in the study, along the teeth's normal.
struct StiffnessLevels {
    double low_N_m, high_N_m, contact_ratio;
};

StiffnessLevels levels_of(const Study& study, MeshKind mesh) {
    const MeshValues& given = study.gearbox.meshes[mesh];
    if (study.gearbox.tooth_profile == StiffnessSource::square_wave) {
        return {given.low_stiffness_N_m.value(), given.high_stiffness_N_m.value(),
                given.contact_ratio.value()};
    }
    return {given.stiffness_N_m.value(), given.stiffness_N_m.value(), 1.0};
}

// Ratio of the stiffness in the transverse plane, in which the gears move, to that along the
// normal.
double transverse_factor(const Gearbox& g) {
    return g.helix_angle_rad == 0.0
               ? 1.0
               : dynamics::transverse_stiffness_factor(g.pressure_angle_rad, g.helix_angle_rad);
}

std::unique_ptr<const stiffness::MeshStiffness> given_mesh(const Study& study, MeshKind mesh) {
    const StiffnessLevels levels = levels_of(study, mesh);
    const double factor = transverse_factor(study.gearbox);
    return std::make_unique<const stiffness::SquareWaveMesh>(
        factor * levels.low_N_m, factor * levels.high_N_m, levels.contact_ratio);
}

void make_coupled(const Study& study, double force_N, SceneMesh& mesh) {
    stiffness::CoupledMeshOptions options;
    options.foundation = study.effects.foundation;
    options.contact = study.effects.contact;
    options.body_radius_1_m = body_radius_m(study, mesh.members.member_1);
    options.body_radius_2_m = body_radius_m(study, mesh.members.member_2);
    options.force_N = force_N;
    options.tolerance = study.numerics.stiffness_tolerance;
    try {
        auto coupled = std::make_unique<const stiffness::CoupledMesh>(
            *mesh.geometry, material_of(study, mesh.members), profile_of(study), options);
        mesh.body[0] = coupled->body(1);
        mesh.body[1] = coupled->body(2);
        mesh.stiffness = std::move(coupled);
    } catch (const std::invalid_argument& error) {
        throw SceneError(
            study.effects.foundation == Foundation::none ? "effects.contact" : "effects.foundation",
            error.what(), "");
    }
}

// Largest value of a key in SI units; for a continuous distribution the 0.999 quantile.
double upper_value(const Study& study, const char* key, double given) {
    const RandomInput* const random = study.find_random(key);
    if (random == nullptr) {
        return given;
    }
    const std::vector<double> levels = random->distribution.levels();
    return !levels.empty()                       ? *std::max_element(levels.begin(), levels.end())
           : random->distribution.has_quantile() ? random->distribution.quantile(0.999)
                                                 : random->distribution.support().high;
}

// Largest corner gap that extended contact resolves, m: three times the nominal approach plus four
// times the pitch errors of both gears. Contact then starts and ends smoothly also for teeth with
// errors.
double corner_reach_m(const Study& study, double force_N, const SceneMesh& mesh) {
    return 3.0 * force_N / mean_total(*mesh.stiffness) +
           4.0 * (pitch_error_m(study, mesh.members.member_1) +
                  pitch_error_m(study, mesh.members.member_2));
}

// Worn gear of a mesh, 1 or 2; 0 if none wears.
int worn_gear(const Study& study, const MeshMembers& mesh) {
    if (study.fault.kind == nullptr || !study.fault.kind->wears_flanks()) {
        return 0;
    }
    const auto meshes = meshes_of(study.gearbox.kind);
    for (const FaultPlace& place : fault_places(study.fault)) {
        if (meshes[place.mesh].kind == mesh.kind) {
            return place.gear;
        }
    }
    return 0;
}

// Adds wear; the corner gaps of contact that it opens are followed too.
void add_wear(const Study& study, int worn_gear, stiffness::FlankGaps& gaps) {
    const std::vector<double> sizes = fault_sizes(study);
    gaps.reach_m += sizes.empty() ? 0.0 : sizes.back();
    try {
        gaps.wear.emplace(gaps.geometry, worn_gear);
    } catch (const std::invalid_argument& error) {
        throw SceneError("fault.kind", error.what(), "");
    }
}

// Adds relief, crowning, wear and extended contact. Gaps of crowned teeth vary across the face.
void add_gaps(const Study& study, double force_N, SceneMesh& mesh) {
    constexpr int kSlices = 8, kHelicalSlices = 4;
    stiffness::FlankGaps gaps{*mesh.geometry, relief_of(study, mesh.members.member_1),
                              relief_of(study, mesh.members.member_2)};
    if (study.effects.contact_onset == ContactOnset::extended) {
        gaps.reach_m = corner_reach_m(study, force_N, mesh);
    }
    if (const int worn = worn_gear(study, mesh.members); worn > 0) {
        add_wear(study, worn, gaps);
    }
    const double overlap = study.gearbox.helix_angle_rad > 0.0 ? overlap_ratio(study) : 0.0;
    const bool crowned = gaps.relief_1.crowning_m + gaps.relief_2.crowning_m > 0.0;
    const int slices = !crowned ? 1 : overlap > 0.0 ? kHelicalSlices : kSlices;
    mesh.stiffness = std::make_unique<const stiffness::GappedMesh>(std::move(mesh.stiffness),
                                                                   overlap, gaps, force_N, slices);
}

gears::DeviationScales grade_5(const Gearbox& gearbox, const gears::Gear& gear) {
    const double normal_module_m = gear.module_m * normal_over_transverse(gearbox);
    return gears::scales_of(
        gears::tooth_tolerances(normal_module_m, 2.0 * gear.pitch_radius(), 5.0), gear.teeth,
        gear.pressure_angle_rad);
}

// Stiffness with all tooth pairs in contact that can touch at a position.
double sum_of_springs(const stiffness::MeshStiffness& mesh, double tau) {
    std::vector<stiffness::ContactSpring> springs;
    add_springs(mesh, tau, tau, springs);
    return secant_stiffness(springs, 0.0);
}

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
            return lockstep::planet_fault_pattern(pairs, PlanetId{f.planet - 1}, f.side, teeth);
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

double pitch_error_m(const Study& study, Member member) {
    const MemberValues& body = study.gearbox.bodies[member];
    double error = 3.0 * upper_value(study, "gearbox.pitch_error_um", study.errors.pitch_error_m);
    if (has_tooth_quality(study)) {
        const double grade = body.quality.value_or(
            upper_value(study, "gearbox.tooth_quality", study.errors.tooth_quality.value_or(0.0)));
        const gears::Gear gear = gear_of(study, member);
        error += gears::tooth_tolerances(gear.module_m * normal_over_transverse(study.gearbox),
                                         2.0 * gear.pitch_radius(), grade)
                     .single_pitch;
    }
    for (const auto* measured : {&body.index_m, &body.ring_side_index_m}) {
        for (const double deviation : *measured) {
            error = std::max(error, std::abs(deviation));
        }
    }
    return error;
}

double given_mean_stiffness(const Study& study, MeshKind mesh) {
    EXPECTS(stiffness_given(study));
    return mean_total(*given_mesh(study, mesh));
}

double body_radius_m(const Study& study, Member member) {
    return 0.5 * study.gearbox.bodies[member].held_diameter_m.value_or(0.0);
}

std::vector<SceneMesh> make_meshes(const Study& study, double force_N) {
    const bool coupled =
        study.effects.foundation != Foundation::none || study.effects.contact != Contact::linear;
    std::vector<SceneMesh> meshes;
    for (const MeshMembers& members : meshes_of(study.gearbox.kind)) {
        SceneMesh mesh;
        mesh.members = members;
        if (stiffness_given(study)) {
            mesh.stiffness = given_mesh(study, members.kind);
        } else {
            mesh.geometry.emplace(gear_of(study, members.member_1),
                                  gear_of(study, members.member_2),
                                  working_shifts(study).centre_distance_m);
            if (coupled) {
                make_coupled(study, force_N, mesh);
            } else {
                mesh.stiffness = std::make_unique<const stiffness::AdditiveMesh>(
                    *mesh.geometry, material_of(study, members), profile_of(study),
                    study.numerics.stiffness_tolerance);
            }
        }
        if (!stiffness_given(study) && has_flank_gaps(study)) {
            add_gaps(study, force_N, mesh);
        } else if (!stiffness_given(study) && study.gearbox.helix_angle_rad > 0.0) {
            mesh.stiffness = std::make_unique<const stiffness::HelicalMesh>(
                std::move(mesh.stiffness), overlap_ratio(study));
        }
        mesh.loaded = std::make_unique<const stiffness::LoadedMesh>(*mesh.stiffness, force_N);
        meshes.push_back(std::move(mesh));
    }
    return meshes;
}

lockstep::PairSet make_pairs(const std::vector<SceneMesh>& meshes, const Drivetrain& drivetrain) {
    lockstep::PairSet pairs;
    // In reversed contact a tooth pair starts where it otherwise ends.
    pairs.reversed = drivetrain.reversed();
    for (const SceneMesh& mesh : meshes) {
        const stiffness::MeshStiffness& curve = *mesh.stiffness;
        const double since = pairs.reversed ? curve.contact_ratio() - curve.pitch_position()
                                            : curve.pitch_position();
        for (int i = 0; i < drivetrain.pairs_per_mesh(); ++i) {
            pairs.start.push_back(
                lockstep::phase_in_period(drivetrain.pitch_phase(PairId{pairs.pairs()}) - since));
            pairs.mesh.push_back(&curve);
        }
    }
    return pairs;
}

std::vector<double> constant_pairs(const Study& study) {
    const bool planetary = study.gearbox.kind == GearboxKind::planetary;
    std::vector<double> k;
    for (const MeshMembers& mesh : meshes_of(study.gearbox.kind)) {
        k.insert(k.end(), static_cast<std::size_t>(planetary ? study.gearbox.planets : 1),
                 transverse_factor(study.gearbox) * levels_of(study, mesh.kind).low_N_m);
    }
    return k;
}

SceneStiffness::SceneStiffness(const Study& study, const Drivetrain& drivetrain)
    : meshes_(make_meshes(study, drivetrain.mesh_force_N(nominal_inputs(study)))),
      pairs_(make_pairs(meshes_, drivetrain)),
      fault_(study, meshes_, pairs_) {
    for (const SceneMesh& mesh : meshes_) {
        mean_pairs_.insert(mean_pairs_.end(), static_cast<std::size_t>(drivetrain.pairs_per_mesh()),
                           mean_total(*mesh.stiffness));
        for (const Member member : {mesh.members.member_1, mesh.members.member_2}) {
            if (has_tooth_quality(study) && tooth_scales_[member].pitch == 0.0) {
                tooth_scales_[member] = grade_5(study.gearbox, gear_of(study, member));
            }
        }
    }
}

std::vector<double> SceneStiffness::stiffest_pairs() const {
    constexpr int kPhases = 200;
    std::vector<double> k;
    for (PairId i{0}; i < pairs_.pairs(); ++i) {
        double stiffest = 0.0;
        for (int p = 0; p < kPhases; ++p) {
            const double phase = static_cast<double>(p) / kPhases;
            stiffest = std::max(stiffest, pairs_.curve(i).has_gaps()
                                              ? sum_of_springs(pairs_.curve(i), phase)
                                              : pairs_.total(i, phase));
        }
        k.push_back(stiffest);
    }
    return k;
}

// Steps also end on the jumps of the fault's stiffness.
std::vector<double> SceneStiffness::transitions() const {
    std::vector<double> all = lockstep::contact_transitions(pairs_);
    const std::vector<double> jumps = fault_.jumps(pairs_);
    if (!jumps.empty()) {
        all.insert(all.end(), jumps.begin(), jumps.end());
        std::sort(all.begin(), all.end());
        all.erase(std::unique(all.begin(), all.end()), all.end());
    }
    return all;
}

double faulty_total(const lockstep::PairSet& pairs, PairId pair, const stiffness::FaultyMesh& mesh,
                    double since) {
    if (since < 0.0 || since >= mesh.duration()) {
        return pairs.total(pair, pairs.start[pair] + since);
    }
    const double tau = pairs.reversed ? mesh.duration() - since : since;
    const auto limit = pairs.reversed ? stiffness::Limit::from_below : stiffness::Limit::from_above;
    return total_at(mesh, pairs.curve(pair).transitions(), tau, limit);
}

double loaded_approach(const SceneStiffness& stiffness, PairId pair, double phase) {
    constexpr double kInside = 1e-9;  // mesh periods, towards later phases
    const lockstep::PairSet& pairs = stiffness.pairs();
    const double since = phase - pairs.start[pair];
    const double tau = pairs.reversed ? pairs.curve(pair).contact_ratio() - since : since;
    const double inside = pairs.reversed ? tau - kInside : tau + kInside;
    const double period = std::floor(inside);
    const std::vector<SceneMesh>& meshes = stiffness.meshes();
    const auto pairs_per_mesh = static_cast<std::size_t>(pairs.pairs()) / meshes.size();
    const SceneMesh& mesh = meshes[pair / pairs_per_mesh];
    return mesh.loaded->approach(tau - period, inside - period);
}

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

std::vector<PairId> faulty_pairs(const SceneFault& fault) {
    std::vector<PairId> pairs(static_cast<std::size_t>(fault.curves()));
    for (const lockstep::FaultPassage& passage : std::views::reverse(fault.pattern().passages)) {
        pairs[static_cast<std::size_t>(passage.curve)] = passage.pair;
    }
    return pairs;
}

}  // namespace gearpod::mc
