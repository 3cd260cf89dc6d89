#include "mc/ensemble/coupling/neighbour_stages.hpp"

#include <algorithm>
#include <boost/random/uniform_01.hpp>
#include <boost/random/uniform_int_distribution.hpp>
#include <cmath>

#include "mc/plan/gearbox_plan.hpp"
#include "mc/plan/tile_plan.hpp"

namespace gearpod::mc {
namespace {

double mesh_period_of(const GearboxPlan& gearbox) {
    return 1.0 / std::abs(gearbox.mesh_frequency_Hz);
}

// Every gearbox has two rows of its own in the stage: healthy gearboxes the even ones.
GearboxId id_in_stage(const GearboxId& id) {
    GearboxId other = id;
    other.group = Group::test;
    other.index = 2 * id.index + (id.group == Group::test ? 1 : 0);
    other.exchanged = {};
    return other;
}

}  // namespace

CoupledSpan coupled_span(const DrawPlan& draw, const GearboxPlan& gearbox, const RecordPlan& record,
                         const CoupledStages& coupled, const GearboxId& id) {
    CoupledSpan span;
    span.run_in = coupled.run_in_meshes;
    GearboxId shared = id;
    shared.index -= id.index % record.same_positions;
    shared.exchanged = {};
    for (std::size_t i = 0; i < gearbox.stages.size(); ++i) {
        const StagePlan& neighbour = gearbox.stages[i];
        if (!neighbour.shaft) {
            continue;
        }
        Philox engine = record_stream(draw.seed, shared,
                                      with_suffix(StreamPurpose::stage_start, neighbour.name));
        StageSpan& stage = span.stages.emplace_back();
        stage.stage = i;
        stage.period = mesh_period_of(*neighbour.gearbox) / mesh_period_of(gearbox);
        stage.lead = boost::random::uniform_01<double>()(engine);
        // The path repeats with the carrier.
        const signals::SpanLayout layout = neighbour.gearbox->drivetrain->span();
        const int turns = std::max(1, layout.meshes() / layout.carrier_meshes);
        stage.first_mesh = layout.carrier_meshes *
                           boost::random::uniform_int_distribution<int>(0, turns - 1)(engine);
        stage.run_in = static_cast<int>(span.run_in / stage.period) - kMarginMeshes;
        stage.start = (stage.run_in - stage.lead) * stage.period - span.run_in;
        stage.meshes = static_cast<int>(
            std::ceil((record.signal_meshes - stage.start) / stage.period) + kMarginMeshes);
    }
    return span;
}

std::vector<lockstep::CouplingShaft> coupling_shafts(const GearboxPlan& gearbox,
                                                     const CoupledSpan& span, std::size_t lanes) {
    const auto number_of = [&](std::size_t stage) {
        return 1 +
               static_cast<std::size_t>(std::ranges::find(span.stages, stage, &StageSpan::stage) -
                                        span.stages.begin());
    };
    std::vector<lockstep::CouplingShaft> shafts;
    for (const StageSpan& of : span.stages) {
        const StagePlan& stage = gearbox.stages[of.stage];
        lockstep::CouplingShaft& shaft = shafts.emplace_back();
        shaft.stage[0] = stage.other ? number_of(*stage.other) : 0;
        shaft.stage[1] = number_of(of.stage);
        std::ranges::copy(stage.shaft->end, shaft.end);
        shaft.stiffness_N_m_rad.assign(lanes, stage.shaft->stiffness_N_m_rad);
        shaft.damping_N_m_s_rad.assign(lanes, stage.shaft->damping_N_m_s_rad);
    }
    return shafts;
}

Realization stage_gearbox(const GearboxPlan& gearbox, const StagePlan& stage,
                          const Realization& record, bool faulty) {
    const GearboxPlan& there = *stage.gearbox;
    Realization next = stage.tile->sampler->draw(id_in_stage(record.id));
    const InstanceInputs& nominal = gearbox.nominal;
    double torque = nominal.torque_N_m != 0.0 ? record.inputs.torque_N_m / nominal.torque_N_m : 1.0;
    if (stage.shaft) {
        const InstanceInputs inputs =
            stage.other ? stage_gearbox(gearbox, gearbox.stages[*stage.other], record).inputs
                        : record.inputs;
        torque = std::abs(shaft_torque_N_m(other_end(gearbox, stage), stage.member[0], inputs) /
                          shaft_torque_N_m(there, stage.member[1], next.inputs));
    }
    next.inputs.torque_N_m *= torque;
    next.inputs.fixed_shaft.load_torque_N_m *= torque;
    next.inputs.speed_rad_s =
        there.nominal.speed_rad_s * record.inputs.speed_rad_s / nominal.speed_rad_s;
    if (!faulty) {
        next.inputs.fault_size = 0.0;
    }
    return next;
}

}  // namespace gearpod::mc
