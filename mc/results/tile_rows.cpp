#include "mc/results/tile_rows.hpp"

#include <algorithm>

namespace gearpod::mc {

TilePlan::TilePlan(std::int64_t threshold_instances, std::int64_t instances)
    : threshold_rows_(static_cast<std::size_t>(threshold_instances)),
      graded_rows_(static_cast<std::size_t>(instances)) {}

Tile TilePlan::tile(std::size_t index) const {
    const bool threshold = index < threshold_tiles();
    const std::size_t in_group = threshold ? index : index - threshold_tiles();
    const std::size_t rows = threshold ? threshold_rows_ : graded_rows_;
    const std::size_t first = in_group * kTileRows;
    return {threshold ? Group::threshold : Group::graded, first,
            threshold ? first : threshold_rows_ + first,
            std::min<std::size_t>(kTileRows, rows - first)};
}

std::size_t TilePlan::tile_of_row(std::size_t row) const {
    return row < threshold_rows_ ? row / kTileRows
                                 : threshold_tiles() + (row - threshold_rows_) / kTileRows;
}

std::size_t TilePlan::rows_before(std::size_t tiles) const {
    return tiles >= this->tiles() ? rows() : tile(tiles).first_row;
}

}  // namespace gearpod::mc
