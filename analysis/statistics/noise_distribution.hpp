// Distribution of the response where there is no flaw: normal, lognormal, exponential or Weibull by
// maximum likelihood, the one of least AIC first (MIL-HDBK-1823A, appendix G.2.6).
#pragma once

#include <span>
#include <vector>

namespace gearpod::analysis {

struct NoiseDistribution {
    enum class Kind { normal, lognormal, exponential, weibull };
    Kind kind = Kind::normal;
    // Mean and standard deviation (for lognormal, of the logarithm). For Weibull, scale and shape;
    // for exponential, the scale alone.
    double first = 0.0, second = 1.0;
    double aic = 0.0;

    double above(double value) const;  // P(response > value)
    double below(double value) const;
    double exceeded_by(double share) const;  // value that is exceeded with probability `share`
};

const char* noise_distribution_name(NoiseDistribution::Kind kind);

// All fits by ascending AIC. Distributions for positive values are included only if all values are
// positive. Empty with fewer than three values or if all are equal.
std::vector<NoiseDistribution> fit_noise_distributions(std::span<const double> values);

}  // namespace gearpod::analysis
