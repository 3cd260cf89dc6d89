// Choice of the strategy with which the tiles of a study are solved.
#pragma once

#include <optional>

#include "lockstep/strategies/solution.hpp"
#include "mc/scene/scene.hpp"

namespace gearpod::mc {

// Tooth errors and excitation of a tile, if the study has any. The solution refers to both.
struct TileLoads {
    std::optional<lockstep::ToothErrors> tooth_errors;
    std::optional<lockstep::Excitation> excitation;
};

// Criterion for the convergence to a periodic orbit.
lockstep::Convergence convergence_of(const Scene& scene);

// `options`, `on_record` and `parts` as in lockstep::RecordedSpan. `on_record` is used only if
// every mesh period is integrated (records_during_integration), and `parts` only with full
// integration.
lockstep::Solution choose_solution(const Scene& scene, const TileLoads& loads,
                                   const lockstep::RecordOptions& options,
                                   std::function<void(int, const lockstep::MeshRecord&)> on_record,
                                   std::vector<lockstep::SpanPart> parts = {});

// Perturbation of these healthy states; only for scenes for which integrates_perturbation_only is
// true.
lockstep::FaultPerturbation fault_perturbation(const Scene& scene, const TileLoads& loads,
                                               const lockstep::SpanStates& healthy);

// True if only the perturbation from the healthy solution has to be integrated: every mesh period
// of the span is integrated, under a constant excitation and without coupled stages.
bool integrates_perturbation_only(const Scene& scene);

}  // namespace gearpod::mc
