// Confidence intervals of a proportion.
#pragma once

#include <vector>

#include "machine/no_value.hpp"

namespace gearpod::analysis {

struct Interval {
    double lower = 0.0;
    double upper = 1.0;
};

// Interval of a proportion: E. B. Wilson, J. Am. Stat. Assoc. 22 (1927), 209-212. Its coverage
// stays close to nominal for small samples and for rates near 0 and 1, which are usual for
// detection rates.

// Two-sided interval without continuity correction. `confidence` in (0, 1), e.g. 0.95. NaN bounds
// if `tested` is 0; throws std::invalid_argument unless 0 <= detected <= tested.
Interval wilson_interval(long detected, long tested, double confidence);

// Exact interval of a proportion: C. J. Clopper, E. S. Pearson, Biometrika 26 (1934), 404-413. Its
// coverage is never below the confidence, so it is wider than Wilson's.

// Two-sided interval: each tail at most (1 - confidence) / 2. `confidence` in (0, 1). NaN bounds if
// `tested` is 0; throws std::invalid_argument unless 0 <= detected <= tested.
Interval clopper_pearson_interval(long detected, long tested, double confidence);

// Interval of the difference of two estimates from their own intervals and their correlation:
// "square and add", R. G. Newcombe, Stat. Med. 17 (1998), 873-890 (rates of two samples, method 10)
// and 2635-2650 (rates of the same gearboxes, method 10); for other estimates G. Y. Zou, A. Donner,
// Stat. Med. 27 (2008), 1693-1702.

// Interval of b - a.
Interval difference_interval(double a, const Interval& of_a, double b, const Interval& of_b,
                             double correlation);

// Outcomes of the same gearboxes tested twice.
struct PairedCounts {
    long both = 0, only_a = 0, only_b = 0, neither = 0;

    long pairs() const { return both + only_a + only_b + neither; }
    // Counts a gearbox by its outcomes, 1 (found) or 0.
    void add(int a, int b) { ++(a == 1 ? b == 1 ? both : only_a : b == 1 ? only_b : neither); }
};

// Correlation of the two outcomes with Newcombe's continuity correction; 0 where a margin is empty.
double outcome_correlation(const PairedCounts& counts);

// Exact McNemar p-value for equal detection rates, two-sided: Q. McNemar, Psychometrika 12 (1947),
// 153-157, with the binomial distribution of the discordant pairs.
double mcnemar_p_value(const PairedCounts& counts);

// P-value for equal rates of two independent samples by the pooled normal test; 1 if all outcomes
// are equal.
double pooled_p_value(long found_a, long tested_a, long found_b, long tested_b);

// Adjustment of the p-values of several tests that keeps the probability of any false rejection at
// the level: S. Holm, Scand. J. Stat. 6 (1979), 65-70.

// Adjusted p-values in the given order. NaN entries count as no test and stay NaN.
std::vector<double> holm_adjusted(const std::vector<double>& p_values);

}  // namespace gearpod::analysis
