#include "mc/coupling/stage_gearbox.hpp"

#include <cmath>

#include "mc/coupling/coupled_train.hpp"

namespace gearpod::mc {
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

}  // namespace gearpod::mc
