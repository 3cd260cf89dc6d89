// Hits and misses over fault size as a likelihood sees them: sizes standardised, and where there
// are many, few nodes in their place.
//
// A log likelihood is a sum of analytic functions of u over two discrete measures, hits and misses.
// In a cell of u each measure is replaced by its Gauss rule, whose nodes and weights integrate
// every polynomial up to degree 2 kNodes - 1 exactly (W. Gautschi, Orthogonal Polynomials:
// Computation and Approximation (2004), sections 1.4 and 2.2); with cells narrow against the
// curve's own width nothing is lost but rounding (test_standardised_sizes.cpp). The rules of wider
// cells come from those of narrower ones, which have the same moments.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "analysis/pod/hit_miss_table.hpp"

namespace gearpod::analysis {

// Of one measure, ascending.
struct WeightedSizes {
    std::vector<double> u;
    std::vector<double> weight;  // gearboxes
};

// Hits, then misses.
struct SizeNodes {
    double cell = 0.0;  // widest cell of u; 0 if these are the sizes themselves
    Eigen::ArrayXd u;
    Eigen::ArrayXd weight;
    Eigen::Index hits = 0;  // nodes
};

class StandardisedSizes {
  public:
    static constexpr int kNodes = 12;  // a cell and measure, at most

    // Mean 0 and standard deviation 1 over the gearboxes; of the sizes or of their logarithms.
    StandardisedSizes(const HitMissTable& table, bool log_size);

    double centre() const { return centre_; }
    double spread() const { return spread_; }
    double u(double scaled) const { return (scaled - centre_) / spread_; }

    // Every size of the table.
    const Eigen::ArrayXd& sizes() const { return sizes_; }
    double hits() const { return hits_; }
    double tests() const { return tests_; }

    // The fewest nodes whose cells are no wider in u.
    const SizeNodes& nodes(double widest_cell) const;

  private:
    double centre_ = 0.0, spread_ = 1.0;
    double hits_ = 0.0, tests_ = 0.0;
    Eigen::ArrayXd sizes_;
    std::vector<SizeNodes> levels_;  // cells from narrow to wide, the first the sizes themselves
};

}  // namespace gearpod::analysis
