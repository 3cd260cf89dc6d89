#include "mc/plan/coupled_shafts.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "dynamics/gearbox_matrices.hpp"

namespace gearpod::mc {
namespace {

// End of a shaft at a gearbox. The shaft's positive sense is that in which it turns.
lockstep::ShaftEnd shaft_end(const GearboxPlan& gearbox, Member shaft) {
    const auto& layout = gearbox.bodies.layout;
    const ShaftDegree degree = gearbox.drivetrain->shaft_degree(layout, shaft);
    const double turning = gearbox.drivetrain->rotation_m_s(gearbox.nominal) *
                           dynamics::rigid_rotation(layout)(degree.degree);
    return {degree.degree, std::copysign(1.0 / degree.radius_m, turning)};
}

// Inertia of the whole nominal gearbox as that shaft feels it while no spring deflects, kg m^2.
double shaft_inertia_kg_m2(const GearboxPlan& gearbox, Member shaft) {
    const auto& layout = gearbox.bodies.layout;
    const lockstep::ShaftEnd end = shaft_end(gearbox, shaft);
    const auto inputs = gearbox.inputs(gearbox.nominal);
    const Eigen::VectorXd turn = dynamics::rigid_rotation(layout);
    const std::vector<double> none(static_cast<std::size_t>(dynamics::pairs(layout)), 0.0);
    const double rate = end.turn_per_m * turn(end.degree);
    return turn.dot(dynamics::assemble(layout, inputs, none).mass * turn) / (rate * rate);
}

}  // namespace

StageShaft make_shaft(const NeighbourStage& given, const GearboxPlan& other,
                      const GearboxPlan& stage) {
    StageShaft shaft;
    const Member here = *given.shaft, there = *given.stage_shaft;
    shaft.stiffness_N_m_rad = given.shaft_stiffness_N_m_rad;
    shaft.damping_ratio = given.shaft_damping_ratio;
    shaft.end[0] = shaft_end(other, here);
    shaft.end[1] = shaft_end(stage, there);
    shaft.mirrored = shaft_torque_N_m(other, here, other.nominal) *
                         shaft_torque_N_m(stage, there, stage.nominal) >
                     0.0;
    if (shaft.mirrored) {
        shaft.end[1].turn_per_m *= -1.0;
    }
    const double a = shaft_inertia_kg_m2(other, here), b = shaft_inertia_kg_m2(stage, there);
    const double inertia = a * b / (a + b), stiffness = given.shaft_stiffness_N_m_rad;
    shaft.frequency_Hz = std::sqrt(stiffness / inertia) / (2.0 * std::numbers::pi);
    shaft.damping_N_m_s_rad = 2.0 * given.shaft_damping_ratio * std::sqrt(stiffness * inertia);
    return shaft;
}

const GearboxPlan& other_end(const GearboxPlan& gearbox, const StagePlan& stage) {
    return stage.other ? *gearbox.stages[*stage.other].gearbox : gearbox;
}

double shaft_torque_N_m(const GearboxPlan& gearbox, Member shaft, const InstanceInputs& inputs) {
    const lockstep::ShaftEnd end = shaft_end(gearbox, shaft);
    return dynamics::torque_force(gearbox.bodies.layout, gearbox.inputs(inputs))(end.degree) /
           end.turn_per_m;
}

std::vector<double> train_frequencies_Hz(const GearboxPlan& gearbox) {
    std::vector<const GearboxPlan*> gearboxes{&gearbox};
    std::vector<Eigen::Index> first{0}, first_of_stage(gearbox.stages.size(), 0);
    const auto degrees = [](const GearboxPlan& plan) {
        return Eigen::Index{dynamics::degrees_of_freedom(plan.bodies.layout)};
    };
    Eigen::Index size = degrees(gearbox);
    for (std::size_t i = 0; i < gearbox.stages.size(); ++i) {
        const StagePlan& stage = gearbox.stages[i];
        if (stage.shaft) {
            gearboxes.push_back(stage.gearbox.get());
            first.push_back(size);
            first_of_stage[i] = size;
            size += degrees(*stage.gearbox);
        }
    }
    dynamics::GearboxMatrices train = dynamics::zero_matrices(static_cast<int>(size));
    for (std::size_t g = 0; g < gearboxes.size(); ++g) {
        const GearboxPlan& plan = *gearboxes[g];
        const auto matrices = dynamics::assemble(plan.bodies.layout, plan.inputs(plan.nominal),
                                                 plan.stiffness->mean_pairs());
        const Eigen::Index n = matrices.mass.rows();
        train.mass.block(first[g], first[g], n, n) = matrices.mass;
        train.stiffness.block(first[g], first[g], n, n) = matrices.stiffness;
    }
    for (std::size_t i = 0; i < gearbox.stages.size(); ++i) {
        const StagePlan& stage = gearbox.stages[i];
        if (!stage.shaft) {
            continue;
        }
        const auto& [here, there] = stage.shaft->end;
        dynamics::SpringDamper shaft;
        shaft.row = Eigen::VectorXd::Zero(size);
        shaft.row((stage.other ? first_of_stage[*stage.other] : 0) + here.degree) = here.turn_per_m;
        shaft.row(first_of_stage[i] + there.degree) = -there.turn_per_m;
        shaft.stiffness = stage.shaft->stiffness_N_m_rad;
        dynamics::add(train, shaft);
    }
    return dynamics::natural_frequencies_Hz(train);
}

double coupled_run_in(const GearboxPlan& gearbox, double tolerance, int run_in_meshes) {
    const auto period = [](const GearboxPlan& plan) {
        return 1.0 / std::abs(plan.mesh_frequency_Hz);
    };
    double run_in = run_in_meshes;
    for (const StagePlan& stage : gearbox.stages) {
        if (stage.shaft) {
            const double rate_1_s =
                2.0 * std::numbers::pi * stage.shaft->frequency_Hz * stage.shaft->damping_ratio;
            const double decay_s = -std::log(tolerance) / rate_1_s;
            run_in = std::max({run_in, decay_s / period(gearbox),
                               (kMarginMeshes + 1) * period(*stage.gearbox) / period(gearbox)});
        }
    }
    return std::ceil(run_in);
}

}  // namespace gearpod::mc
