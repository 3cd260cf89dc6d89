#include "mc/coupling/coupled_train.hpp"

#include <algorithm>
#include <array>
#include <boost/random/uniform_01.hpp>
#include <boost/random/uniform_int_distribution.hpp>
#include <cmath>
#include <numbers>

#include "dynamics/gearbox_matrices.hpp"
#include "dynamics/varying_forces.hpp"
#include "mc/coupling/record_positions.hpp"
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
            record_stream(scene.study(), shared,
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

}  // namespace gearpod::mc
