// Rows of an ensemble: their storage in batches, sequential access wherever they are stored, and
// the results that are computed from them.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "machine/fields.hpp"
#include "mc/plan/ensemble_plan.hpp"
#include "mc/results/results_file.hpp"

namespace gearpod::mc {

// Rows of up to kBatchRows gearboxes.
struct BatchRows {
    std::vector<int> status;     // Status of each row
    std::vector<double> values;  // rows x RowShape::values()

    std::size_t count() const { return status.size(); }
};
GEARPOD_FIELDS(BatchRows, status, values)

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

class ColumnRows final : public RowSource {
  public:
    explicit ColumnRows(const Results& results) : results_(results) {}
    std::size_t rows() const override { return results_.status.size(); }
    void visit(const std::function<void(const RowBlock&)>& use) const override;

  private:
    const Results& results_;
};

RowShape row_shape(const Results& results);

// Results without rows: names, units, noise levels and sizes.
Results results_frame(const EnsemblePlan& plan);

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
