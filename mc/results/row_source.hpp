// The rows of an ensemble one after another, wherever they are kept.
#pragma once

#include <functional>

#include "mc/results/batch_rows.hpp"
#include "mc/results/results_file.hpp"

namespace gearpod::mc {

// Rows first, first + 1, ...; columns as in RowShape.
struct RowBlock {
    std::size_t first = 0;
    std::vector<int> group;   // Group by row
    std::vector<int> status;  // Status by row
    std::vector<double> values;

    std::size_t count() const { return status.size(); }
};

class RowSource {
  public:
    virtual ~RowSource() = default;
    virtual std::size_t rows() const = 0;
    // Calls `use` with all rows in order, some at a time.
    virtual void visit(const std::function<void(const RowBlock&)>& use) const = 0;
};

// The first batches of a plan, from a store that has them.
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

// The columns of results in memory.
class ColumnRows final : public RowSource {
  public:
    explicit ColumnRows(const Results& results) : results_(results) {}
    std::size_t rows() const override { return results_.status.size(); }
    void visit(const std::function<void(const RowBlock&)>& use) const override;

  private:
    const Results& results_;
};

RowShape row_shape(const Results& results);

// A number for the gearbox of each row: rows are records of each of the ensemble, or recordings, of
// which those without a gearbox's name are each of one of its own.
std::vector<std::size_t> gearboxes_of(const Results& frame, const std::vector<std::size_t>& rows);

// Whether a feature looks at the noise that tilted records tilt, so that their weights are for it:
// for others all records are plain.
bool sees_tilt(const std::string& feature);

// Fills a frame's columns (results_frame()).
void fill_columns(Results& results, const RowSource& rows);

// Detection of every feature of a frame. Holds one feature's values at a time, or as many features'
// as fit in 64 MB.
std::vector<analysis::FeatureDetection> detect_all(const Results& frame, const RowSource& rows);

}  // namespace gearpod::mc
