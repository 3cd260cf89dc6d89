#include "mc/library/simulated_row.hpp"

#include <fmt/format.h>

#include "mc/input/bad_input.hpp"
#include "mc/results/batch_rows.hpp"

namespace gearpod::mc {

Simulation simulate_row(const Scene& scene, long row, long meshes) {
    const Study& study = scene.study();
    const auto rows = static_cast<long>(BatchPlan(study.ensemble).rows());
    const long simulated = meshes > 0 ? meshes : scene.span().planet_teeth;
    if (row < 0 || row >= rows || simulated > scene.signal_meshes()) {
        throw BadInput(fmt::format(
            "--instance must be a row of the results, 0 to {}; --meshes must be at most {}",
            rows - 1, scene.signal_meshes()));
    }
    return simulate(scene, id_of_row(study, row), simulated);
}

}  // namespace gearpod::mc
