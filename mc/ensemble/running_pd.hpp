// Running estimate of one detection rate, which is shown during a run.
#pragma once

#include <string>

#include "analysis/detection/detection.hpp"
#include "mc/results/result_rows.hpp"

namespace gearpod::mc {

// Reads batches strictly in order.
class RunningPd {
  public:
    // Watches `feature` ("": the first feature of the study) at the largest size and the noise
    // level closest to 1.
    RunningPd(const EnsemblePlan& plan, const BatchPlan& batches, const std::string& feature);

    void advance(const RowStore& store);

    // For example "Pd(window_ratio, 3 mm, noise x 1) = 0.93 [0.91, 0.95]"; "" before the first
    // tested gearbox.
    std::string text() const;

  private:
    void set_threshold(const RowStore& store);
    void count(const BatchRows& rows);

    analysis::DetectionRequest request_;
    std::string feature_name_, size_name_;
    analysis::Alarm alarm_ = analysis::Alarm::high;
    std::size_t group_ = 0;
    std::size_t level_ = 0;
    BatchPlan batches_;
    RowShape shape_;
    std::size_t column_ = 0;  // of the feature at this level in a row
    std::size_t next_ = 0;    // next batch to read
    double threshold_ = 0.0;
    long tested_ = 0, detected_ = 0;
};

}  // namespace gearpod::mc
