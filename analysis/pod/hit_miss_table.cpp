#include "analysis/pod/hit_miss_table.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace gearpod::analysis {

HitMissTable hit_miss_table(std::span<const double> sizes, std::span<const char> hit) {
    if (sizes.size() != hit.size()) {
        throw std::invalid_argument("hit/miss table: needs one outcome per size");
    }
    HitMissTable single;
    for (std::size_t i = 0; i < sizes.size(); ++i) {
        if (std::isfinite(sizes[i]) && sizes[i] > 0.0) {
            single.push_back({sizes[i], hit[i] != 0 ? 1.0 : 0.0, 1.0});
        }
    }
    std::sort(single.begin(), single.end(),
              [](const HitMissRow& a, const HitMissRow& b) { return a.size < b.size; });
    HitMissTable table;
    for (const HitMissRow& row : single) {
        if (table.empty() || table.back().size != row.size) {
            table.push_back(row);
        } else {
            table.back().hits += row.hits;
            table.back().tests += 1.0;
        }
    }
    return table;
}

double largest_miss(const HitMissTable& table) {
    for (auto row = table.rbegin(); row != table.rend(); ++row) {
        if (row->hits < row->tests) {
            return row->size;
        }
    }
    return std::numeric_limits<double>::quiet_NaN();
}

double smallest_hit(const HitMissTable& table) {
    for (const HitMissRow& row : table) {
        if (row.hits > 0.0) {
            return row.size;
        }
    }
    return std::numeric_limits<double>::quiet_NaN();
}

double total_tests(const HitMissTable& table) {
    double sum = 0.0;
    for (const HitMissRow& row : table) {
        sum += row.tests;
    }
    return sum;
}

double total_hits(const HitMissTable& table) {
    double sum = 0.0;
    for (const HitMissRow& row : table) {
        sum += row.hits;
    }
    return sum;
}

}  // namespace gearpod::analysis
