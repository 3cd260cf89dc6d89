// Hits and misses by fault size, the data of a hit/miss analysis. Every distinct size is a row of
// its own: nothing is binned, gearboxes of exactly equal size are only counted together.
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

// Sizes of 0 are healthy gearboxes and are left out, as are sizes that are not finite.
HitMissTable hit_miss_table(std::span<const double> sizes, std::span<const char> hit);

// Largest size with a miss and smallest with a hit; NaN if there is none.
double largest_miss(const HitMissTable& table);
double smallest_hit(const HitMissTable& table);

double total_tests(const HitMissTable& table);
double total_hits(const HitMissTable& table);

}  // namespace gearpod::analysis
