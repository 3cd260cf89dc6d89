// Links of a probability of detection: POD = F(eta). Both laws are symmetric, 1 - F(eta) = F(-eta).
// MIL-HDBK-1823A, appendix G.3.3.
#pragma once

namespace gearpod::analysis {

enum class Link { logit, probit };

double link_probability(Link link, double eta);  // F
double link_density(Link link, double eta);      // F'
// All three of an eta at once, the small one of F and 1 - F without cancellation.
struct LinkValues {
    double up = 0.0;       // F
    double down = 0.0;     // 1 - F
    double density = 0.0;  // F'
};
LinkValues link_values(Link link, double eta);

double link_quantile(Link link, double probability);

const char* link_name(Link link);

}  // namespace gearpod::analysis
