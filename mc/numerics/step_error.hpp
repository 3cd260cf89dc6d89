// Discretization error of the signals of gearboxes whose teeth lose contact. Loss of contact
// happens at times that lie between grid nodes, which reduces an integrator's order. A tolerance
// for the steps between contact transitions does not bound this error.
#pragma once

#include <optional>
#include <string>

#include "mc/results/results_file.hpp"
#include "mc/scene/scene.hpp"

namespace gearpod::mc {

// Integrates eight test gearboxes over a few mesh periods as a run does, and again with finer
// steps in double precision. Empty if teeth cannot separate, if the study is quasi-static, or if no
// gearbox of the pilot succeeds. Also empty if the pilot costs more than `most_meshes` mesh periods
// of a tile with the scene's own steps.
std::optional<StepError> find_step_error(const Scene& scene, double most_meshes);
// The same for a run of this many gearboxes; it may cost a fiftieth of their work.
std::optional<StepError> find_step_error_of_run(const Scene& scene, std::size_t gearboxes);

// "3.5e-03 of the sensor signal, ... (rms; 8 gearboxes, 16 mesh periods, 240 against 960 steps)".
std::string step_error_text(const StepError& error);

}  // namespace gearpod::mc
