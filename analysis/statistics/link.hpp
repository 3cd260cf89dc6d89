// Link functions of a probability of detection: POD = F(eta). Logit and probit are symmetric, 1 -
// F(eta) = F(-eta). Cloglog (complementary log-log) is 1 - exp(-exp(eta)), loglog is
// exp(-exp(-eta)); each is the mirror image of the other. MIL-HDBK-1823A, appendix G.3.3.
#pragma once

namespace gearpod::analysis {

enum class Link { logit, probit, cloglog, loglog };
inline constexpr Link kLinks[] = {Link::logit, Link::probit, Link::cloglog, Link::loglog};

double link_probability(Link link, double eta);  // F
double link_density(Link link, double eta);      // F'
// F, 1 - F and F' at one eta. The smaller of F and 1 - F is computed without cancellation.
struct LinkValues {
    double up = 0.0;       // F
    double down = 0.0;     // 1 - F
    double density = 0.0;  // F'
};
LinkValues link_values(Link link, double eta);

double link_quantile(Link link, double probability);
// The eta at which 1 - F equals `probability`.
double link_upper_quantile(Link link, double probability);

const char* link_name(Link link);

}  // namespace gearpod::analysis
