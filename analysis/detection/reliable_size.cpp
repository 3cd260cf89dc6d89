#include "analysis/detection/reliable_size.hpp"

namespace gearpod::analysis {

std::optional<SizeGroup> reliable_size(const LevelDetection& level, double pd) {
    std::optional<SizeGroup> size;
    for (auto cell = level.cells.rbegin(); cell != level.cells.rend(); ++cell) {
        if (cell->size.high <= 0.0 || !(cell->lower >= pd)) {
            break;
        }
        size = cell->size;
    }
    return size;
}

}  // namespace gearpod::analysis
