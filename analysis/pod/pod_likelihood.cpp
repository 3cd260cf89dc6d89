#include "analysis/pod/pod_likelihood.hpp"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>
#include <numeric>
#include <stdexcept>

#include "analysis/statistics/distributions.hpp"
#include "analysis/statistics/gauss_rule.hpp"
#include "analysis/statistics/outcome_terms.hpp"
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

double total_tests(const HitMissTable& table) {
    return std::accumulate(table.begin(), table.end(), 0.0,
                           [](double sum, const HitMissRow& row) { return sum + row.tests; });
}

double total_hits(const HitMissTable& table) {
    return std::accumulate(table.begin(), table.end(), 0.0,
                           [](double sum, const HitMissRow& row) { return sum + row.hits; });
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

constexpr double kInTransition = 1e-6;
// Half-width of a cell of sizes in units of eta, at most. The singularities of the links nearest to
// the real axis are at a distance of pi for the logit, about 2 with a usual floor for the probit,
// and pi / 2 for the others.
constexpr double kHalfCellLogit = 2.0, kHalfCell = 1.0;

constexpr double kPenaltyStep = 1e-4;

// Share of the own probability below which the curve is flat in double precision.
constexpr double kFlat = 1e-17;

// Range of eta, -low to high, outside which the probability of this outcome is constant. Infinite
// where that probability is 0 and its logarithm still varies.
struct Transition {
    double low = 0.0, high = 0.0;

    Transition(Link link, double at_floor, double at_ceiling, double rise) {
        const double bottom = std::min(0.5, kFlat * at_floor / rise);
        const double top = std::min(0.5, kFlat * at_ceiling / rise);
        // A normal deviate x is exceeded at a rate of at most exp(-x^2 / 2) / 2.
        const auto normal = [](double rate) { return std::sqrt(-2.0 * std::log(2.0 * rate)); };
        low = link == Link::probit ? normal(bottom) : -link_quantile(link, bottom);
        high = link == Link::probit ? normal(top) : link_upper_quantile(link, top);
    }
};

constexpr double kReplicates = 5.0;  // mean number of gearboxes per size to count as replicated
constexpr int kGroups = 10;

double excess(double count, double expected) {
    return count > 0.0 ? count * std::log(count / expected) : 0.0;
}

double saturated_statistic(const HitMissTable& table, const PodCurve& curve) {
    double sum = 0.0;
    for (const HitMissRow& row : table) {
        const double pod = curve.pod(row.size);
        sum += excess(row.hits, row.tests * pod) +
               excess(row.tests - row.hits, row.tests * (1.0 - pod));
    }
    return 2.0 * sum;
}

// Hosmer-Lemeshow statistic. A size is never split, so that the groups do not depend on the order
// of its gearboxes.
double grouped_statistic(const HitMissTable& table, const PodCurve& curve, int& groups) {
    const double tests = total_tests(table);
    double statistic = 0.0;
    double seen = 0.0, hits = 0.0, expected = 0.0, count = 0.0;
    groups = 0;
    for (std::size_t i = 0; i < table.size(); ++i) {
        hits += table[i].hits;
        expected += table[i].tests * curve.pod(table[i].size);
        count += table[i].tests;
        seen += table[i].tests;
        if (seen >= (groups + 1) * tests / kGroups || i + 1 == table.size()) {
            const double variance = expected * (1.0 - expected / count);
            if (variance > 0.0) {
                statistic += (hits - expected) * (hits - expected) / variance;
            }
            ++groups;
            hits = expected = count = 0.0;
        }
    }
    return statistic;
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

PodLikelihood::PodLikelihood(std::shared_ptr<const StandardisedSizes> sizes, const PodForm& form)
    : sizes_(std::move(sizes)), form_(form) {
    if (sizes_->sizes().size() < 2) {
        throw std::invalid_argument("POD likelihood: needs at least two fault sizes");
    }
    if (form_.firth && form_.free_ceiling) {
        throw std::invalid_argument(
            "POD likelihood: Firth's penalty cannot be combined with a fitted ceiling");
    }
}

PodLikelihood::PodLikelihood(const HitMissTable& table, const PodForm& form)
    : PodLikelihood(std::make_shared<const StandardisedSizes>(table, form.log_size), form) {}

const SizeNodes& PodLikelihood::nodes_for(double slope) const {
    const double half = form_.link == Link::logit ? kHalfCellLogit : kHalfCell;
    return sizes_->nodes(2.0 * half / std::abs(slope));
}

PodLikelihood::Slopes PodLikelihood::evaluate(const Parameters& parameters,
                                              const std::optional<Point>& through,
                                              const SizeNodes& nodes) const {
    const double floor = form_.floor;
    const double ceiling = parameters[2];
    const double rise = ceiling - floor;
    // With a point constraint, the first parameter is eta at the point, and the ceiling follows
    // from it.
    double ceiling_by_eta = 0.0;
    if (through && form_.free_ceiling) {
        const LinkValues link = link_values(form_.link, parameters[0] + parameters[1] * through->u);
        ceiling_by_eta = -(through->pod - floor) * link.density / (link.up * link.up);
    }
    const OutcomeLine line{{form_.link, floor, ceiling},
                           parameters[0],
                           parameters[1],
                           through ? through->u : 0.0,
                           ceiling_by_eta};
    LikelihoodSums sums;
    const auto add_all = [&](Eigen::Index first, Eigen::Index last, bool detected) {
        const Transition flat = detected ? Transition(form_.link, floor, ceiling, rise)
                                         : Transition(form_.link, 1.0 - floor, 1.0 - ceiling, rise);
        const double low = (-flat.low - parameters[0]) / parameters[1];
        const double high = (flat.high - parameters[0]) / parameters[1];
        const double* const begin = nodes.u.data();
        const Eigen::Index from =
            std::lower_bound(begin + first, begin + last, std::min(low, high)) - begin;
        const Eigen::Index to =
            std::lower_bound(begin + from, begin + last, std::max(low, high)) - begin;
        add_outcomes(line, detected, to - from, begin + from, nodes.weight.data() + from, sums);
        // Where the curve is flat, one size represents all.
        const auto add_flat = [&](Eigen::Index start, Eigen::Index end, Eigen::Index term) {
            if (end > start) {
                const double weight = nodes.weight.segment(start, end - start).sum();
                add_outcomes(line, detected, 1, begin + term, &weight, sums);
            }
        };
        add_flat(first, from, from - 1);
        add_flat(to, last, to);
    };
    add_all(0, nodes.hits, true);
    add_all(nodes.hits, nodes.u.size(), false);
    Slopes slopes;
    slopes.value = sums.value;
    slopes.score = {sums.by_first, sums.by_slope, 0.0};
    slopes.information.topLeftCorner<2, 2>() << sums.first_first, sums.first_slope,
        sums.first_slope, sums.slope_slope;
    if (form_.free_ceiling && !through) {
        slopes.score[2] = sums.by_ceiling;
        slopes.information.col(2) << sums.first_ceiling, sums.slope_ceiling, sums.ceiling_ceiling;
        slopes.information.row(2) = slopes.information.col(2);
    }
    if (through && !form_.free_ceiling) {  // eta there is given
        slopes.score[0] = 0.0;
        slopes.information.row(0).setZero();
        slopes.information.col(0).setZero();
    }
    return slopes;
}

double PodLikelihood::penalise(const Parameters& parameters, const std::optional<Point>& through,
                               const SizeNodes& nodes, Slopes& slopes) const {
    const auto half_log_determinant = [&](const Parameters& point) {
        const Eigen::Matrix3d all = evaluate(point, std::nullopt, nodes).information;
        return 0.5 * std::log(all(0, 0) * all(1, 1) - all(0, 1) * all(0, 1));
    };
    // With a point constraint, the intercept follows the slope.
    const Parameters turning{-(through ? through->u : 0.0), 1.0, 0.0};
    const auto slope_along = [&](const Parameters& direction, double value) {
        const double step = kPenaltyStep * std::max(1.0, std::abs(value));
        return (half_log_determinant(parameters + step * direction) -
                half_log_determinant(parameters - step * direction)) /
               (2.0 * step);
    };
    const double penalty = half_log_determinant(parameters);
    slopes.value += penalty;
    slopes.score[1] += slope_along(turning, parameters[1]);
    if (!through) {
        slopes.score[0] += slope_along({1.0, 0.0, 0.0}, parameters[0]);
    }
    return penalty;
}

PodLikelihood::Slopes PodLikelihood::penalised(const Parameters& parameters,
                                               const std::optional<Point>& through,
                                               const SizeNodes& nodes) const {
    Slopes slopes = evaluate(parameters, through, nodes);
    if (form_.firth) {
        penalise(parameters, through, nodes, slopes);
    }
    return slopes;
}

bool PodLikelihood::pass_through(Parameters& parameters,
                                 const std::optional<Point>& through) const {
    if (!through) {
        parameters[2] = std::min(parameters[2], 1.0);
        return parameters[2] > form_.floor;
    }
    const double rise = through->pod - form_.floor;  // rise up to the point
    const double least = link_quantile(form_.link, rise / (1.0 - form_.floor));
    const double eta = parameters[0] + parameters[1] * through->u;
    if (form_.free_ceiling && eta > least) {
        const double share = link_probability(form_.link, eta);
        parameters[2] = std::min(1.0, form_.floor + rise / share);
    } else {
        parameters[2] = 1.0;
        parameters[0] = least - parameters[1] * through->u;
    }
    return true;
}

PodLikelihood::Maximum PodLikelihood::ascend(Parameters parameters,
                                             const std::optional<Point>& through) const {
    // Only the deviance of a profile matters. Where a degenerate curve steps from size to size, its
    // likelihood has no smooth maximum, and an unlimited search would not end.
    const int most_steps = through ? 40 : 100;
    const double converged = through ? 1e-7 : 1e-10;  // gain of the log likelihood
    const double shortest = through ? 1e-3 : 1e-8;    // step
    Maximum maximum;
    pass_through(parameters, through);
    const SizeNodes* nodes = &nodes_for(parameters[1]);
    Slopes here = penalised(parameters, through, *nodes);
    for (int step = 0; step < most_steps; ++step) {
        Eigen::Matrix3d system = here.information;
        Parameters score = here.score;
        // Freezes fixed parameters and a ceiling at its limit of 1.
        const bool at_one = form_.free_ceiling && parameters[2] >= 1.0 &&
                            (through ? score[0] <= 0.0 : score[2] >= 0.0);
        for (int j = 0; j < 3; ++j) {
            if (system(j, j) == 0.0 || (at_one && j == (through ? 0 : 2))) {
                system.row(j).setZero();
                system.col(j).setZero();
                system(j, j) = 1.0;
                score[j] = 0.0;
            }
        }
        // Slight damping keeps a nearly singular step finite.
        system.diagonal() *= 1.0 + 1e-12;
        const Parameters move = system.ldlt().solve(score);
        const double gain = score.dot(move);
        if (!std::isfinite(gain)) {
            break;
        }
        if (gain < converged) {
            maximum.converged = true;
            break;
        }
        bool better = false;
        for (double length = 1.0; length > shortest && !better; length *= 0.5) {
            Parameters next = parameters + length * move;
            if (through) {  // the first parameter moves eta at the point
                next[0] -= length * move[1] * through->u;
            }
            if (!pass_through(next, through)) {
                continue;
            }
            // Never coarser than before: sums over other nodes differ by more than rounding.
            if (const SizeNodes& finer = nodes_for(next[1]); finer.cell < nodes->cell) {
                nodes = &finer;
                here = penalised(parameters, through, finer);
            }
            Slopes there = penalised(next, through, *nodes);
            if (there.value > here.value - 1e-14 * std::abs(here.value)) {
                better = true;
                parameters = next;
                here = there;
            }
        }
        if (!better) {
            maximum.converged = gain < 1e-6;
            break;
        }
    }
    maximum.log_likelihood = here.value;
    maximum.parameters = parameters;
    maximum.information = here.information;
    if (form_.firth) {
        maximum.penalty = penalise(parameters, through, *nodes, here);
    }
    return maximum;
}

PodLikelihood::Maximum PodLikelihood::maximise(std::optional<Parameters> start) const {
    if (!start) {
        const double rate = sizes_->hits() / sizes_->tests();
        const double share = std::clamp((rate - form_.floor) / (1.0 - form_.floor), 0.01, 0.99);
        start = Parameters{link_quantile(form_.link, share), 0.1, form_.free_ceiling ? 0.99 : 1.0};
    }
    return ascend(*start, std::nullopt);
}

PodLikelihood::Maximum PodLikelihood::maximise_through(double u, double pod,
                                                       const Parameters& start) const {
    Parameters parameters = start;
    // Keeps the start's ceiling if the point lies clearly below it, otherwise the start's
    // intercept.
    constexpr double kClear = 0.9;
    const double share = (pod - form_.floor) / (start[2] - form_.floor);
    if (form_.free_ceiling && share < kClear) {
        parameters[0] = link_quantile(form_.link, share) - parameters[1] * u;
    }
    return ascend(parameters, Point{u, pod});
}

std::optional<double> PodLikelihood::extreme_zeta(double u, double log_likelihood, int side,
                                                  Parameters& start) const {
    constexpr int kMostSteps = 30;
    constexpr double kConverged = 1e-3;  // in standard errors; the remaining error is its square
    constexpr double kOnContour = 1e-2;  // of the log likelihood
    constexpr double kTooFar = 5.0;      // below the contour, where the quadratic model is wrong
    if (form_.firth) {
        return std::nullopt;
    }
    const double floor = form_.floor;
    Parameters parameters = start;
    Parameters last_move = Parameters::Zero();
    bool held = !form_.free_ceiling;  // the ceiling is fixed
    for (int step = 0; step < kMostSteps; ++step) {
        const Slopes here = evaluate(parameters, std::nullopt, nodes_for(parameters[1]));
        if (!last_move.isZero() && !(here.value > log_likelihood - kTooFar)) {
            last_move *= 0.5;
            parameters -= last_move;
            continue;
        }
        // Gradient of zeta, which is eta itself with a ceiling of 1.
        const double rise = parameters[2] - floor;
        const LinkValues link = link_values(form_.link, parameters[0] + parameters[1] * u);
        const double zeta = link_quantile(form_.link, rise * link.up / (1.0 - floor));
        const double scale = (1.0 - floor) * link_density(form_.link, zeta);
        if (std::isinf(zeta) && zeta * side > 0.0 && here.value >= log_likelihood) {
            start = parameters;  // nothing is more extreme
            return zeta;
        }
        const double by_eta = form_.free_ceiling ? rise * link.density / scale : 1.0;
        const double by_ceiling = form_.free_ceiling ? link.up / scale : 0.0;
        const Parameters gradient{by_eta, by_eta * u, held ? 0.0 : by_ceiling};
        const Parameters score{here.score[0], here.score[1], held ? 0.0 : here.score[2]};
        Eigen::Matrix3d system = here.information;
        if (held) {
            system.row(2).setZero();
            system.col(2).setZero();
            system(2, 2) = 1.0;
        }
        const Eigen::LDLT<Eigen::Matrix3d> solver(system);
        // Extreme of zeta on the contour of the quadratic model of the log likelihood.
        const Parameters to_top = solver.solve(score);
        const Parameters along = solver.solve(gradient);
        const double height = here.value + 0.5 * score.dot(to_top) - log_likelihood;
        const double length = std::sqrt(std::max(0.0, 2.0 * height / gradient.dot(along)));
        const Parameters move = to_top + side * length * along;
        if (!move.allFinite()) {
            return std::nullopt;
        }
        if (parameters[2] + move[2] > 1.0) {  // a ceiling at its limit stays there
            parameters[2] = 1.0;
            held = true;
            continue;
        }
        parameters += move;
        last_move = move;
        if (std::sqrt(std::abs(move.dot(system * move))) < kConverged) {
            // Far out the likelihood is flat, where any move is small.
            const double reached =
                evaluate(parameters, std::nullopt, nodes_for(parameters[1])).value;
            // With the ceiling at 1, no lower ceiling may be more extreme.
            const bool at_end = held && form_.free_ceiling;
            if (!(std::abs(reached - log_likelihood) < kOnContour) ||
                (at_end && !(side * length * by_ceiling + here.score[2] >= 0.0))) {
                return std::nullopt;
            }
            start = parameters;
            return zeta + gradient.dot(move);
        }
    }
    return std::nullopt;
}

PodCurve PodLikelihood::curve(const Parameters& parameters) const {
    PodCurve curve;
    curve.form = form_;
    curve.slope = parameters[1] / sizes_->spread();
    curve.intercept = parameters[0] - curve.slope * sizes_->centre();
    curve.ceiling = parameters[2];
    return curve;
}

int PodLikelihood::sizes_in_transition(const Parameters& parameters) const {
    const double low = link_quantile(form_.link, kInTransition);
    const double high = link_upper_quantile(form_.link, kInTransition);
    const Eigen::ArrayXd eta = parameters[0] + parameters[1] * sizes_->sizes();
    return static_cast<int>((eta > low && eta < high).count());
}

GoodnessOfFit goodness_of_fit(const HitMissTable& table, const PodCurve& curve) {
    GoodnessOfFit fit;
    const auto sizes = static_cast<int>(table.size());
    const double tests = total_tests(table);
    fit.statistic = fit.p_value = kNan;
    double statistic = 0.0;
    if (tests >= kReplicates * sizes) {
        statistic = saturated_statistic(table, curve);
        fit.degrees = sizes - curve.form.parameters();
        fit.test = GoodnessOfFit::Test::saturated;
    } else {
        int groups = 0;
        statistic = grouped_statistic(table, curve, groups);
        fit.degrees = groups - curve.form.parameters();
        fit.test = GoodnessOfFit::Test::hosmer_lemeshow;
    }
    if (fit.degrees <= 0) {
        fit.test = GoodnessOfFit::Test::none;
        fit.degrees = 0;
        return fit;
    }
    fit.statistic = statistic;
    fit.p_value = chi_squared_upper_tail(statistic, fit.degrees);
    return fit;
}

std::string fit_text(const GoodnessOfFit& fit) {
    switch (fit.test) {
        case GoodnessOfFit::Test::saturated:
            return fmt::format("likelihood ratio against separate rates of all sizes: p = {:.2g}",
                               fit.p_value);
        case GoodnessOfFit::Test::hosmer_lemeshow:
            return fmt::format("Hosmer-Lemeshow: p = {:.2g}", fit.p_value);
        case GoodnessOfFit::Test::none:
            break;
    }
    return "fit not testable: too few sizes";
}

}  // namespace gearpod::analysis
