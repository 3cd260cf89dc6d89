#include "mc/coupling/coupling_checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "dynamics/gearbox_matrices.hpp"
#include "lockstep/integrators/facts.hpp"
#include "lockstep/steps/step_limit.hpp"
#include "lockstep/tile/step_integrator.hpp"
#include "mc/coupling/coupled_train.hpp"
#include "mc/study/fluctuations.hpp"
#include "mc/study/housing.hpp"
#include "mc/study/other_sources.hpp"

namespace gearpod::mc {
namespace {

// Longest run-in that is accepted, in recorded mesh periods.
constexpr double kLongestRunIn = 10.0;
// Largest change of a shaft's phase, and of the decay by its damper, in one step of a gearbox. The
// frequency of its twist is then correct to 1 %.
constexpr double kMostPhase = 0.2;

// Inverse of the inertia of the member alone at which a shaft ends, 1/(kg m^2).
double inverse_inertia(const Scene& gearbox, const lockstep::ShaftEnd& end) {
    const std::vector<double> none(static_cast<std::size_t>(dynamics::pairs(gearbox.plan().layout)),
                                   0.0);
    const auto matrices = dynamics::assemble(gearbox.plan().layout,
                                             gearbox.inputs(nominal_inputs(gearbox.study())), none);
    return end.turn_per_m * end.turn_per_m / matrices.mass(end.degree, end.degree);
}

// Mesh period of the slowest gearbox over the nominal one, among the first of the study.
double slowest_period(const Scene& scene) {
    constexpr std::uint64_t kGearboxes = 256;
    const double nominal = nominal_inputs(scene.study()).speed_rad_s;
    double slowest = 1.0;
    for (std::uint64_t i = 0; i < kGearboxes; ++i) {
        for (const Group group : {Group::threshold, Group::graded}) {
            slowest =
                std::max(slowest, nominal / scene.sampler().draw({group, i}).inputs.speed_rad_s);
        }
    }
    return slowest;
}

// End of the shaft of stage `of`: side 0 at the gearbox at its other end, side 1 at the stage.
struct ShaftSide {
    std::size_t of = 0, side = 0;
};

// Elastic shafts that end at one gearbox of the train, the study's own without `stage`.
std::vector<ShaftSide> shafts_at(const Scene& scene, std::optional<std::size_t> stage) {
    std::vector<ShaftSide> shafts;
    for (std::size_t i = 0; i < scene.stages().size(); ++i) {
        if (!stage_of(scene, i).coupled()) {
            continue;
        }
        if (stage == i) {
            shafts.push_back({i, 1});
        }
        if (stage == other_stage(scene.study(), i)) {
            shafts.push_back({i, 0});
        }
    }
    return shafts;
}

const Scene& gearbox_at(const Scene& scene, std::optional<std::size_t> stage) {
    return stage ? scene.stages()[*stage] : scene;
}

// "stage "second": " for messages; "" for the study's own gearbox.
std::string named(const Scene& scene, std::optional<std::size_t> stage) {
    return stage ? fmt::format("stage \"{}\": ", stage_of(scene, *stage).name) : "";
}

// Checks that each member of a gearbox has one elastic shaft at most: it sets the torque there.
void check_members(const Scene& scene, std::optional<std::size_t> stage) {
    std::vector<Member> members;
    for (const auto& [of, side] : shafts_at(scene, stage)) {
        const NeighbourStage& own = stage_of(scene, of);
        members.push_back(side == 1 ? *own.stage_shaft : *own.shaft);
    }
    for (const Member member : members) {
        if (std::ranges::count(members, member) > 1) {
            throw SceneError(
                kStagesKey,
                fmt::format("{}two elastic shafts end at the {}, and each would bear its whole "
                            "torque",
                            named(scene, stage), member_name(member)),
                "couple one stage with each member");
        }
    }
}

// Steps per mesh period that the nominal gearbox needs to be stable with its elastic shafts held at
// their other ends, and to resolve how these twist and how their dampers act between the members at
// both ends.
double needed_steps(const Scene& scene, std::optional<std::size_t> stage) {
    const Scene& gearbox = gearbox_at(scene, stage);
    const auto inputs = gearbox.inputs(nominal_inputs(gearbox.study()));
    auto matrices = dynamics::assemble(gearbox.plan().layout, inputs, gearbox.stiffest_pairs());
    double fastest_1_s = 0.0;
    for (const auto& [of, side] : shafts_at(scene, stage)) {
        const auto ends = shaft_ends(scene, of);
        dynamics::SpringDamper shaft;
        shaft.row = Eigen::VectorXd::Zero(matrices.mass.rows());
        shaft.row(ends[side].degree) = ends[side].turn_per_m;
        shaft.stiffness = stage_of(scene, of).shaft_stiffness_N_m_rad;
        shaft.damping = shaft_mode(scene, of).damping_N_m_s_rad;
        dynamics::add(matrices, shaft);
        const double inverse = inverse_inertia(other_end(scene, of), ends[0]) +
                               inverse_inertia(scene.stages()[of], ends[1]);
        fastest_1_s =
            std::max({fastest_1_s, std::sqrt(shaft.stiffness * inverse), shaft.damping * inverse});
    }
    const double period = dynamics::mesh_period_s(inputs);
    return std::max(period / lockstep::longest_stable_step(matrices, gearbox.plan().integrator),
                    period * fastest_1_s / kMostPhase);
}

// Checks that a gearbox, the study's own without `stage`, can be integrated with its shafts.
void check_gearbox(const Scene& scene, double slowest, std::optional<std::size_t> stage) {
    const Scene& gearbox = gearbox_at(scene, stage);
    const Study& study = gearbox.study();
    const std::string of = named(scene, stage);
    const char* where = stage ? "in the study of that stage" : "here";
    if (!lockstep::supports_steps(gearbox.plan())) {
        throw SceneError(kStagesKey,
                         of + "a shaft with a stiffness needs the central difference method in "
                              "double precision",
                         fmt::format("give numerics.integrator = \"central-difference\" and "
                                     "numerics.precision = \"double\" {}",
                                     where));
    }
    if (has_variable_excitation(study)) {
        throw SceneError(kStagesKey,
                         of + "a shaft with a stiffness needs a steady torque and speed without "
                              "gravity",
                         fmt::format("remove fluctuations and effects.gravity {}", where));
    }
    if (stage && has_housing(study)) {
        throw SceneError(kStagesKey, of + "a coupled stage cannot have a housing of its own",
                         "remove it there; the gain of the stage stands for its path");
    }
    if (stage && study.numerics.verify) {
        throw SceneError(kStagesKey, of + "numerics.verify has no effect on a coupled stage",
                         "remove it there");
    }
    check_members(scene, stage);
    const double needed = slowest * needed_steps(scene, stage);
    const auto steps = static_cast<double>(gearbox.plan().grid.steps.size());
    if (steps < needed) {
        throw SceneError(
            kStagesKey,
            fmt::format("{}with its shafts the slowest gearbox needs {:.0f} steps per mesh period, "
                        "and has {:.0f}",
                        of, std::ceil(needed), steps),
            fmt::format("give numerics.steps_per_mesh = {:.0f} {}, or a softer shaft",
                        std::ceil(1.05 * needed), where));
    }
}

// Checks that the shaft of a stage bears a torque at both ends.
void check_balance(const Scene& scene, std::size_t stage) {
    const NeighbourStage& own = stage_of(scene, stage);
    const Scene& other = other_end(scene, stage);
    const Scene& there = scene.stages()[stage];
    const double torque = shaft_torque_N_m(other, *own.shaft, nominal_inputs(other.study()));
    const double torque_there =
        shaft_torque_N_m(there, *own.stage_shaft, nominal_inputs(there.study()));
    if (torque == 0.0 || torque_there == 0.0) {
        throw SceneError(
            kStagesKey,
            fmt::format("{}the common shaft bears no torque {}", named(scene, stage),
                        torque == 0.0 ? "in the gearbox at its other end" : "in this stage"),
            "give both a torque (operation.torque_N_m)");
    }
}

// Checks that the steps of an uncoupled stage are stable next to the slowest gearbox of the study.
void check_steps(const Scene& scene, double slowest, std::size_t stage) {
    const Scene& own = scene.stages()[stage];
    if (!lockstep::is_explicit(own.plan().integrator)) {
        return;
    }
    const double needed = slowest * needed_steps(scene, stage);
    if (static_cast<double>(own.plan().grid.steps.size()) < needed) {
        throw SceneError(
            kStagesKey,
            fmt::format("{}next to the slowest gearbox it needs {:.0f} steps per mesh "
                        "period, and has {}",
                        named(scene, stage), std::ceil(needed), own.plan().grid.steps.size()),
            fmt::format("give numerics.steps_per_mesh = {:.0f} in the study of that stage",
                        std::ceil(1.05 * needed)));
    }
}

}  // namespace

void check_stages(const Scene& scene) {
    if (scene.stages().empty()) {
        return;
    }
    const double slowest = slowest_period(scene);
    for (std::size_t i = 0; i < scene.stages().size(); ++i) {
        if (!stage_of(scene, i).coupled()) {
            check_steps(scene, slowest, i);
        }
    }
    if (!is_coupled(scene.study())) {
        return;
    }
    if (scene.study().effects.quasi_static()) {
        throw SceneError("effects.motion",
                         "an elastic shaft to another stage needs gears with inertia",
                         "choose another motion than quasi-static");
    }
    const Numerics& numerics = scene.study().numerics;
    if (numerics.verify || numerics.paired_gearboxes > 0) {
        throw SceneError(numerics.verify ? "numerics.verify" : "numerics.paired_gearboxes",
                         "would repeat gearboxes with finer steps of the study's own stage only",
                         "remove it; compare runs with another numerics.steps_per_mesh");
    }
    if (scene.study().numerics.horizon == Horizon::periodic) {
        throw SceneError("numerics.horizon",
                         "with an elastic shaft to another stage no mesh period repeats another",
                         "use \"full\"");
    }
    if (const double run_in = coupled_run_in(scene, 0);
        run_in > kLongestRunIn * scene.signal_meshes()) {
        throw SceneError(kStagesKey,
                         fmt::format("the motion of the gearboxes against each other takes {:.3g} "
                                     "mesh periods to decay to numerics.settle_tolerance, more "
                                     "than {:g} times a record",
                                     run_in, kLongestRunIn),
                         "give a stiffer shaft or more damping, or leave shaft_stiffness_N_m_rad "
                         "out");
    }
    check_gearbox(scene, slowest, std::nullopt);
    for (std::size_t i = 0; i < scene.stages().size(); ++i) {
        if (stage_of(scene, i).coupled()) {
            check_gearbox(scene, slowest, i);
            check_balance(scene, i);
        }
    }
}

}  // namespace gearpod::mc
