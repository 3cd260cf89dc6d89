#include "mc/numerics/study_scene.hpp"

#include <algorithm>
#include <array>
#include <iterator>
#include <stdexcept>

#include "lockstep/kernels/kernel_table.hpp"
#include "mc/files/python/python_worker.hpp"
#include "mc/plan/mesh_loads.hpp"
#include "mc/study/gears.hpp"
#include "mc/study/other_sources.hpp"

namespace gearpod::mc {
namespace {

StudyScene refused(Problems problems) {
    StudyScene none;
    none.problems = std::move(problems);
    return none;
}

// Chooses the numerics of neighbouring stages that leave them to a tolerance, at their speed here.
void choose_numerics_of_stages(Study& study) {
    const std::vector<Study> studies = stage_studies(study);
    for (std::size_t i = 0; i < studies.size(); ++i) {
        NeighbourStage& stage = study.sensor.stages[i];
        Study resolved = *stage.study;
        resolved.numerics = resolve_numerics(Planner(studies[i]), studies[i].numerics).numerics;
        stage.text = resolved_text(resolved);
        stage.study = std::make_shared<const Study>(std::move(resolved));
    }
}

}  // namespace

StudyScene make_scene(const std::string& name, StudyReading reading) {
    if (!reading.study) {
        return refused(std::move(reading.problems));
    }
    if (!has_gears(*reading.study)) {
        return refused({{name, 0, "gearbox.sun.teeth",
                         "no tooth numbers or no module (only the commands modes and describe work "
                         "without them)",
                         "give the teeth of sun, planet and ring, and module_mm"}});
    }
    try {
        lockstep::choose_instruction_set(reading.study->numerics.instruction_set);
    } catch (const std::invalid_argument& error) {
        return refused({{name, 0, "numerics.instruction_set", error.what(), "use auto"}});
    }
    try {
        lockstep::check_lanes(reading.study->numerics.precision, reading.study->numerics.lanes);
    } catch (const lockstep::MissingKernel& error) {
        return refused({{name, 0, "numerics.lanes", error.what(),
                         "remove it, or build with all kernels (preset portable)"}});
    }
    try {
        const Numerics& numerics = reading.study->numerics;
        if (is_coupled(*reading.study) &&
            (numerics.tolerance > 0.0 || numerics.scatter_tolerance > 0.0)) {
            throw SceneError(
                numerics.tolerance > 0.0 ? "numerics.tolerance" : "numerics.scatter_tolerance",
                "cannot choose the numerics of stages that elastic shafts couple",
                "give numerics.integrator = \"central-difference\", precision = "
                "\"double\" and, if needed, steps_per_mesh");
        }
        choose_numerics_of_stages(*reading.study);
        const Planner planner(*reading.study);
        ResolvedNumerics resolved = resolve_numerics(planner, numerics);
        StudyScene made{std::make_unique<const Scene>(planner.scene(resolved.numerics)),
                        std::move(resolved.choice),
                        {},
                        std::move(reading.notices),
                        planner.with(resolved.numerics)};
        check_stages(*reading.study, *made.scene);
        for (Problems& more :
             std::array{stage_notices(*reading.study, name), load_warnings(*reading.study, name)}) {
            std::ranges::move(more, std::back_inserter(made.notices));
        }
        return made;
    } catch (const SceneError& error) {
        return refused({{name, 0, error.key(), error.what(), error.remedy(), error.kind()}});
    } catch (const PythonError& error) {
        return refused({{name, 0, "features.python", error.what(), ""}});
    }
}

}  // namespace gearpod::mc
