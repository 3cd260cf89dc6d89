// Hits and misses by fault size, the data of a hit/miss analysis, and their standardised sizes.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

namespace gearpod::analysis {

// Hits and misses by fault size, the data of a hit/miss analysis. Every distinct size has its own
// row; there is no binning, only gearboxes of exactly equal size are counted together.
struct HitMissRow {
    double size = 0.0;  // > 0
    double hits = 0.0;
    double tests = 0.0;
};

using HitMissTable = std::vector<HitMissRow>;  // ascending size

// Builds the table. Sizes of 0 (healthy gearboxes) and sizes that are not finite are left out.
HitMissTable hit_miss_table(std::span<const double> sizes, std::span<const char> hit);

// Largest size with a miss and smallest with a hit; NaN if there is none.
double largest_miss(const HitMissTable& table);
double smallest_hit(const HitMissTable& table);

double total_tests(const HitMissTable& table);
double total_hits(const HitMissTable& table);

// Hits and misses over standardised fault size, condensed to few quadrature nodes where there are
// many.
//
// A log likelihood is a sum of analytic functions of u over two discrete measures, hits and misses.
// In each cell of u a measure is replaced by its Gauss rule, whose nodes and weights integrate
// every polynomial up to degree 2 kNodes - 1 exactly (W. Gautschi, Orthogonal Polynomials:
// Computation and Approximation (2004), sections 1.4 and 2.2). With cells narrow compared with the
// curve's width, the error is at rounding level (test_standardised_sizes.cpp).

// Nodes of the hits, then of the misses.
struct SizeNodes {
    double cell = 0.0;  // widest cell of u; 0 if these are the sizes themselves
    Eigen::ArrayXd u;
    Eigen::ArrayXd weight;
    Eigen::Index hits = 0;  // number of nodes
};

class StandardisedSizes {
  public:
    static constexpr int kNodes = 12;  // per cell and measure, at most

    // Standardises the sizes, or their logarithms, to mean 0 and standard deviation 1 over the
    // gearboxes.
    StandardisedSizes(const HitMissTable& table, bool log_size);

    double centre() const { return centre_; }
    double spread() const { return spread_; }
    double u(double scaled) const { return (scaled - centre_) / spread_; }

    // Every size of the table.
    const Eigen::ArrayXd& sizes() const { return sizes_; }
    double hits() const { return hits_; }
    double tests() const { return tests_; }

    // The smallest set of nodes whose cells are no wider than `widest_cell`. Computes each set when
    // it is first needed, so an object belongs to one thread.
    const SizeNodes& nodes(double widest_cell) const;

  private:
    double centre_ = 0.0, spread_ = 1.0;
    double hits_ = 0.0, tests_ = 0.0;
    Eigen::ArrayXd sizes_;
    SizeNodes all_;                            // the sizes themselves
    mutable std::vector<SizeNodes> by_cells_;  // with 1, 2, 4, ... cells; empty if not yet needed
};

}  // namespace gearpod::analysis
