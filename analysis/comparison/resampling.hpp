// Scatter of detection over repeated samples of gearboxes: thresholds, rates and a90 of gearboxes
// drawn with replacement, each gearbox with all its values (cluster bootstrap: B. Efron, R. J.
// Tibshirani, An Introduction to the Bootstrap (1993), section 8.5).
#pragma once

#include <cstdint>
#include <random>
#include <span>
#include <vector>

#include "analysis/detection/detection_table.hpp"
#include "analysis/pod/pod_curve.hpp"

namespace gearpod::analysis {

// Number of times every gearbox of a sample is drawn. The same for the same seed and count on every
// platform.
std::vector<int> bootstrap_counts(std::size_t count, std::mt19937_64& engine);

struct ResampledDetection {
    std::vector<double> pd;  // by size group; NaN where none was drawn
    double a90 = 0.0;        // infinite: not reached; NaN: no curve
};

// One feature at one noise level, sorted once for many resamples.
class Resampling {
  public:
    Resampling(Alarm alarm, std::span<const double> healthy, std::span<const double> graded_size,
               std::span<const double> graded, const std::vector<SizeGroup>& groups,
               double false_alarm_rate);

    // Detection of one resample, given the number of times each gearbox is drawn. Fits the
    // POD curve `form`, or no curve if it is null.
    ResampledDetection detect(const std::vector<int>& healthy, const std::vector<int>& graded,
                              const PodForm* form) const;

  private:
    struct TestValue {
        double size, value;
        std::size_t gearbox, group;
    };
    double threshold(const std::vector<int>& counts) const;
    double beyond(const std::vector<int>& counts, long sample) const;

    double sign_;  // factor that makes large values alarm
    double false_alarm_rate_;
    std::size_t groups_;
    std::vector<std::pair<double, std::size_t>> healthy_;  // value and gearbox, ascending
    std::vector<TestValue> graded_;                        // ascending size
};

}  // namespace gearpod::analysis
