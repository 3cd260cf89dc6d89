// Sets of records of healthy gearboxes, measured or simulated alike, and what they say in a few
// numbers.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "features/feature.hpp"

namespace gearpod::mc {

// How long each record of each gearbox is, in mesh periods: [gearbox][record].
using RecordLengths = std::vector<std::vector<int>>;

// [gearbox][record][feature], the features of a set.
using RecordValues = std::vector<std::vector<std::vector<double>>>;

// Of each feature its mean over the set, gearboxes counting alike; over three gearboxes or more the
// spread of their means, and over three records or more in one, that of its records. Of the
// logarithm, where all that was measured is positive.
class SetSummary {
  public:
    SetSummary(std::vector<const features::Feature*> features, const RecordValues& measured);

    const std::vector<const features::Feature*>& features() const { return features_; }
    // "sensor_rms", "sensor_rms between gearboxes", "sensor_rms between records"
    const std::vector<std::string>& names() const { return names_; }
    // In the order of the names; empty if a value is not finite, or not positive where it must be.
    std::vector<double> of(const RecordValues& values) const;
    // A mean in the feature's own unit, where names()[i] is one.
    bool is_mean(std::size_t i) const { return i < features_.size(); }
    double in_unit(std::size_t i, double mean) const;

  private:
    std::vector<const features::Feature*> features_;
    std::vector<char> logarithmic_;
    bool between_gearboxes_, between_records_;
    std::vector<std::string> names_;
};

}  // namespace gearpod::mc
