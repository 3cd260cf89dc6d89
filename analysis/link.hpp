// Links of a probability of detection: POD = F(eta). Both laws are symmetric, 1 - F(eta) = F(-eta).
// MIL-HDBK-1823A, appendix G.3.3.
#pragma once

namespace gearpod::analysis {

enum class Link { logit, probit };

double link_probability(Link link, double eta);  // F
double link_density(Link link, double eta);      // F'
double link_quantile(Link link, double probability);

const char* link_name(Link link);

}  // namespace gearpod::analysis
