// Hits and misses by fault size, the data of a hit/miss analysis. Every distinct size has its own
// row; there is no binning, only gearboxes of exactly equal size are counted together.
#pragma once

#include <span>
#include <vector>

namespace gearpod::analysis {

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

}  // namespace gearpod::analysis
