#include "mc/results/batch_rows.hpp"

#include <algorithm>

namespace gearpod::mc {

BatchPlan::BatchPlan(std::int64_t threshold_instances, std::int64_t instances)
    : threshold_rows_(static_cast<std::size_t>(threshold_instances)),
      graded_rows_(static_cast<std::size_t>(instances)) {}

Batch BatchPlan::batch(std::size_t index) const {
    const bool threshold = index < threshold_batches();
    const std::size_t in_group = threshold ? index : index - threshold_batches();
    const std::size_t rows = threshold ? threshold_rows_ : graded_rows_;
    const std::size_t first = in_group * kBatchRows;
    return {threshold ? Group::threshold : Group::graded, first,
            threshold ? first : threshold_rows_ + first,
            std::min<std::size_t>(kBatchRows, rows - first)};
}

std::size_t BatchPlan::batch_of_row(std::size_t row) const {
    return row < threshold_rows_ ? row / kBatchRows
                                 : threshold_batches() + (row - threshold_rows_) / kBatchRows;
}

std::size_t BatchPlan::rows_before(std::size_t batches) const {
    return batches >= this->batches() ? rows() : batch(batches).first_row;
}

}  // namespace gearpod::mc
