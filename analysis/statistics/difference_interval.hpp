// Interval of the difference of two estimates from their own intervals and their correlation:
// "square and add", R. G. Newcombe, Stat. Med. 17 (1998), 873-890 (rates of two samples, method 10)
// and 2635-2650 (of the same gearboxes, method 10); for other estimates G. Y. Zou, A. Donner, Stat.
// Med. 27 (2008), 1693-1702.
#pragma once

#include "analysis/statistics/interval.hpp"

namespace gearpod::analysis {

// Of b - a.
Interval difference_interval(double a, const Interval& of_a, double b, const Interval& of_b,
                             double correlation);

// The same gearboxes tried twice.
struct PairedCounts {
    long both = 0, only_a = 0, only_b = 0, neither = 0;

    long pairs() const { return both + only_a + only_b + neither; }
};

// Of the two outcomes, with Newcombe's correction for continuity; 0 where a margin is empty.
double outcome_correlation(const PairedCounts& counts);

// That both find as many: Q. McNemar, Psychometrika 12 (1947), 153-157, by the exact binomial law
// of the pairs that differ; two-sided.
double mcnemar_p_value(const PairedCounts& counts);

// That two independent samples have the same rate: the pooled normal test; 1 where none differs.
double pooled_p_value(long found_a, long tested_a, long found_b, long tested_b);

}  // namespace gearpod::analysis
