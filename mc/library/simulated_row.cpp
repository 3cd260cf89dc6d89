#include "mc/library/simulated_row.hpp"

#include <fmt/format.h>

#include "mc/input/bad_input.hpp"
#include "mc/results/batch_rows.hpp"
#include "mc/scene/feature_needs.hpp"

namespace gearpod::mc {

Simulation simulate_row(const Scene& scene, long row, long meshes) {
    const Study& study = scene.study();
    const auto rows = static_cast<long>(BatchPlan(study.ensemble).rows());
    const long simulated = meshes > 0 ? meshes : scene.span().planet_teeth;
    // A record of given length begins within the span.
    const int most = scene.signal_meshes() - (has_record_length(study) ? scene.span_meshes() : 0);
    std::string problems;
    if (row < 0 || row >= rows) {
        problems =
            fmt::format("--instance {}: must be a row of the results, 0 to {}", row, rows - 1);
    }
    if (simulated > most) {
        problems += fmt::format("{}--meshes {}: must be at most {}", problems.empty() ? "" : "\n",
                                simulated, most);
    }
    if (!problems.empty()) {
        throw BadInput(problems);
    }
    return simulate(scene, id_of_row(study, row), simulated);
}

}  // namespace gearpod::mc
