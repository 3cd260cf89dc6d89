// Strategies for the solution of a tile. Each is a type with exactly the inputs that it uses;
// adding one takes its header, its source, and its name in the list below.
#pragma once

#include <algorithm>
#include <variant>

#include "lockstep/strategies/integrated_solutions.hpp"
#include "lockstep/strategies/quasi_static_solution.hpp"
#include "lockstep/strategies/superposed_solution.hpp"
#include "machine/contracts.hpp"

namespace gearpod::lockstep {

using Solution = std::variant<PeriodicSolution, FullSolution, SuperposedSolution, FaultPerturbation,
                              QuasiStaticSolution>;

// Solves a tile of W lanes: 1, 4, 8, or 16 in single precision. A lane's result never depends on
// the other lanes. Throws std::invalid_argument if the plan does not support the excitation or the
// tooth errors of the strategy.
template <int W>
TileResult run_tile(const IntegrationPlan& plan, std::span<const dynamics::GearboxInputs> gearboxes,
                    const FaultCurves& faults, const Solution& solution) {
    EXPECTS(gearboxes.size() == W &&
            std::ranges::all_of(faults.curve, [](const auto& lanes) { return lanes.size() == W; }));
    const TileInputs tile{plan, gearboxes, faults};
    return std::visit([&](const auto& strategy) { return strategy.template run<W>(tile); },
                      solution);
}

}  // namespace gearpod::lockstep
