// Goodness of fit of a POD curve to the hits and misses.
#pragma once

#include <string>

#include "analysis/pod/hit_miss_table.hpp"
#include "analysis/pod/pod_curve.hpp"

namespace gearpod::analysis {

// Test of the fit. For replicated sizes, the likelihood-ratio statistic against a separate rate for
// every size (McCullagh and Nelder (1989), section 4.4.3), with sizes - parameters degrees of
// freedom. Otherwise D. W. Hosmer, S. Lemeshow, Commun. Stat. A 9 (1980), 1043-1069: ten groups of
// equal count in ascending POD, with groups - parameters degrees of freedom.
struct GoodnessOfFit {
    enum class Test { none, saturated, hosmer_lemeshow };
    Test test = Test::none;  // none: fewer sizes than the test needs
    double statistic = 0.0;  // NaN if none
    int degrees = 0;
    double p_value = 0.0;  // NaN if none
};

GoodnessOfFit goodness_of_fit(const HitMissTable& table, const PodCurve& curve);

// Text such as "likelihood ratio against every size's own rate: p = 0.31".
std::string fit_text(const GoodnessOfFit& fit);

}  // namespace gearpod::analysis
