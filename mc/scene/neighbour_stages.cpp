#include "mc/scene/neighbour_stages.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <string>

#include "mc/scene/scene_error.hpp"
#include "mc/study/fluctuations.hpp"
#include "mc/study/gears.hpp"

namespace gearpod::mc {
namespace {

constexpr const char* kKey = "sensor.stages";
constexpr double kSameSpeed = 1e-3;  // largest relative difference

// Shaft of a stage or of the study's gearbox, at nominal speed.
struct ShaftEnd {
    const Study& study;
    Member shaft;
    std::string of;

    std::string text() const { return fmt::format("the {} of {}", member_name(shaft), of); }
    double turns_Hz() const {
        const auto drivetrain = make_drivetrain(study);
        return drivetrain->shaft_turns_per_mesh(shaft) *
               std::abs(drivetrain->mesh_frequency_rad_s(nominal_inputs(study).speed_rad_s)) /
               (2.0 * std::numbers::pi);
    }
};

std::string named(const NeighbourStage& stage, const std::string& what) {
    return fmt::format("stage \"{}\": {}", stage.name, what);
}

void check_steady(const NeighbourStage& stage) {
    if (speed_fluctuates(*stage.study) || has_random_fluctuations(*stage.study)) {
        throw SceneError(kKey, named(stage, "its torque or speed fluctuates within a record"),
                         "give it a steady torque and speed");
    }
    for (const RandomInput& input : stage.study->random) {
        if (input.key.starts_with("operation.") && input.key.find("speed") != std::string::npos) {
            throw SceneError(kKey,
                             named(stage, input.key + " is random, but the common shaft sets it"),
                             "remove it from [random] there");
        }
    }
}

// The other end of a stage's common shaft.
ShaftEnd other_end(const Study& study, const NeighbourStage& stage) {
    for (const NeighbourStage& earlier : study.sensor.stages) {
        if (earlier.name == stage.of) {
            return {*earlier.study, *stage.shaft, fmt::format("stage \"{}\"", earlier.name)};
        }
    }
    return {study, *stage.shaft, "the study's gearbox"};
}

void check_shaft(const Study& study, const NeighbourStage& stage) {
    const ShaftEnd own{*stage.study, *stage.stage_shaft, "its gearbox"},
        other = other_end(study, stage);
    for (const ShaftEnd& end : {own, other}) {
        if (end.turns_Hz() == 0.0) {
            throw SceneError(kKey, named(stage, end.text() + " stands still"),
                             "name shafts that turn");
        }
    }
    const double ratio = other.turns_Hz() / own.turns_Hz();
    if (std::abs(ratio - 1.0) > kSameSpeed) {
        throw SceneError(
            kKey,
            named(stage, fmt::format("{} turns at {:.6g} rpm, but {} at {:.6g} rpm, and "
                                     "they are one shaft",
                                     own.text(), 60.0 * own.turns_Hz(), other.text(),
                                     60.0 * other.turns_Hz())),
            fmt::format("multiply the speed in its study by {:.8g}", ratio));
    }
}

// Every gearbox has two rows of its own in the stage: healthy gearboxes the even ones.
GearboxId id_in_stage(const GearboxId& id) {
    GearboxId other = id;
    other.group = Group::graded;
    other.index = 2 * id.index + (id.group == Group::graded ? 1 : 0);
    other.exchanged = {};
    return other;
}

}  // namespace

std::vector<Scene> stage_scenes(const Study& study) {
    std::vector<Scene> scenes;
    for (const NeighbourStage& stage : study.sensor.stages) {
        check_steady(stage);
        check_shaft(study, stage);
        if (stage.study->sensor.low_pass_Hz != study.sensor.low_pass_Hz) {
            throw SceneError(
                kKey,
                named(stage,
                      fmt::format("its sensor.low_pass_Hz is {:g}, but here it is {:g}",
                                  stage.study->sensor.low_pass_Hz, study.sensor.low_pass_Hz)),
                "give both the same, as there is one sensor");
        }
        Study own = *stage.study;
        // Other gearboxes here are other gearboxes there.
        own.ensemble.seed = static_cast<std::int64_t>(
            fnv1a(stage.name, static_cast<std::uint64_t>(study.ensemble.seed)) >> 1);
        scenes.emplace_back(own);
    }
    return scenes;
}

Realization stage_gearbox(const Scene& scene, std::size_t stage, const Realization& record) {
    const Scene& own = scene.stages()[stage];
    Realization gearbox = own.sampler().draw(id_in_stage(record.id));
    const InstanceInputs here = nominal_inputs(scene.study()), there = nominal_inputs(own.study());
    const double torque = record.inputs.torque_N_m / here.torque_N_m;
    gearbox.inputs.torque_N_m *= torque;
    gearbox.inputs.fixed_shaft.load_torque_N_m *= torque;
    gearbox.inputs.speed_rad_s = there.speed_rad_s * record.inputs.speed_rad_s / here.speed_rad_s;
    gearbox.inputs.fault_size = 0.0;
    return gearbox;
}

double stage_fault_size(const Scene& scene, std::size_t stage, const GearboxId& id) {
    return scene.stages()[stage].sampler().draw(id_in_stage(id)).inputs.fault_size;
}

}  // namespace gearpod::mc
