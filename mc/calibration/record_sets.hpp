// Sets of records of healthy gearboxes, measured or simulated, and their summary statistics.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "features/feature.hpp"

namespace gearpod::mc {

// Length of each record in mesh periods: [gearbox][record].
using RecordLengths = std::vector<std::vector<int>>;

// [gearbox][record][feature], in the order of the set's features.
using RecordValues = std::vector<std::vector<std::vector<double>>>;

// Summary statistics of a set, for each feature: the mean over the gearboxes; the standard
// deviation between gearboxes if there are at least three; and the standard deviation between
// records if a gearbox has at least three. Taken of the logarithm if all measured values are
// positive.
class SetSummary {
  public:
    SetSummary(std::vector<const features::Feature*> features, const RecordValues& measured);

    const std::vector<const features::Feature*>& features() const { return features_; }
    // Names such as "sensor_rms", "sensor_rms between gearboxes", "sensor_rms between records".
    const std::vector<std::string>& names() const { return names_; }
    // Statistics in the order of the names. Empty if a value is not finite, or not positive
    // although its logarithm is needed.
    std::vector<double> of(const RecordValues& values) const;
    // True if names()[i] is a mean; in_unit() converts such a mean to the unit of the feature.
    bool is_mean(std::size_t i) const { return i < features_.size(); }
    double in_unit(std::size_t i, double mean) const;

  private:
    std::vector<const features::Feature*> features_;
    std::vector<char> logarithmic_;
    bool between_gearboxes_, between_records_;
    std::vector<std::string> names_;
};

}  // namespace gearpod::mc
