// Identity of the rows of results: gearbox, record, row in the whole study, and the split of a
// dataset that the gearbox belongs to.
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "mc/plan/study_facts.hpp"
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

// Input of the Python program that writes a dataset for machine learning, in addition to the
// report: "file", "recorded", "computed_by", "written_by", "inputs" with their meanings, and "rows"
// with [row in the whole study, gearbox, record, split] of each of `rows` rows. All rows of a
// gearbox are in one split, which depends on the seed and the gearbox only, or on the name of a
// recorded gearbox. Throws std::runtime_error naming the file if its study cannot be read.
nlohmann::json dataset_json(const Results& frame, std::size_t rows, const std::string& file);

}  // namespace gearpod::mc
