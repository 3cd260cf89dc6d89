// Identity of the rows of results: gearbox, record, row in the whole study, and the split of a
// dataset that the gearbox belongs to.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "mc/plan/study_facts.hpp"
#include "mc/report/tables.hpp"
#include "mc/results/result_rows.hpp"

namespace gearpod::mc {

inline constexpr std::size_t kSplitCount = 3;
inline constexpr const char* kSplitNames[kSplitCount] = {"train", "validation", "test"};

struct RowIdentity {
    std::string gearbox;     // "threshold-12", "graded-3", or the name of a recorded gearbox
    std::size_t row = 0;     // in the results of the whole study
    std::size_t record = 0;  // number among the records of the gearbox in these results
    std::size_t split = 0;   // index in kSplitNames
};

// Identifies rows of an ensemble or of recordings. The split of a simulated gearbox follows from
// seed, group and number, that of a recorded gearbox from its name. 70 % of the gearboxes are
// expected in the first split and 15 % in each of the others.
class RowIdentities {
  public:
    // `facts`: of an ensemble; empty for recordings.
    RowIdentities(const Results& frame, const std::optional<RunFacts>& facts);
    // Identity of a row of these results, which may be a part of the study's.
    RowIdentity of(std::size_t row) const;

  private:
    RowIdentity of_simulated(std::size_t row) const;
    RowIdentity of_recorded(std::size_t row) const;

    std::uint64_t seed_ = 0;
    std::optional<RowOrder> order_;      // empty: recordings
    std::optional<BatchPlan> plan_;      // empty: recordings
    std::vector<std::string> recorded_;  // name of the gearbox of each row; may be empty
};

// Dataset of results for machine learning: features with labels, severity, identity of the gearbox
// and splits by gearbox (CSV), stored signals (CSV) and a data card (Markdown).

// All files: README.md, columns.csv, train.csv, validation.csv, test.csv, study.toml, and
// signals_ROW.csv for each row whose signals are stored. `file`: results file of `rows`. All rows
// of a gearbox are in one split. The split depends on the seed and the gearbox only, or on the name
// of a recorded gearbox. Failed rows are left out. Throws std::runtime_error naming the file if
// its study or its signals cannot be read.
std::vector<NamedFile> dataset_files(const Results& frame, const RowSource& rows,
                                     const std::string& file);

}  // namespace gearpod::mc
