// Probability of detection as a function of fault size:
//
//   POD(a) = floor + (ceiling - floor) F(intercept + slope x),   x = a or ln a.
//
// MIL-HDBK-1823A, appendix G.3.3, has floor 0 and ceiling 1. A detector with a false-alarm rate
// does not fall below it for small faults. A detector that fails on some gearboxes does not reach
// 1. For asymptotes in POD see Annis, Gandossi and Martin, Nucl. Eng. Des. 262 (2013), 98-105.
#pragma once

#include <optional>
#include <string>

#include "analysis/statistics/link.hpp"

namespace gearpod::analysis {

struct PodForm {
    Link link = Link::logit;
    bool log_size = false;
    double floor = 0.0;         // fixed at the rate of the healthy gearboxes
    bool free_ceiling = false;  // false: the ceiling is 1
    bool firth = false;         // Jeffreys' penalty on the likelihood; not with a free ceiling

    int parameters() const { return free_ceiling ? 3 : 2; }
    double scaled(double size) const;  // x of a size
    double size(double scaled) const;
};

// Text such as "logit of log size, floor 0.05, ceiling fitted" or "logit of size, Firth's penalty".
std::string form_text(const PodForm& form);

struct PodCurve {
    PodForm form;
    double intercept = 0.0;
    double slope = 0.0;  // per unit of x
    double ceiling = 1.0;

    double pod(double size) const;
    // Empty unless floor < pod < ceiling and the curve rises.
    std::optional<double> size_at(double pod) const;
};

}  // namespace gearpod::analysis
