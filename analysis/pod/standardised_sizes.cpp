#include "analysis/pod/standardised_sizes.hpp"

#include <algorithm>
#include <cmath>

#include "analysis/statistics/gauss_rule.hpp"

namespace gearpod::analysis {
namespace {

constexpr int kSizeNodes = StandardisedSizes::kNodes;
constexpr int kMostHalvings = 14;

// Division of the range of u into 2^halvings cells.
struct Cells {
    double low = 0.0, high = 0.0;
    int halvings = 0;

    std::size_t count() const { return std::size_t{1} << halvings; }
    double width() const { return (high - low) / static_cast<double>(count()); }
    std::size_t of(double u) const {
        const double place = std::floor((u - low) / width());
        return static_cast<std::size_t>(std::clamp(place, 0.0, static_cast<double>(count() - 1)));
    }
};

// Gauss rule of a measure by the Lanczos process on the diagonal matrix of the points t, which lie
// within about -1 and 1. Every vector is orthogonalised against all previous ones, twice, which is
// necessary with few more points than nodes.
GaussRule measure_rule(const Eigen::VectorXd& t, const Eigen::VectorXd& weight) {
    Eigen::MatrixXd basis(t.size(), kSizeNodes);
    Eigen::VectorXd diagonal(kSizeNodes), off_diagonal(kSizeNodes - 1);
    const double total = weight.sum();
    Eigen::VectorXd next = weight.cwiseSqrt() / std::sqrt(total);
    for (int k = 0; k < kSizeNodes; ++k) {
        basis.col(k) = next;
        next = t.cwiseProduct(basis.col(k));
        diagonal[k] = next.dot(basis.col(k));
        if (k + 1 == kSizeNodes) {
            break;
        }
        const auto so_far = basis.leftCols(k + 1);
        for (int pass = 0; pass < 2; ++pass) {
            const Eigen::VectorXd shares = so_far.transpose() * next;
            next.noalias() -= so_far * shares;
        }
        off_diagonal[k] = next.norm();
        if (!(off_diagonal[k] >
              1e-13)) {  // so few distinct points that k + 1 nodes represent them all
            return gauss_rule(diagonal.head(k + 1), off_diagonal.head(k), total);
        }
        next /= off_diagonal[k];
    }
    return gauss_rule(diagonal, off_diagonal, total);
}

// Adds the points of one cell, or its Gauss rule if that has fewer nodes.
void add_cell(WeightedSizes& out, const WeightedSizes& in, std::size_t first, std::size_t last) {
    if (last - first <= static_cast<std::size_t>(kSizeNodes)) {
        out.u.insert(out.u.end(), in.u.begin() + static_cast<std::ptrdiff_t>(first),
                     in.u.begin() + static_cast<std::ptrdiff_t>(last));
        out.weight.insert(out.weight.end(), in.weight.begin() + static_cast<std::ptrdiff_t>(first),
                          in.weight.begin() + static_cast<std::ptrdiff_t>(last));
        return;
    }
    const auto count = static_cast<Eigen::Index>(last - first);
    const auto u = Eigen::ArrayXd::Map(in.u.data() + first, count);
    const auto weight = Eigen::VectorXd::Map(in.weight.data() + first, count);
    const double middle = 0.5 * (in.u[first] + in.u[last - 1]);
    const double half = 0.5 * (in.u[last - 1] - in.u[first]);
    const GaussRule rule =
        half > 0.0 ? measure_rule((u - middle) / half, weight)
                   : GaussRule{Eigen::VectorXd::Zero(1), Eigen::VectorXd{{weight.sum()}}};
    for (Eigen::Index i = 0; i < rule.nodes.size(); ++i) {
        out.u.push_back(middle + half * rule.nodes[i]);
        out.weight.push_back(rule.weights[i]);
    }
}

WeightedSizes condensed(const WeightedSizes& in, const Cells& cells) {
    WeightedSizes out;
    for (std::size_t first = 0; first < in.u.size();) {
        const std::size_t cell = cells.of(in.u[first]);
        std::size_t last = first;
        while (last < in.u.size() && cells.of(in.u[last]) == cell) {
            ++last;
        }
        add_cell(out, in, first, last);
        first = last;
    }
    return out;
}

// Number of nodes that remain with these cells.
std::size_t nodes_left(const WeightedSizes& sizes, const Cells& cells) {
    std::size_t nodes = 0, in_cell = 0, cell = 0;
    for (const double u : sizes.u) {
        const std::size_t here = cells.of(u);
        in_cell = here == cell ? in_cell + 1 : 1;
        cell = here;
        nodes += in_cell <= static_cast<std::size_t>(kSizeNodes) ? 1 : 0;
    }
    return nodes;
}

SizeNodes level_of(const WeightedSizes& hits, const WeightedSizes& misses, double cell) {
    SizeNodes level;
    level.cell = cell;
    level.hits = static_cast<Eigen::Index>(hits.u.size());
    const auto rest = static_cast<Eigen::Index>(misses.u.size());
    level.u.resize(level.hits + rest);
    level.weight.resize(level.hits + rest);
    level.u << Eigen::ArrayXd::Map(hits.u.data(), level.hits),
        Eigen::ArrayXd::Map(misses.u.data(), rest);
    level.weight << Eigen::ArrayXd::Map(hits.weight.data(), level.hits),
        Eigen::ArrayXd::Map(misses.weight.data(), rest);
    return level;
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
    WeightedSizes hits, misses;
    for (Eigen::Index i = 0; i < rows; ++i) {
        const HitMissRow& row = table[static_cast<std::size_t>(i)];
        if (row.hits > 0.0) {
            hits.u.push_back(sizes_[i]);
            hits.weight.push_back(row.hits);
        }
        if (row.hits < row.tests) {
            misses.u.push_back(sizes_[i]);
            misses.weight.push_back(row.tests - row.hits);
        }
    }
    levels_.push_back(level_of(hits, misses, 0.0));
    if (rows == 0 || !sizes_.allFinite()) {
        return;
    }
    // Starts with the narrowest cells that halve the work, then doubles the cell width at each
    // level.
    Cells cells{sizes_[0], sizes_[rows - 1], kMostHalvings};
    const auto worth = static_cast<std::size_t>(levels_[0].u.size()) / 2;
    while (cells.halvings > 0 && nodes_left(hits, cells) + nodes_left(misses, cells) > worth) {
        --cells.halvings;
    }
    while (nodes_left(hits, cells) + nodes_left(misses, cells) <= worth) {
        hits = condensed(hits, cells);
        misses = condensed(misses, cells);
        levels_.push_back(level_of(hits, misses, cells.width()));
        if (cells.halvings-- == 0) {
            break;
        }
    }
}

const SizeNodes& StandardisedSizes::nodes(double widest_cell) const {
    std::size_t level = levels_.size() - 1;
    while (level > 0 && !(levels_[level].cell <= widest_cell)) {
        --level;
    }
    return levels_[level];
}

}  // namespace gearpod::analysis
