// Rows of an ensemble, and batches: the rows that are computed, stored and exchanged together.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "mc/results/results_file.hpp"
#include "mc/study/random/philox.hpp"
#include "mc/study/study.hpp"

namespace gearpod::mc {

// Number of gearboxes in a batch. It does not depend on the number of lanes, because the unit of
// work must be the same on every machine. A gearbox has one row per record: one, or
// ensemble.threshold_records in the threshold group.
inline constexpr int kBatchRows = 16;

// Numbers in a row: the parameters (input_columns()), then features x noise levels, then
// the contact loss ratio of each mesh, then whether the motion was superposed, then features x
// noise levels of each variant.
struct RowShape {
    std::size_t parameters = 0;
    std::size_t features = 0;
    std::size_t levels = 0;
    std::size_t meshes = 0;       // 0 if teeth cannot lose contact
    std::size_t variants = 0;     // as Results::variants
    std::size_t integration = 0;  // as Results::integration

    std::size_t values() const { return variant_value_of(variants, 0); }
    // Index of the fault size, and of the importance weight of a row that has one.
    std::size_t fault_size() const { return parameters - 1; }
    std::size_t noise_weight() const { return parameters - 2; }
    // Index of the first contact loss ratio.
    std::size_t contact_loss() const { return parameters + features * levels; }
    std::size_t integration_value() const { return contact_loss() + meshes; }
    std::size_t value_of(std::size_t feature, std::size_t level) const {
        return parameters + feature * levels + level;
    }
    // Index of the first noise level of a variant's feature.
    std::size_t variant_value_of(std::size_t variant, std::size_t feature) const {
        return integration_value() + integration + (variant * features + feature) * levels;
    }
    bool operator==(const RowShape&) const = default;
};

// Rows of up to kBatchRows gearboxes.
struct BatchRows {
    std::vector<int> status;     // Status of each row
    std::vector<double> values;  // rows x RowShape::values()

    std::size_t count() const { return status.size(); }
};

// Consecutive gearboxes of one group. The records of a gearbox follow one another.
struct Batch {
    Group group = Group::graded;
    std::uint64_t first_index = 0;  // within the group
    std::size_t first_row = 0;      // within the results
    std::size_t gearboxes = 0;
    std::size_t records = 1;

    std::size_t rows() const { return gearboxes * records; }
};

// Part of an ensemble that is computed by a separate run: every count-th batch. All parts have
// about the same number of gearboxes of either group.
struct Part {
    std::size_t index = 0;  // less than count
    std::size_t count = 1;

    bool whole() const { return count == 1; }
    std::string text() const;  // "2/4" for index 1 of 4; "" for the whole ensemble
    bool operator==(const Part&) const = default;
};
// Parses "2/4"; "" is the whole ensemble. Empty if the text is invalid.
std::optional<Part> read_part(const std::string& text);

// All batches of an ensemble: first those of the threshold group, then those of the test group. A
// larger test group begins with the batches of a smaller one, except for the last, which may be
// incomplete. For a part of an ensemble, its own batches and rows are numbered from 0 in the same
// order.
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
    // Records per gearbox of the threshold group.
    std::size_t threshold_records() const { return records_; }
    // Name of a row: "gearboxes", or "records" if some gearboxes have several.
    const char* counted() const { return records_ > 1 ? "records" : "gearboxes"; }
    // Test gearboxes of the whole ensemble.
    std::size_t graded_instances() const { return graded_; }
    std::size_t batches() const { return own_of(all_threshold_batches() + batches_of(graded_)); }
    std::size_t threshold_batches() const { return own_of(all_threshold_batches()); }
    Batch batch(std::size_t index) const;
    // Number of a batch in the whole ensemble.
    std::size_t number(std::size_t index) const { return part_.index + index * part_.count; }
    std::size_t batch_of_row(std::size_t row) const;
    // Number of rows in the first `batches` batches.
    std::size_t rows_before(std::size_t batches) const;

  private:
    static std::size_t batches_of(std::size_t rows) { return (rows + kBatchRows - 1) / kBatchRows; }
    std::size_t all_threshold_batches() const { return batches_of(thresholds_); }
    // Number of this part's batches among the first `first` batches of the ensemble.
    std::size_t own_of(std::size_t first) const {
        return (first + part_.count - 1 - part_.index) / part_.count;
    }

    std::size_t gearboxes_before(std::size_t batches) const;

    // gearboxes in each group, and records per threshold gearbox
    std::size_t thresholds_, graded_, records_;
    Part part_;
};

// Storage of finished batches by their number.
class RowStore {
  public:
    virtual ~RowStore() = default;
    virtual bool has(std::size_t batch) const = 0;
    virtual BatchRows read(std::size_t batch) const = 0;
    virtual void write(std::size_t batch, const BatchRows& rows) = 0;
    // Makes everything written so far permanent.
    virtual void sync() {}
};

// Batches in memory.
class MemoryRows final : public RowStore {
  public:
    explicit MemoryRows(std::size_t batches) : batches_(batches) {}
    bool has(std::size_t batch) const override { return batches_[batch].count() > 0; }
    BatchRows read(std::size_t batch) const override { return batches_[batch]; }
    void write(std::size_t batch, const BatchRows& rows) override { batches_[batch] = rows; }

  private:
    std::vector<BatchRows> batches_;
};

// Sequential access to the rows of an ensemble, wherever they are stored.

// Rows first, first + 1, ...; columns as in RowShape.
struct RowBlock {
    std::size_t first = 0;
    std::vector<int> group;   // Group of each row
    std::vector<int> status;  // Status of each row
    std::vector<double> values;

    std::size_t count() const { return status.size(); }
    // Number of values in a row.
    std::size_t row_values() const { return count() == 0 ? 0 : values.size() / count(); }
    // Copies a column's values, `width` for each row, to the positions from `first_value` on in the
    // rows.
    void put(const double* column, std::size_t first_value, std::size_t width);
};

class RowSource {
  public:
    virtual ~RowSource() = default;
    virtual std::size_t rows() const = 0;
    // Calls `use` with all rows in order, in blocks.
    virtual void visit(const std::function<void(const RowBlock&)>& use) const = 0;
};

// One row.
struct ResultRow {
    std::size_t index;
    int group, status;     // Group and Status
    const double* values;  // as in RowShape
};

// Calls `use` with all rows in order.
template <class Use>
void for_each_row(const RowSource& rows, const Use& use) {
    rows.visit([&](const RowBlock& block) {
        const std::size_t row_values = block.row_values();
        for (std::size_t row = 0; row < block.count(); ++row) {
            use(ResultRow{block.first + row, block.group[row], block.status[row],
                          block.values.data() + row * row_values});
        }
    });
}

// First batches of a plan, in a store that has them.
class StoredRows final : public RowSource {
  public:
    StoredRows(const RowStore& store, const BatchPlan& plan, std::size_t batches)
        : store_(store), plan_(plan), batches_(batches) {}
    std::size_t rows() const override { return plan_.rows_before(batches_); }
    void visit(const std::function<void(const RowBlock&)>& use) const override;

  private:
    const RowStore& store_;
    const BatchPlan plan_;
    std::size_t batches_;
};

// Columns of results in memory.
class ColumnRows final : public RowSource {
  public:
    explicit ColumnRows(const Results& results) : results_(results) {}
    std::size_t rows() const override { return results_.status.size(); }
    void visit(const std::function<void(const RowBlock&)>& use) const override;

  private:
    const Results& results_;
};

RowShape row_shape(const Results& results);

// Gearbox number of each given row. In an ensemble, a gearbox has threshold_records consecutive
// rows. Recordings belong to the gearbox that they name; without a name, each has a gearbox of its
// own.
std::vector<std::size_t> gearboxes_of(const Results& frame, const std::vector<std::size_t>& rows);

// True if tilted noise affects a feature, so that the importance weights apply to it. For other
// features all records are plain.
bool uses_noise_weights(const std::string& feature);

// Appends the rows to the columns of a frame (results_frame()).
void fill_columns(Results& results, const RowSource& rows);

// Detection results of every feature of a frame. Holds the values of one feature at a time, or of
// as many features as fit into 64 MB.
std::vector<analysis::FeatureDetection> detect_all(const Results& frame, const RowSource& rows);

// Reads the rows of a results file in blocks.

class FileRows final : public RowSource {
  public:
    // `frame` must come from read_frame(path). Throws std::runtime_error as read_results() does.
    FileRows(const std::string& path, const Results& frame);
    std::size_t rows() const override { return rows_; }
    void visit(const std::function<void(const RowBlock&)>& use) const override;

  private:
    std::string path_;
    const Results& frame_;
    std::size_t rows_ = 0;
};

}  // namespace gearpod::mc
