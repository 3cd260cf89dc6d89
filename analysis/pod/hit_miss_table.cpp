#include "analysis/pod/hit_miss_table.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "analysis/statistics/gauss_rule.hpp"
#include "machine/no_value.hpp"

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
    return kNan;
}

double smallest_hit(const HitMissTable& table) {
    for (const HitMissRow& row : table) {
        if (row.hits > 0.0) {
            return row.size;
        }
    }
    return kNan;
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

namespace {

constexpr int kSizeNodes = StandardisedSizes::kNodes;
constexpr int kMoments = 2 * kSizeNodes;  // that determine a Gauss rule
constexpr double kSamePoints = 1e-12;     // squared norm at which a measure has no further points

// Chebyshev nodes of the first kind on -1 to 1, and the matrix that turns a measure's sums of the
// Chebyshev polynomials T_0, T_1, ... into weights of these nodes, with the same moments.
struct ChebyshevNodes {
    Eigen::Array<double, kMoments, 1> x;
    Eigen::Matrix<double, kMoments, kMoments> weight_of_sum;

    ChebyshevNodes() {
        for (int j = 0; j < kMoments; ++j) {
            const double angle = std::numbers::pi * (j + 0.5) / kMoments;
            x[j] = std::cos(angle);
            for (int k = 0; k < kMoments; ++k) {
                weight_of_sum(j, k) = (k == 0 ? 1.0 : 2.0) * std::cos(k * angle) / kMoments;
            }
        }
    }
};

// Gauss rule of a measure on points t within -1 and 1: sums of Chebyshev polynomials over the
// points, then Stieltjes's procedure on the Chebyshev nodes with these moments (W. Gautschi,
// section 2.2).
GaussRule measure_rule(const Eigen::ArrayXd& t, const Eigen::ArrayXd& weight) {
    static const ChebyshevNodes chebyshev;
    Eigen::ArrayXd last = t, now = Eigen::ArrayXd::Ones(t.size()), next;  // T_(k-1), T_k, T_(k+1)
    Eigen::Matrix<double, kMoments, 1> sums;
    for (int k = 0; k < kMoments; ++k) {
        sums[k] = (weight * now).sum();
        next = 2.0 * t * now - last;
        last.swap(now);
        now.swap(next);
    }
    using Nodes = Eigen::Array<double, kMoments, 1>;
    const Nodes share = (chebyshev.weight_of_sum * sums).array() / sums[0];
    Nodes before = Nodes::Zero(), here = Nodes::Ones();
    Eigen::VectorXd diagonal(kSizeNodes), off_diagonal(kSizeNodes - 1);
    for (int k = 0;; ++k) {
        diagonal[k] = (share * chebyshev.x * here.square()).sum();
        if (k + 1 == kSizeNodes) {
            return gauss_rule(diagonal, off_diagonal, sums[0]);
        }
        before = (chebyshev.x - diagonal[k]) * here - (k > 0 ? off_diagonal[k - 1] : 0.0) * before;
        before.swap(here);
        const double square = (share * here.square()).sum();
        if (!(square > kSamePoints)) {  // so few distinct points that k + 1 nodes represent them
            return gauss_rule(diagonal.head(k + 1), off_diagonal.head(k), sums[0]);
        }
        off_diagonal[k] = std::sqrt(square);
        here /= off_diagonal[k];
    }
}

// Appends the points of one cell, or their Gauss rule if that has fewer nodes. Returns the new end.
Eigen::Index add_cell(SizeNodes& out, Eigen::Index end, const Eigen::Ref<const Eigen::ArrayXd>& u,
                      const Eigen::Ref<const Eigen::ArrayXd>& weight) {
    const Eigen::Index count = u.size();
    const double middle = 0.5 * (u[0] + u[count - 1]), half = 0.5 * (u[count - 1] - u[0]);
    if (count <= kSizeNodes) {
        out.u.segment(end, count) = u;
        out.weight.segment(end, count) = weight;
        return end + count;
    }
    const GaussRule rule = measure_rule((u - middle) / half, weight);
    const Eigen::Index nodes = rule.nodes.size();
    out.u.segment(end, nodes) = middle + half * rule.nodes.array();
    out.weight.segment(end, nodes) = rule.weights.array();
    return end + nodes;
}

// Condenses hits and misses in `cells` cells of equal width.
SizeNodes condensed(const SizeNodes& all, double low, double range, Eigen::Index cells) {
    SizeNodes out;
    out.cell = range / static_cast<double>(cells);
    const Eigen::Index most = std::min(all.u.size(), 2 * cells * kSizeNodes);
    out.u.resize(most);
    out.weight.resize(most);
    Eigen::Index end = 0;
    const auto add = [&](Eigen::Index first, Eigen::Index measure_end) {
        const double* const begin = all.u.data();
        for (Eigen::Index cell = 1; cell <= cells; ++cell) {
            const double edge = low + static_cast<double>(cell) * out.cell;
            const Eigen::Index last =
                cell < cells ? std::lower_bound(begin + first, begin + measure_end, edge) - begin
                             : measure_end;
            if (last > first) {
                end = add_cell(out, end, all.u.segment(first, last - first),
                               all.weight.segment(first, last - first));
            }
            first = last;
        }
    };
    add(0, all.hits);
    out.hits = end;
    add(all.hits, all.u.size());
    out.u.conservativeResize(end);
    out.weight.conservativeResize(end);
    return out;
}

}  // namespace

StandardisedSizes::StandardisedSizes(const HitMissTable& table, bool log_size)
    : hits_(total_hits(table)), tests_(total_tests(table)) {
    const auto rows = static_cast<Eigen::Index>(table.size());
    sizes_.resize(rows);
    for (Eigen::Index i = 0; i < rows; ++i) {
        const HitMissRow& row = table[static_cast<std::size_t>(i)];
        sizes_[i] = log_size ? std::log(row.size) : row.size;
        centre_ += row.tests * sizes_[i] / tests_;
    }
    double square = 0.0;
    for (Eigen::Index i = 0; i < rows; ++i) {
        const double away = sizes_[i] - centre_;
        square += table[static_cast<std::size_t>(i)].tests * away * away / tests_;
    }
    spread_ = std::sqrt(square);
    sizes_ = (sizes_ - centre_) / spread_;
    // Hits, then misses.
    all_.u.resize(2 * rows);
    all_.weight.resize(2 * rows);
    Eigen::Index end = 0;
    const auto add = [&](Eigen::Index row, double count) {
        if (count > 0.0) {
            all_.u[end] = sizes_[row];
            all_.weight[end++] = count;
        }
    };
    for (Eigen::Index i = 0; i < rows; ++i) {
        add(i, table[static_cast<std::size_t>(i)].hits);
    }
    all_.hits = end;
    for (Eigen::Index i = 0; i < rows; ++i) {
        const HitMissRow& row = table[static_cast<std::size_t>(i)];
        add(i, row.tests - row.hits);
    }
    all_.u.conservativeResize(end);
    all_.weight.conservativeResize(end);
    // Cells are worth while if they halve the work.
    if (rows > 0 && sizes_.allFinite()) {
        by_cells_.resize(static_cast<std::size_t>(std::bit_width(
            static_cast<std::size_t>(end) / (4 * static_cast<std::size_t>(kSizeNodes)))));
    }
}

const SizeNodes& StandardisedSizes::nodes(double widest_cell) const {
    // Sums over a few nodes more are cheaper than one more set of nodes.
    constexpr std::size_t kCoarsest = 3;
    const double range = by_cells_.empty() ? 0.0 : sizes_[sizes_.size() - 1] - sizes_[0];
    for (std::size_t level = std::min(kCoarsest, by_cells_.size() / 2); level < by_cells_.size();
         ++level) {
        if (std::ldexp(range, -static_cast<int>(level)) <= widest_cell) {
            if (by_cells_[level].u.size() == 0) {
                by_cells_[level] = condensed(all_, sizes_[0], range, Eigen::Index{1} << level);
            }
            return by_cells_[level];
        }
    }
    return all_;
}

}  // namespace gearpod::analysis
