// The law of what is measured where there is nothing to find: normal, lognormal, exponential or
// Weibull by maximum likelihood, the one of least AIC (MIL-HDBK-1823A, appendix G.2.6).
#pragma once

#include <span>
#include <string>
#include <vector>

namespace gearpod::analysis {

struct NoiseLaw {
    enum class Kind { normal, lognormal, exponential, weibull };
    Kind kind = Kind::normal;
    // Mean and standard deviation (of the logarithm for lognormal); scale and shape for Weibull,
    // the scale alone for exponential.
    double first = 0.0, second = 1.0;
    double aic = 0.0;

    double above(double value) const;  // probability of more
    double below(double value) const;
    double exceeded_by(double share) const;  // the value with that probability of more
};

const char* law_name(NoiseLaw::Kind kind);

// By ascending AIC; those for positive values alone only if all are positive. Empty unless there
// are three values that differ.
std::vector<NoiseLaw> noise_laws(std::span<const double> values);

}  // namespace gearpod::analysis
