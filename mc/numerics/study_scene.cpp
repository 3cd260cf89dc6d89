#include "mc/numerics/study_scene.hpp"

#include <exception>

#include "machine/dispatch.hpp"
#include "mc/study/gears.hpp"

namespace gearpod::mc {
namespace {

void choose_instruction_set(InstructionSet set) {
    switch (set) {
        case InstructionSet::baseline:
            return machine::use_instruction_set(machine::InstructionSet::baseline);
        case InstructionSet::x86_64_v3:
            return machine::use_instruction_set(machine::InstructionSet::x86_64_v3);
        case InstructionSet::x86_64_v4:
            return machine::use_instruction_set(machine::InstructionSet::x86_64_v4);
        case InstructionSet::automatic:
            break;
    }
    machine::use_instruction_set(machine::best_instruction_set());
}

StudyScene refused(Problems problems) {
    StudyScene none;
    none.problems = std::move(problems);
    return none;
}

}  // namespace

StudyScene make_scene(const std::string& name, StudyReading reading) {
    if (!reading.study) {
        return refused(std::move(reading.problems));
    }
    if (!has_gears(*reading.study)) {
        return refused({{name, 0, "gearbox.sun_teeth",
                         "no tooth numbers or no module (only modes and describe do without)",
                         "give sun_teeth, planet_teeth, ring_teeth and module_mm"}});
    }
    try {
        choose_instruction_set(reading.study->numerics.instruction_set);
    } catch (const std::exception& error) {
        return refused({{name, 0, "numerics.instruction_set", error.what(), "use auto"}});
    }
    try {
        ResolvedStudy resolved = resolve_numerics(*std::move(reading.study));
        return {std::make_unique<const Scene>(resolved.study), std::move(resolved.choice), {}};
    } catch (const SceneError& error) {
        return refused({{name, 0, error.key(), error.what(), error.remedy()}});
    }
}

}  // namespace gearpod::mc
