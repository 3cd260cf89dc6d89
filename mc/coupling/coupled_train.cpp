#include "mc/coupling/coupled_train.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "dynamics/gearbox_matrices.hpp"
#include "dynamics/varying_forces.hpp"
#include "lockstep/steps/step_limit.hpp"
#include "lockstep/tile/step_integrator.hpp"
#include "mc/study/fluctuations.hpp"
#include "mc/study/housing.hpp"
#include "mc/study/other_sources.hpp"

namespace gearpod::mc {
namespace {

const NeighbourStage& stage_of(const Scene& scene, std::size_t stage) {
    return scene.study().sensor.stages[stage];
}

// End of a shaft at a gearbox. The shaft's positive sense is that in which it turns.
lockstep::ShaftEnd shaft_end(const Scene& gearbox, Member shaft) {
    const auto& layout = gearbox.plan().layout;
    const ShaftDegree degree = gearbox.drivetrain().shaft_degree(layout, shaft);
    const double turning = gearbox.drivetrain().rotation_m_s(nominal_inputs(gearbox.study())) *
                           dynamics::rigid_rotation(layout)(degree.degree);
    return {degree.degree, std::copysign(1.0 / degree.radius_m, turning)};
}

// Both ends of a stage's shaft. It bears opposite external torques there, so that the sense of the
// stage follows from its torque.
std::array<lockstep::ShaftEnd, 2> shaft_ends(const Scene& scene, std::size_t stage) {
    const NeighbourStage& own = stage_of(scene, stage);
    std::array<lockstep::ShaftEnd, 2> ends{shaft_end(other_end(scene, stage), *own.shaft),
                                           shaft_end(scene.stages()[stage], *own.stage_shaft)};
    if (is_mirrored(scene, stage)) {
        ends[1].turn_per_m *= -1.0;
    }
    return ends;
}

double mesh_period_of(const Scene& gearbox) {
    return 1.0 / std::abs(gearbox.nominal_mesh_frequency_Hz());
}

// Steps per mesh period that the nominal gearbox needs with its shafts held at their other ends.
double needed_steps(const Scene& gearbox, const std::vector<dynamics::SpringDamper>& shafts) {
    const auto inputs = gearbox.inputs(nominal_inputs(gearbox.study()));
    auto matrices = dynamics::assemble(gearbox.plan().layout, inputs, gearbox.stiffest_pairs());
    for (const dynamics::SpringDamper& shaft : shafts) {
        dynamics::add(matrices, shaft);
    }
    return dynamics::mesh_period_s(inputs) /
           lockstep::longest_stable_step(matrices, gearbox.plan().integrator);
}

// Shafts at one gearbox of the train: the study's own without `stage`.
std::vector<dynamics::SpringDamper> shafts_at(const Scene& scene,
                                              std::optional<std::size_t> stage) {
    const Scene& gearbox = stage ? scene.stages()[*stage] : scene;
    std::vector<dynamics::SpringDamper> shafts;
    const auto add = [&](std::size_t of, Member member) {
        const lockstep::ShaftEnd end = shaft_end(gearbox, member);
        dynamics::SpringDamper spring;
        spring.row = Eigen::VectorXd::Zero(dynamics::degrees_of_freedom(gearbox.plan().layout));
        spring.row(end.degree) = end.turn_per_m;
        spring.stiffness = stage_of(scene, of).shaft_stiffness_N_m_rad;
        spring.damping = shaft_mode(scene, of).damping_N_m_s_rad;
        shafts.push_back(std::move(spring));
    };
    for (std::size_t i = 0; i < scene.stages().size(); ++i) {
        if (!stage_of(scene, i).coupled()) {
            continue;
        }
        if (stage == i) {
            add(i, *stage_of(scene, i).stage_shaft);
        }
        if (stage == other_stage(scene.study(), i)) {
            add(i, *stage_of(scene, i).shaft);
        }
    }
    return shafts;
}

// Checks that a gearbox, the study's own without `stage`, can be integrated with its shafts.
void check_gearbox(const Scene& scene, std::optional<std::size_t> stage) {
    const Scene& gearbox = stage ? scene.stages()[*stage] : scene;
    const Study& study = gearbox.study();
    const std::string of = stage ? fmt::format("stage \"{}\": ", stage_of(scene, *stage).name) : "";
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
    const auto shafts = shafts_at(scene, stage);
    if (shafts.size() > lockstep::kMostShafts) {
        throw SceneError(kStagesKey,
                         fmt::format("{}{} elastic shafts at one gearbox; at most {} can be "
                                     "computed",
                                     of, shafts.size(), lockstep::kMostShafts),
                         "couple fewer stages");
    }
    const double needed = needed_steps(gearbox, shafts);
    const auto steps = static_cast<double>(gearbox.plan().grid.steps.size());
    if (steps < needed) {
        throw SceneError(
            kStagesKey,
            fmt::format("{}with its shafts the gearbox needs {:.0f} steps per mesh period to be "
                        "stable, and has {:.0f}",
                        of, std::ceil(needed), steps),
            fmt::format("give numerics.steps_per_mesh = {:.0f} {}, or a softer shaft",
                        std::ceil(1.05 * needed), where));
    }
}

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
            fmt::format("stage \"{}\": the common shaft bears no torque {}", own.name,
                        torque == 0.0 ? "in the gearbox at its other end" : "in this stage"),
            "give both a torque (operation.torque_N_m)");
    }
}

}  // namespace

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

CoupledSpan coupled_span(const Scene& scene, int run_in_meshes) {
    CoupledSpan span;
    const double own = mesh_period_of(scene);
    double run_in = run_in_meshes;
    for (std::size_t i = 0; i < scene.stages().size(); ++i) {
        if (!stage_of(scene, i).coupled()) {
            continue;
        }
        const ShaftMode mode = shaft_mode(scene, i);
        const double rate_1_s =
            2.0 * std::numbers::pi * mode.frequency_Hz * stage_of(scene, i).shaft_damping_ratio;
        run_in = std::max(run_in, -std::log(convergence_tolerance(scene.study())) / rate_1_s / own);
        span.stages.push_back({i, mesh_period_of(scene.stages()[i]) / own});
        run_in = std::max(run_in, (kMarginMeshes + 1) * span.stages.back().period);
    }
    span.run_in = static_cast<int>(std::ceil(run_in));
    for (StageSpan& stage : span.stages) {
        stage.run_in = static_cast<int>(span.run_in / stage.period) - kMarginMeshes;
        stage.start = stage.run_in * stage.period - span.run_in;
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

void check_coupling(const Scene& scene) {
    if (!is_coupled(scene.study())) {
        return;
    }
    if (scene.study().effects.quasi_static()) {
        throw SceneError("effects.motion",
                         "an elastic shaft to another stage needs gears with inertia",
                         "choose another motion than quasi-static");
    }
    if (scene.study().numerics.verify) {
        throw SceneError("numerics.verify",
                         "would repeat gearboxes with finer steps of the study's own stage only",
                         "remove it; compare runs with another numerics.steps_per_mesh");
    }
    if (scene.study().numerics.horizon == Horizon::periodic) {
        throw SceneError("numerics.horizon",
                         "with an elastic shaft to another stage no mesh period repeats another",
                         "use \"full\"");
    }
    check_gearbox(scene, std::nullopt);
    for (std::size_t i = 0; i < scene.stages().size(); ++i) {
        if (stage_of(scene, i).coupled()) {
            check_gearbox(scene, i);
            check_balance(scene, i);
        }
    }
}

}  // namespace gearpod::mc
