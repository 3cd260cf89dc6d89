#include "mc/results/batch_rows.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

namespace gearpod::mc {

std::string Part::text() const {
    return whole() ? "" : fmt::format("{}/{}", index + 1, count);
}

std::optional<Part> read_part(const std::string& text) {
    if (text.empty()) {
        return Part{};
    }
    constexpr std::size_t kMostParts = 1'000'000;
    Part part;
    const char* end = text.data() + text.size();
    const auto first = std::from_chars(text.data(), end, part.index);
    if (first.ec != std::errc() || first.ptr == end || *first.ptr != '/') {
        return std::nullopt;
    }
    const auto second = std::from_chars(first.ptr + 1, end, part.count);
    if (second.ec != std::errc() || second.ptr != end || part.index < 1 ||
        part.index > part.count || part.count > kMostParts) {
        return std::nullopt;
    }
    --part.index;
    return part;
}

BatchPlan::BatchPlan(std::int64_t threshold_instances, std::int64_t instances, const Part& part,
                     int threshold_records)
    : thresholds_(static_cast<std::size_t>(threshold_instances)),
      graded_(static_cast<std::size_t>(instances)),
      records_(static_cast<std::size_t>(threshold_records)),
      part_(part) {}

Batch BatchPlan::batch(std::size_t index) const {
    const std::size_t all = number(index), thresholds = all_threshold_batches();
    const bool threshold = all < thresholds;
    const std::size_t in_group = threshold ? all : all - thresholds;
    const std::size_t gearboxes = threshold ? thresholds_ : graded_;
    const std::size_t first = in_group * kBatchRows;
    return {threshold ? Group::threshold : Group::graded, first, rows_before(index),
            std::min<std::size_t>(kBatchRows, gearboxes - first), threshold ? records_ : 1};
}

std::size_t BatchPlan::batch_of_row(std::size_t row) const {
    // All batches before the last one of the threshold group are full.
    const std::size_t thresholds = threshold_batches(), before = threshold_rows();
    return row < before ? row / (kBatchRows * records_) : thresholds + (row - before) / kBatchRows;
}

std::size_t BatchPlan::gearboxes_before(std::size_t batches) const {
    const std::size_t until = std::min(batches, this->batches());
    std::size_t gearboxes = until * kBatchRows;
    // Only the last batch of each group may be incomplete.
    const auto short_of = [&](std::size_t last, std::size_t instances) {
        const bool own = last % part_.count == part_.index && last / part_.count < until;
        return own ? (kBatchRows - instances % kBatchRows) % kBatchRows : 0;
    };
    const std::size_t thresholds = all_threshold_batches(), graded = batches_of(graded_);
    gearboxes -= thresholds > 0 ? short_of(thresholds - 1, thresholds_) : 0;
    gearboxes -= graded > 0 ? short_of(thresholds + graded - 1, graded_) : 0;
    return gearboxes;
}

std::size_t BatchPlan::rows_before(std::size_t batches) const {
    const std::size_t healthy = gearboxes_before(std::min(batches, threshold_batches()));
    return gearboxes_before(batches) + (records_ - 1) * healthy;
}

}  // namespace gearpod::mc
