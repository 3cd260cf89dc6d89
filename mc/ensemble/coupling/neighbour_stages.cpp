#include "mc/ensemble/coupling/neighbour_stages.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <boost/random/uniform_01.hpp>
#include <boost/random/uniform_int_distribution.hpp>
#include <cmath>
#include <numbers>

#include "dynamics/gearbox.hpp"
#include "dynamics/gearbox_matrices.hpp"
#include "lockstep/integrators/facts.hpp"
#include "lockstep/steps/stability.hpp"
#include "lockstep/tile/tile_integrators.hpp"
#include "mc/ensemble/coupling/record_positions.hpp"
#include "mc/study/fluctuations.hpp"
#include "mc/study/housing.hpp"
#include "mc/study/other_sources.hpp"

namespace gearpod::mc {
namespace {

// End of a shaft at a gearbox. The shaft's positive sense is that in which it turns.
lockstep::ShaftEnd shaft_end(const Scene& gearbox, Member shaft) {
    const auto& layout = gearbox.plan().layout;
    const ShaftDegree degree = gearbox.drivetrain().shaft_degree(layout, shaft);
    const double turning = gearbox.drivetrain().rotation_m_s(nominal_inputs(gearbox.study())) *
                           dynamics::rigid_rotation(layout)(degree.degree);
    return {degree.degree, std::copysign(1.0 / degree.radius_m, turning)};
}

double mesh_period_of(const Scene& gearbox) {
    return 1.0 / std::abs(gearbox.nominal_mesh_frequency_Hz());
}

}  // namespace

const NeighbourStage& stage_of(const Scene& scene, std::size_t stage) {
    return scene.study().sensor.stages[stage];
}

double shaft_torque_N_m(const Scene& gearbox, Member shaft, const InstanceInputs& inputs) {
    const lockstep::ShaftEnd end = shaft_end(gearbox, shaft);
    return dynamics::torque_force(gearbox.plan().layout, gearbox.inputs(inputs))(end.degree) /
           end.turn_per_m;
}

bool is_mirrored(const Scene& scene, std::size_t stage) {
    const NeighbourStage& own = stage_of(scene, stage);
    const Scene& other = other_end(scene, stage);
    const Scene& there = scene.stages()[stage];
    return shaft_torque_N_m(other, *own.shaft, nominal_inputs(other.study())) *
               shaft_torque_N_m(there, *own.stage_shaft, nominal_inputs(there.study())) >
           0.0;
}

std::array<lockstep::ShaftEnd, 2> shaft_ends(const Scene& scene, std::size_t stage) {
    const NeighbourStage& own = stage_of(scene, stage);
    std::array<lockstep::ShaftEnd, 2> ends{shaft_end(other_end(scene, stage), *own.shaft),
                                           shaft_end(scene.stages()[stage], *own.stage_shaft)};
    if (is_mirrored(scene, stage)) {
        ends[1].turn_per_m *= -1.0;
    }
    return ends;
}

double shaft_inertia_kg_m2(const Scene& gearbox, Member shaft) {
    const auto& layout = gearbox.plan().layout;
    const lockstep::ShaftEnd end = shaft_end(gearbox, shaft);
    const auto inputs = gearbox.inputs(nominal_inputs(gearbox.study()));
    const Eigen::VectorXd turn = dynamics::rigid_rotation(layout);
    const std::vector<double> none(static_cast<std::size_t>(dynamics::pairs(layout)), 0.0);
    const double rate = end.turn_per_m * turn(end.degree);
    return turn.dot(dynamics::assemble(layout, inputs, none).mass * turn) / (rate * rate);
}

std::optional<std::size_t> other_stage(const Study& study, std::size_t stage) {
    const std::vector<NeighbourStage>& stages = study.sensor.stages;
    const std::string& of = stages[stage].of;
    if (of.empty()) {
        return std::nullopt;
    }
    return static_cast<std::size_t>(std::ranges::find(stages, of, &NeighbourStage::name) -
                                    stages.begin());
}

const Scene& other_end(const Scene& scene, std::size_t stage) {
    const auto other = other_stage(scene.study(), stage);
    return other ? scene.stages()[*other] : scene;
}

ShaftMode shaft_mode(const Scene& scene, std::size_t stage) {
    const NeighbourStage& own = stage_of(scene, stage);
    const double a = shaft_inertia_kg_m2(other_end(scene, stage), *own.shaft);
    const double b = shaft_inertia_kg_m2(scene.stages()[stage], *own.stage_shaft);
    const double inertia = a * b / (a + b), stiffness = own.shaft_stiffness_N_m_rad;
    return {std::sqrt(stiffness / inertia) / (2.0 * std::numbers::pi),
            2.0 * own.shaft_damping_ratio * std::sqrt(stiffness * inertia)};
}

std::vector<double> train_frequencies_Hz(const Scene& scene) {
    std::vector<const Scene*> gearboxes{&scene};
    std::vector<Eigen::Index> first{0}, first_of_stage(scene.stages().size(), 0);
    const auto degrees = [](const Scene& gearbox) {
        return Eigen::Index{dynamics::degrees_of_freedom(gearbox.plan().layout)};
    };
    Eigen::Index size = degrees(scene);
    for (std::size_t i = 0; i < scene.stages().size(); ++i) {
        if (stage_of(scene, i).coupled()) {
            gearboxes.push_back(&scene.stages()[i]);
            first.push_back(size);
            first_of_stage[i] = size;
            size += degrees(scene.stages()[i]);
        }
    }
    dynamics::GearboxMatrices train = dynamics::zero_matrices(static_cast<int>(size));
    for (std::size_t g = 0; g < gearboxes.size(); ++g) {
        const auto own =
            dynamics::assemble(gearboxes[g]->plan().layout,
                               gearboxes[g]->inputs(nominal_inputs(gearboxes[g]->study())),
                               gearboxes[g]->mean_pairs());
        const Eigen::Index n = own.mass.rows();
        train.mass.block(first[g], first[g], n, n) = own.mass;
        train.stiffness.block(first[g], first[g], n, n) = own.stiffness;
    }
    for (std::size_t i = 0; i < scene.stages().size(); ++i) {
        if (!stage_of(scene, i).coupled()) {
            continue;
        }
        const auto other = other_stage(scene.study(), i);
        const auto [here, there] = shaft_ends(scene, i);
        dynamics::SpringDamper shaft;
        shaft.row = Eigen::VectorXd::Zero(size);
        shaft.row((other ? first_of_stage[*other] : 0) + here.degree) = here.turn_per_m;
        shaft.row(first_of_stage[i] + there.degree) = -there.turn_per_m;
        shaft.stiffness = stage_of(scene, i).shaft_stiffness_N_m_rad;
        dynamics::add(train, shaft);
    }
    return dynamics::natural_frequencies_Hz(train);
}

double coupled_run_in(const Scene& scene, int run_in_meshes) {
    const double own = mesh_period_of(scene);
    double run_in = run_in_meshes;
    for (std::size_t i = 0; i < scene.stages().size(); ++i) {
        if (stage_of(scene, i).coupled()) {
            const double rate_1_s = 2.0 * std::numbers::pi * shaft_mode(scene, i).frequency_Hz *
                                    stage_of(scene, i).shaft_damping_ratio;
            const double decay_s = -std::log(convergence_tolerance(scene.study())) / rate_1_s;
            run_in = std::max({run_in, decay_s / own,
                               (kMarginMeshes + 1) * mesh_period_of(scene.stages()[i]) / own});
        }
    }
    return std::ceil(run_in);
}

CoupledSpan coupled_span(const Scene& scene, int run_in_meshes, const GearboxId& id) {
    CoupledSpan span;
    span.run_in = static_cast<int>(coupled_run_in(scene, run_in_meshes));
    GearboxId shared = id;
    shared.index -= id.index % kSharedPositions;
    shared.exchanged = {};
    for (std::size_t i = 0; i < scene.stages().size(); ++i) {
        if (!stage_of(scene, i).coupled()) {
            continue;
        }
        const Scene& own = scene.stages()[i];
        Philox engine =
            record_stream(scene.draw().seed, shared,
                          with_suffix(StreamPurpose::stage_start, stage_of(scene, i).name));
        StageSpan& stage = span.stages.emplace_back();
        stage.stage = i;
        stage.period = mesh_period_of(own) / mesh_period_of(scene);
        stage.lead = boost::random::uniform_01<double>()(engine);
        // The path repeats with the carrier.
        const int turns = std::max(1, own.span_meshes() / own.path_meshes());
        stage.first_mesh =
            own.path_meshes() * boost::random::uniform_int_distribution<int>(0, turns - 1)(engine);
        stage.run_in = static_cast<int>(span.run_in / stage.period) - kMarginMeshes;
        stage.start = (stage.run_in - stage.lead) * stage.period - span.run_in;
        stage.meshes = static_cast<int>(
            std::ceil((scene.signal_meshes() - stage.start) / stage.period) + kMarginMeshes);
    }
    return span;
}

std::vector<lockstep::CouplingShaft> coupling_shafts(const Scene& scene, const CoupledSpan& span,
                                                     std::size_t lanes) {
    const auto number_of = [&](std::size_t stage) {
        return 1 +
               static_cast<std::size_t>(std::ranges::find(span.stages, stage, &StageSpan::stage) -
                                        span.stages.begin());
    };
    std::vector<lockstep::CouplingShaft> shafts;
    for (const StageSpan& of : span.stages) {
        const NeighbourStage& own = stage_of(scene, of.stage);
        const auto other = other_stage(scene.study(), of.stage);
        lockstep::CouplingShaft shaft;
        shaft.stage[0] = other ? number_of(*other) : 0;
        shaft.stage[1] = number_of(of.stage);
        const auto ends = shaft_ends(scene, of.stage);
        std::ranges::copy(ends, shaft.end);
        shaft.stiffness_N_m_rad.assign(lanes, own.shaft_stiffness_N_m_rad);
        shaft.damping_N_m_s_rad.assign(lanes, shaft_mode(scene, of.stage).damping_N_m_s_rad);
        shafts.push_back(std::move(shaft));
    }
    return shafts;
}

namespace {

// Every gearbox has two rows of its own in the stage: healthy gearboxes the even ones.
GearboxId id_in_stage(const GearboxId& id) {
    GearboxId other = id;
    other.group = Group::graded;
    other.index = 2 * id.index + (id.group == Group::graded ? 1 : 0);
    other.exchanged = {};
    return other;
}

}  // namespace

Realization stage_gearbox(const Scene& scene, std::size_t stage, const Realization& record,
                          bool faulty) {
    const Scene& own = scene.stages()[stage];
    Realization gearbox = own.sampler().draw(id_in_stage(record.id));
    const InstanceInputs here = nominal_inputs(scene.study()), there = nominal_inputs(own.study());
    double torque = here.torque_N_m != 0.0 ? record.inputs.torque_N_m / here.torque_N_m : 1.0;
    if (const NeighbourStage& coupled = scene.study().sensor.stages[stage]; coupled.coupled()) {
        const auto other = other_stage(scene.study(), stage);
        const InstanceInputs inputs =
            other ? stage_gearbox(scene, *other, record).inputs : record.inputs;
        torque = std::abs(shaft_torque_N_m(other_end(scene, stage), *coupled.shaft, inputs) /
                          shaft_torque_N_m(own, *coupled.stage_shaft, gearbox.inputs));
    }
    gearbox.inputs.torque_N_m *= torque;
    gearbox.inputs.fixed_shaft.load_torque_N_m *= torque;
    gearbox.inputs.speed_rad_s = there.speed_rad_s * record.inputs.speed_rad_s / here.speed_rad_s;
    if (!faulty) {
        gearbox.inputs.fault_size = 0.0;
    }
    return gearbox;
}

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
