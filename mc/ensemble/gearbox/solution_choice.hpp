// Calls code that is compiled for a fixed number of lanes.
#pragma once

#include <optional>
#include <type_traits>

#include "lockstep/strategies/solution.hpp"
#include "mc/plan/tile_plan.hpp"

namespace gearpod::mc {

// Calls call(std::integral_constant<int, W>) for W = 1, 4, 8 or 16 lanes.
template <class Call>
auto with_lane_count(int lanes, Call call) {
    if (lanes == 1) {
        return call(std::integral_constant<int, 1>());
    }
    if (lanes == 4) {
        return call(std::integral_constant<int, 4>());
    }
    if (lanes == 8) {
        return call(std::integral_constant<int, 8>());
    }
    return call(std::integral_constant<int, 16>());
}

// Memory in bytes for the motion that a tile keeps.
double motion_bytes(const TilePlan& plan);

// Processor seconds of one thread for one healthy mesh period of a full tile with the study's
// excitation: the minimum of several integrations from rest.
double mesh_period_s(const DrawPlan& draw, const GearboxPlan& gearbox, const SolvePlan& solve,
                     const RecordPlan& record);

// Processor seconds of one step of the classical Runge-Kutta method, per gearbox of a full tile,
// with constant excitation. The study need not use this method.
double explicit_step_s(const GearboxPlan& gearbox, const SolvePlan& solve);

// Choice of the strategy with which the tiles of a study are solved.

// Tooth errors and excitation of a tile, if the study has any. The solution refers to both.
struct TileLoads {
    std::optional<lockstep::ToothErrors> tooth_errors;
    std::optional<lockstep::Excitation> excitation;
};

// Solution of a tile that is not coupled with other stages. `options`, `on_record` and `parts` as
// in lockstep::RecordedSpan. `on_record` is used only if every mesh period is integrated
// (records_during_integration), and `parts` only with full integration.
lockstep::Solution choose_solution(const SolvePlan& solve, const RecordPlan& record,
                                   const TileLoads& loads, const lockstep::RecordOptions& options,
                                   std::function<void(int, const lockstep::MeshRecord&)> on_record,
                                   std::vector<lockstep::SpanPart> parts = {});

// Perturbation of these healthy states. Precondition: solve.perturbation_only.
lockstep::FaultPerturbation fault_perturbation(const SolvePlan& solve, const TileLoads& loads,
                                               const lockstep::SpanStates& healthy);

}  // namespace gearpod::mc
