#include "lockstep/excitation/row_layout.hpp"

namespace gearpod::lockstep {

int columns_in(const Excitation& e) {
    return (e.torque ? 1 : 0) + (e.gravity ? 2 : 0) + (e.speed ? 1 : 0) +
           static_cast<int>(e.shafts.size());
}

int values_in_row(const Excitation& e) {
    return columns_in(e) + (e.speed ? static_cast<int>(speed_value_count) : 0);
}

int distinct_nodes_per_step(const PhaseGrid& grid) {
    const auto nodes = static_cast<int>(grid.stage_nodes.size());
    return grid.stage_nodes.front() == 0.0 && grid.stage_nodes.back() == 1.0 ? nodes - 1 : nodes;
}

}  // namespace gearpod::lockstep
