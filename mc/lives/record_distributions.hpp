// Distributions of the torque, speed, gain and noise of records, as factors on the values of the
// gearbox. They are given by the scatter keys of [life] (lognormal distributions) or in [random]
// with per = "record". In both cases, a record has one standard normal number per quantity, which
// the distribution converts to a factor.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "mc/study/study.hpp"

namespace gearpod::mc {

class RecordDistribution {
  public:
    // `scatter`: rms of the factor's logarithm, used if [random] has no distribution of the
    // quantity. `distinct`: number of equally frequent factors, each that of the mean normal number
    // of its part; the spread of these numbers is restored to 1.
    RecordDistribution(const Study& study, RecordQuantity quantity, double scatter,
                       std::optional<int> distinct = {});

    bool varies() const { return input_.has_value() || scatter_ > 0.0; }
    // True if the distribution is given in [random].
    bool given() const { return input_.has_value(); }
    // Factor for a standard normal number; monotonically increasing.
    double factor(double unit) const;
    // Root mean square of the factor (numerically, or an upper approximation for lognormal
    // factors).
    double rms() const;
    // Ascending factors at which a gearbox is integrated, between which records are interpolated.
    // They belong to `count` (two or more) evenly spaced normal numbers from -1.5 to 1.5; {1} if
    // the quantity is constant.
    std::vector<double> integrated_factors(int count) const;
    // All factors that occur, ascending; empty if they are not limited to a number.
    std::vector<double> distinct_factors() const;
    // Factors halfway (in the normal number) between neighbouring ones of these.
    std::vector<double> factors_between(int count) const;
    // For example "scatters by 2 % (rms) about the gearbox's" or "lognormal, ...".
    std::string text() const;

  private:
    double factor_of(double unit) const;

    double scatter_;
    std::vector<double> distinct_;  // normal numbers
    std::optional<RandomInput> input_;
    double nominal_ = 1.0;  // in the unit of the distribution
};

struct RecordDistributions {
    explicit RecordDistributions(const Study& study);

    RecordDistribution torque, speed, gain, noise;
    bool sensor_noise_only;  // false if it applies to the encoders as well
};

// Weights of linear interpolation between the ascending integrated factors; the outer two also
// extrapolate.
std::vector<double> interpolation_weights(const std::vector<double>& integrated, double factor);

// Study of the gearboxes: inputs that vary by record keep their nominal values.
Study study_of_gearboxes(const Study& study);

}  // namespace gearpod::mc
