// Tails of normal scores that have a share of their variance in common.
#pragma once

namespace gearpod::analysis {

// P(Z > z), and the z that is exceeded with probability p.
double normal_beyond(double z);
double normal_exceeded(double p);

// P(both of two standard normals that are correlated by `share`, 0 to 1, exceed the value that each
// exceeds with probability `rate`).
double both_beyond(double rate, double share);

}  // namespace gearpod::analysis
