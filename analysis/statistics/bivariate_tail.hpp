// Tail probabilities of normal scores that share part of their variance.
#pragma once

namespace gearpod::analysis {

// P(Z > z), and the z that is exceeded with probability p.
double normal_upper_tail(double z);
double normal_upper_tail_quantile(double p);

// Probability that both of two standard normals with correlation `share` (0 to 1) exceed the value
// that each exceeds with probability `rate`.
double both_exceed(double rate, double share);

}  // namespace gearpod::analysis
