// What trending features compare with: the records of a few healthy gearboxes of the study.
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

// Sums records up, then divides.
class HealthyRecordsMean {
  public:
    explicit HealthyRecordsMean(std::size_t levels);
    // `input` holds the averaged sensor signal's parts.
    void add(std::size_t level, const features::FeatureInput& input);
    // NaN without records.
    HealthyReference mean() const;

  private:
    HealthyReference sum_;
    std::vector<int> records_;
};

// Of the first eight gearboxes of the threshold sample, with their own noise: those that worked.
HealthyReference simulated_reference(const Scene& scene, const Sampler& sampler,
                                     const signals::PathGrid& path);
// The same, but empty unless a feature that the study uses needs it.
HealthyReference healthy_reference(const Scene& scene, const Sampler& sampler,
                                   const signals::PathGrid& path);

}  // namespace gearpod::mc
