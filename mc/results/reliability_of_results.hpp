// Assesses the features of an ensemble as detectors.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analysis/reliability.hpp"
#include "analysis/report/wording.hpp"
#include "machine/fields.hpp"
#include "mc/results/result_rows.hpp"

namespace gearpod::mc {

// Largest number of values (gearboxes x features x noise levels) for POD curves, areas and ranking,
// which need all values at once, 22 to 40 bytes for each. Larger ensembles have detection rates
// only.
inline constexpr std::size_t kMostAssessedValues = 50'000'000;

struct ResultColumns {
    std::vector<std::vector<double>> parameters;
    std::vector<std::vector<double>> features;  // rows x noise levels
    std::size_t rows = 0;

    ResultColumns() = default;
    explicit ResultColumns(const RowShape& shape)
        : parameters(shape.parameters), features(shape.features) {}
    void add(const double* values, const RowShape& shape);
};
GEARPOD_FIELDS(ResultColumns, parameters, features, rows)

// Columns that curves, areas and ranking need.
struct AssessedColumns {
    ResultColumns healthy, test;  // one record per gearbox
    ResultColumns repeats;        // all records of the threshold sample, if there are several
    std::vector<std::size_t> healthy_gearbox;
    std::vector<std::size_t> record_gearbox;  // of `repeats`, or of `healthy` if that is empty
};
GEARPOD_FIELDS(AssessedColumns, healthy, test, repeats, healthy_gearbox, record_gearbox)

// Empty if there are more than `most_values` values.
std::optional<AssessedColumns> assessed_columns(const Results& frame, const RowSource& rows,
                                                std::size_t most_values = kMostAssessedValues);

// Columns with their names and units. Refers to both arguments. `condition` as in
// reliability_of(), which checks the condition.
class AssessedData {
  public:
    AssessedData(const Results& frame, const AssessedColumns& columns,
                 const std::string& condition);
    AssessedData(const AssessedData&) = delete;
    AssessedData& operator=(const AssessedData&) = delete;
    const analysis::ReliabilityData& operator*() const { return data_; }

  private:
    std::vector<double> no_fault_;  // sizes in a study without faults
    analysis::ReliabilityData data_;
};

// Assesses all features. `frame.detection` must be up to date (detect_all). `condition`: name of a
// parameter with separate thresholds for its values, "" for none. Throws std::runtime_error with
// the names of the parameters if it is unknown. Empty if there are more than `most_values` values.
std::optional<analysis::Reliability> reliability_of(const Results& frame, const RowSource& rows,
                                                    const std::string& condition, int threads,
                                                    std::size_t most_values = kMostAssessedValues);

// Kind of object that a row of the results file describes.
analysis::Subject subject_of(const Results& frame);

// Index of the noise level that a report shows first: 1 if the study has it, else the first above
// 0, else the first.
std::size_t reference_level(const std::vector<double>& noise_levels);

}  // namespace gearpod::mc
