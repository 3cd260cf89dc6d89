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

// Torques or speeds at which a gearbox is integrated, as factors on its own value, and the
// interpolation of signals between them.

// Smallest and largest number of nodes of a polynomial.
inline constexpr int kLeastNodes = 3, kMostNodes = 17;

// The first nodes of a symmetric Leja sequence on [-1, 1]: 0, 1, -1, and then pairs, each where the
// product of the distances to all earlier nodes is largest (F. Leja, Ann. Polon. Math. 4 (1957),
// 8-13). Polynomials through them converge like those through Chebyshev points, but a longer
// sequence contains all nodes of a shorter one.
std::vector<double> leja_nodes(int count);

class LoadAxis {
  public:
    // Without `nodes`: `evenly_spaced` quantiles from -1.5 to 1.5 standard deviations, with linear
    // interpolation and extrapolation. With `nodes`: one polynomial through so many factors from
    // -2.5 to 2.5 standard deviations (or the distribution's limits), continued linearly. A
    // quantity that does not vary has the factor 1, and one with distinct factors has all of these.
    LoadAxis(const RecordDistribution& distribution, int evenly_spaced, std::optional<int> nodes);

    const std::vector<double>& factors() const { return factors_; }  // ascending
    // Weight of the signal at each of them in that at another factor; the sum is 1.
    std::vector<double> weights(double factor) const;
    // One factor between each two neighbours; one of the factors if no others occur.
    const std::vector<double>& between() const { return between_; }
    // Factors where the error is largest, for choosing the number of nodes: between the neighbours
    // and beyond them, or the next two nodes.
    const std::vector<double>& checks() const { return checks_; }
    // False if the quantity does not vary or has distinct factors.
    bool interpolates() const { return !checks_.empty(); }

  private:
    std::vector<double> derivative_weights(std::size_t node) const;

    std::vector<double> factors_, between_, checks_;
    std::vector<double> barycentric_;  // weights of the polynomial; empty: piecewise linear
};

}  // namespace gearpod::mc
