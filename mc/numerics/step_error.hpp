// Error that the time steps leave in the signals of gearboxes whose teeth lose contact. Loss of
// contact happens at times that no grid knows, so that it costs an integrator its order, and a
// tolerance of the steps between contact transitions does not bound it.
#pragma once

#include <optional>
#include <string>

#include "mc/results/results_file.hpp"
#include "mc/scene/scene.hpp"

namespace gearpod::mc {

// Eight graded gearboxes are integrated over a few mesh periods as a run does it, and again with
// finer steps in double precision. None where teeth cannot part, of a quasi-static study, where no
// gearbox of the pilot works, and where the pilot costs more than `most_meshes` mesh periods of a
// tile by the scene's own steps.
std::optional<StepError> find_step_error(const Scene& scene, double most_meshes);
// The same for a run of so many gearboxes, of whose work it takes at most a fiftieth.
std::optional<StepError> find_step_error_of_run(const Scene& scene, std::size_t gearboxes);

// "3.5e-03 of the sensor signal, ... (rms; 8 gearboxes, 16 mesh periods, 240 against 960 steps)".
std::string step_error_text(const StepError& error);

}  // namespace gearpod::mc
