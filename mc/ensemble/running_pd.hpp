// Running estimate of one detection rate. It is shown during a run, and ends the run when its
// confidence interval is narrow enough.
#pragma once

#include <optional>
#include <string>

#include "analysis/detection/detection.hpp"
#include "mc/results/result_rows.hpp"

namespace gearpod::mc {

// Reads batches strictly in order. The estimate and the batch at which the run stops therefore do
// not depend on threads and ranks.
class RunningPd {
  public:
    // Watches the feature of ensemble.until. Without it, watches `feature` ("": the first feature
    // of the study) at the largest size and the noise level closest to 1.
    RunningPd(const EnsemblePlan& plan, const BatchPlan& batches, const std::string& feature);

    void advance(const RowStore& store);

    // True if ensemble.until is reached; batches() is the number of batches it took.
    bool done() const { return stop_.has_value(); }
    std::size_t batches() const { return *stop_; }
    // For example "Pd(window_ratio, 3 mm, noise x 1) = 0.93 [0.91, 0.95]"; "" before the first
    // tested gearbox.
    std::string text() const;
    // Estimated number of further test gearboxes that ensemble.until needs; empty if unknown.
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
    std::optional<double> requested_half_width_;
    BatchPlan batches_;
    RowShape shape_;
    std::size_t column_ = 0;  // of the feature at this level in a row
    std::size_t next_ = 0;    // next batch to read
    double threshold_ = 0.0;
    long tested_ = 0, detected_ = 0;
    std::size_t test_ = 0;  // number of gearboxes read
    std::optional<std::size_t> stop_;
};

}  // namespace gearpod::mc
