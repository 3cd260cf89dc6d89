// Mean properties of a few healthy records of the study; trending features compare with them.
#pragma once

#include <cstddef>
#include <vector>

#include "features/feature.hpp"
#include "mc/gearbox/gearbox_tile.hpp"

namespace gearpod::mc {

// Means over the records at every noise level.
struct HealthyReference {
    static constexpr int kRecords = 8;

    std::vector<double> residual_variance, envelope_variance;  // [level], (m/s^2)^2
    std::vector<std::vector<double>> amplitude;                // [level][order], m/s^2

    features::HealthyRecords at(std::size_t level) const {
        return {residual_variance[level], envelope_variance[level], amplitude[level]};
    }
};

// Accumulates healthy records and returns their mean.
class HealthyRecordsMean {
  public:
    explicit HealthyRecordsMean(std::size_t levels);
    // `input` must hold the parts of the averaged sensor signal.
    void add(std::size_t level, const features::FeatureInput& input);
    // NaN if no record was added.
    HealthyReference mean() const;

  private:
    HealthyReference sum_;
    std::vector<int> records_;
};

// Mean over the first eight gearboxes of the threshold sample, with their own noise. Gearboxes that
// failed are left out.
HealthyReference simulated_reference(const Scene& scene, const SensorPaths& path);
// The same mean, of the first sensor or of an additional one (GearboxId::sensor); empty unless a
// feature of the study needs it.
HealthyReference healthy_reference(const Scene& scene, const SensorPaths& path,
                                   std::uint64_t sensor = 0);

}  // namespace gearpod::mc
