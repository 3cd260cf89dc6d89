// The rows of an ensemble and the batches that are computed, stored and exchanged as one.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "mc/random/philox.hpp"
#include "mc/study/study.hpp"

namespace gearpod::mc {

// Gearboxes of a batch, whatever the lanes: the unit of work must not depend on who does it. A
// gearbox has a row a record, one but in the threshold group (ensemble.threshold_records).
inline constexpr int kBatchRows = 16;

// Numbers in a row: the parameters, of which the last is the fault's size, then features x noise
// levels, then the contact loss ratio of each mesh.
struct RowShape {
    std::size_t parameters = 0;
    std::size_t features = 0;
    std::size_t levels = 0;
    std::size_t meshes = 0;  // 0 where teeth cannot part

    std::size_t values() const { return contact_loss() + meshes; }
    // The place of the first contact loss ratio.
    std::size_t contact_loss() const { return parameters + features * levels; }
    std::size_t value_of(std::size_t feature, std::size_t level) const {
        return parameters + feature * levels + level;
    }
    bool operator==(const RowShape&) const = default;
};

// Those of up to kBatchRows gearboxes.
struct BatchRows {
    std::vector<int> status;     // Status by row
    std::vector<double> values;  // rows x RowShape::values()

    std::size_t count() const { return status.size(); }
};

// Consecutive gearboxes of one group, and of each its records in a row.
struct Batch {
    Group group = Group::graded;
    std::uint64_t first_index = 0;  // in the group
    std::size_t first_row = 0;      // in the results
    std::size_t gearboxes = 0;
    std::size_t records = 1;

    std::size_t rows() const { return gearboxes * records; }
};

// A share of an ensemble that a run of its own computes: of every `count` batches one, so that all
// parts have about as many of either group.
struct Part {
    std::size_t index = 0;  // below count
    std::size_t count = 1;

    bool whole() const { return count == 1; }
    std::string text() const;  // "2/4" of index 1, "" of a whole
    bool operator==(const Part&) const = default;
};
// Of "2/4", or "" for a whole.
std::optional<Part> read_part(const std::string& text);

// All batches of an ensemble: first the threshold group's, then the graded group's. A larger graded
// group begins with the batches of a smaller one, but for the last, which may be filled up. Of a
// part its own batches and rows, numbered from 0 in the same order.
class BatchPlan {
  public:
    BatchPlan(std::int64_t threshold_instances, std::int64_t instances, const Part& part = {},
              int threshold_records = 1);
    explicit BatchPlan(const Ensemble& ensemble, const Part& part = {})
        : BatchPlan(ensemble.threshold_instances, ensemble.instances, part,
                    ensemble.threshold_records) {}

    std::size_t rows() const { return rows_before(batches()); }
    std::size_t threshold_rows() const { return rows_before(threshold_batches()); }
    std::size_t graded_rows() const { return rows() - threshold_rows(); }
    std::size_t threshold_gearboxes() const { return threshold_rows() / records_; }
    // Of a gearbox of the threshold group.
    std::size_t threshold_records() const { return records_; }
    // What a row is: gearboxes have one each, but for those with several records.
    const char* counted() const { return records_ > 1 ? "records" : "gearboxes"; }
    // Of the whole ensemble.
    std::size_t graded_instances() const { return graded_; }
    std::size_t batches() const { return own_of(all_threshold_batches() + batches_of(graded_)); }
    std::size_t threshold_batches() const { return own_of(all_threshold_batches()); }
    Batch batch(std::size_t index) const;
    // Its number in the whole ensemble.
    std::size_t number(std::size_t index) const { return part_.index + index * part_.count; }
    std::size_t batch_of_row(std::size_t row) const;
    // Rows of the first `batches` batches.
    std::size_t rows_before(std::size_t batches) const;

  private:
    static std::size_t batches_of(std::size_t rows) { return (rows + kBatchRows - 1) / kBatchRows; }
    std::size_t all_threshold_batches() const { return batches_of(thresholds_); }
    // How many of the ensemble's first batches are the part's.
    std::size_t own_of(std::size_t first) const {
        return (first + part_.count - 1 - part_.index) / part_.count;
    }

    std::size_t gearboxes_before(std::size_t batches) const;

    std::size_t thresholds_, graded_, records_;  // gearboxes, and records of the former
    Part part_;
};

// Finished batches by their number.
class RowStore {
  public:
    virtual ~RowStore() = default;
    virtual bool has(std::size_t batch) const = 0;
    virtual BatchRows read(std::size_t batch) const = 0;
    virtual void write(std::size_t batch, const BatchRows& rows) = 0;
    // What was written is safe from now on.
    virtual void sync() {}
};

// In memory.
class MemoryRows final : public RowStore {
  public:
    explicit MemoryRows(std::size_t batches) : batches_(batches) {}
    bool has(std::size_t batch) const override { return batches_[batch].count() > 0; }
    BatchRows read(std::size_t batch) const override { return batches_[batch]; }
    void write(std::size_t batch, const BatchRows& rows) override { batches_[batch] = rows; }

  private:
    std::vector<BatchRows> batches_;
};

}  // namespace gearpod::mc
