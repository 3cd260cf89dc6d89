// One detection rate as it becomes known: shown while the ensemble runs, and the reason to stop
// once its interval is as narrow as wanted.
#pragma once

#include <optional>
#include <string>

#include "analysis/detection/detection.hpp"
#include "mc/results/batch_rows.hpp"
#include "mc/study/study.hpp"

namespace gearpod::mc {

// Looks at batches in their order only, each once all before it are there: what it says, and the
// batch at which it says stop, are the same whoever computed them and whenever.
class PdWatch {
  public:
    // Of ensemble.until, else of `feature` ("": the first in use) at the largest size and the
    // noise level next to 1.
    PdWatch(const Study& study, const BatchPlan& plan, const std::string& feature);

    void advance(const RowStore& store);

    // Whether ensemble.until is reached, and after how many batches.
    bool enough() const { return stop_.has_value(); }
    std::size_t batches() const { return *stop_; }
    // "Pd(window_ratio, 3 mm, noise x 1) = 0.93 [0.91, 0.95]"; "" while nothing is known.
    std::string text() const;
    // Graded gearboxes still needed for ensemble.until, as far as the rate tells.
    std::optional<std::size_t> rows_left() const;

  private:
    void set_threshold(const RowStore& store);
    void count(const BatchRows& rows);
    double half_width(double tested) const;

    analysis::DetectionRequest request_;
    std::string feature_name_, size_name_;
    analysis::Alarm alarm_ = analysis::Alarm::high;
    std::size_t group_ = 0;
    std::size_t level_ = 0;
    std::optional<double> wanted_;  // half width
    BatchPlan plan_;
    RowShape shape_;
    std::size_t column_ = 0;  // of the feature at the level, in a row
    std::size_t next_ = 0;    // batch to look at
    double threshold_ = 0.0;
    long tested_ = 0, detected_ = 0;
    std::size_t graded_ = 0;  // gearboxes looked at
    std::optional<std::size_t> stop_;
};

}  // namespace gearpod::mc
