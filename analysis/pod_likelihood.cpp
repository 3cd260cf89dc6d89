#include "analysis/pod_likelihood.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

namespace gearpod::analysis {
namespace {

constexpr double kTiny = 1e-290;
constexpr double kLeast = std::numeric_limits<double>::min();
constexpr double kInTransition = 1e-6;

// Sum of k ln P; P is held off 0, where nothing was counted if the sum is finite.
double terms(const Eigen::ArrayXd& count, const Eigen::ArrayXd& probability) {
    // Eigen takes many logarithms at once only in an array of their own.
    const Eigen::ArrayXd logs = probability.max(kLeast).log();
    return (count * logs).sum();
}

// link_values() of many; Eigen's exponential has the same bits on every processor, too.
struct LinkArrays {
    Eigen::ArrayXd up, down, density;
};
LinkArrays link_arrays(Link link, const Eigen::ArrayXd& eta) {
    LinkArrays values;
    Eigen::ArrayXd small;
    if (link == Link::logit) {
        const Eigen::ArrayXd e = (-eta.abs()).exp();
        small = e / (1.0 + e);
        values.density = small / (1.0 + e);
    } else {
        small = eta.unaryExpr(
            [](double at) { return 0.5 * std::erfc(std::abs(at) / std::numbers::sqrt2); });
        values.density =
            (-0.5 * eta.square()).exp() * (std::numbers::inv_sqrtpi / std::numbers::sqrt2);
    }
    values.up = (eta > 0.0).select(1.0 - small, small);
    values.down = (eta > 0.0).select(small, 1.0 - small);
    return values;
}

}  // namespace

PodLikelihood::PodLikelihood(const HitMissTable& table, const PodForm& form)
    : table_(table), form_(form) {
    if (table.size() < 2) {
        throw std::invalid_argument("POD likelihood: needs two fault sizes at least");
    }
    const double tests = total_tests(table);
    for (const HitMissRow& row : table) {
        centre_ += row.tests * form.scaled(row.size) / tests;
    }
    double square = 0.0;
    for (const HitMissRow& row : table) {
        const double away = form.scaled(row.size) - centre_;
        square += row.tests * away * away / tests;
    }
    spread_ = std::sqrt(square);
    const auto rows = static_cast<Eigen::Index>(table.size());
    u_.resize(rows);
    hits_.resize(rows);
    tests_.resize(rows);
    for (Eigen::Index i = 0; i < rows; ++i) {
        const HitMissRow& row = table[static_cast<std::size_t>(i)];
        u_[i] = standardised(row.size);
        hits_[i] = row.hits;
        tests_[i] = row.tests;
    }
}

PodLikelihood::Slopes PodLikelihood::evaluate(const Parameters& parameters,
                                              const std::optional<Point>& through) const {
    const double floor = form_.floor;
    const double ceiling = parameters[2];
    const double rise = ceiling - floor;
    // The intercept follows from slope and ceiling if the curve is held to a point.
    double eta_by_ceiling = 0.0;
    if (through && form_.free_ceiling) {
        const double eta = link_quantile(form_.link, (through->pod - floor) / rise);
        eta_by_ceiling = -(through->pod - floor) / (rise * rise * link_density(form_.link, eta));
    }
    // Arrays at once: this is nearly all of the time of a report.
    const double origin = through ? through->u : 0.0;
    const LinkArrays link = link_arrays(form_.link, parameters[0] + parameters[1] * u_);
    const Eigen::ArrayXd hit = floor + rise * link.up;
    const Eigen::ArrayXd miss = (1.0 - ceiling) + rise * link.down;
    const double value = terms(hits_, hit) + terms(tests_ - hits_, miss);
    const Eigen::ArrayXd both = hit * miss;
    const Eigen::ArrayXd weight = (both < kTiny).select(0.0, both.max(kTiny).inverse());
    const Eigen::ArrayXd left = (hits_ - tests_ * hit) * weight;
    const Eigen::ArrayXd bend = tests_ * weight;
    const Eigen::ArrayXd by_eta = rise * link.density;
    const Eigen::ArrayXd by_slope = by_eta * (u_ - origin);
    const double s0 = (left * by_eta).sum(), s1 = (left * by_slope).sum();
    const double i00 = (bend * by_eta * by_eta).sum(), i01 = (bend * by_eta * by_slope).sum();
    const double i11 = (bend * by_slope * by_slope).sum();
    double s2 = 0.0, i02 = 0.0, i12 = 0.0, i22 = 0.0;
    if (form_.free_ceiling) {
        const Eigen::ArrayXd by_ceiling = link.up + by_eta * eta_by_ceiling;
        s2 = (left * by_ceiling).sum();
        i02 = (bend * by_eta * by_ceiling).sum();
        i12 = (bend * by_slope * by_ceiling).sum();
        i22 = (bend * by_ceiling * by_ceiling).sum();
    }
    Slopes slopes;
    slopes.value = value;
    slopes.score = {s0, s1, s2};
    slopes.information << i00, i01, i02, i01, i11, i12, i02, i12, i22;
    if (through) {  // the intercept is not free
        slopes.score[0] = 0.0;
        slopes.information.row(0).setZero();
        slopes.information.col(0).setZero();
    }
    return slopes;
}

bool PodLikelihood::meet(Parameters& parameters, const std::optional<Point>& through) const {
    if (parameters[2] <= form_.floor) {
        return false;
    }
    if (through) {
        if (parameters[2] <= through->pod) {
            return false;
        }
        const double share = (through->pod - form_.floor) / (parameters[2] - form_.floor);
        parameters[0] = link_quantile(form_.link, share) - parameters[1] * through->u;
    }
    return true;
}

PodLikelihood::Maximum PodLikelihood::ascend(Parameters parameters,
                                             const std::optional<Point>& through) const {
    // Of a profile only the deviance counts; where a degenerate curve steps from size to size its
    // likelihood has no smooth maximum, and a search without end would find none.
    const int most_steps = through ? 40 : 100;
    const double converged = through ? 1e-7 : 1e-10;  // of the log likelihood
    const double shortest = through ? 1e-3 : 1e-8;    // step
    Maximum maximum;
    meet(parameters, through);
    Slopes here = evaluate(parameters, through);
    for (int step = 0; step < most_steps; ++step) {
        Eigen::Matrix3d system = here.information;
        Parameters score = here.score;
        // A parameter that is fixed, or a ceiling that pushes against 1, does not move.
        const bool at_one = form_.free_ceiling && parameters[2] >= 1.0 && score[2] >= 0.0;
        for (int j = 0; j < 3; ++j) {
            if (system(j, j) == 0.0 || (j == 2 && at_one)) {
                system.row(j).setZero();
                system.col(j).setZero();
                system(j, j) = 1.0;
                score[j] = 0.0;
            }
        }
        // A trace of damping keeps a nearly singular step finite.
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
            next[2] = std::min(next[2], 1.0);
            if (!meet(next, through)) {
                continue;
            }
            Slopes there = evaluate(next, through);
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
    return maximum;
}

PodLikelihood::Maximum PodLikelihood::maximise(std::optional<Parameters> start) const {
    if (!start) {
        const double rate = total_hits(table_) / total_tests(table_);
        const double share = std::clamp((rate - form_.floor) / (1.0 - form_.floor), 0.01, 0.99);
        start = Parameters{link_quantile(form_.link, share), 0.1, form_.free_ceiling ? 0.99 : 1.0};
    }
    return ascend(*start, std::nullopt);
}

PodLikelihood::Maximum PodLikelihood::maximise_through(double u, double pod,
                                                       const Parameters& start) const {
    Parameters parameters = start;
    if (form_.free_ceiling && parameters[2] <= pod + 0.01 * (1.0 - pod)) {
        parameters[2] = 0.5 * (1.0 + pod);
    }
    return ascend(parameters, Point{u, pod});
}

std::optional<double> PodLikelihood::extreme_zeta(double u, double log_likelihood, int side,
                                                  Parameters& start) const {
    constexpr int kMostSteps = 30;
    constexpr double kSettled = 1e-3;    // of a standard error; what the move leaves is its square
    constexpr double kOnContour = 1e-2;  // of the log likelihood
    const double floor = form_.floor;
    Parameters parameters = start;
    for (int step = 0; step < kMostSteps; ++step) {
        const Slopes here = evaluate(parameters, std::nullopt);
        // Gradient of zeta; it is eta itself with a ceiling of 1.
        const double rise = parameters[2] - floor;
        const LinkValues at = link_values(form_.link, parameters[0] + parameters[1] * u);
        const double zeta = link_quantile(form_.link, rise * at.up / (1.0 - floor));
        const double scale = (1.0 - floor) * link_density(form_.link, zeta);
        const double by_eta = form_.free_ceiling ? rise * at.density / scale : 1.0;
        const Parameters gradient{by_eta, by_eta * u, form_.free_ceiling ? at.up / scale : 0.0};
        Eigen::Matrix3d system = here.information;
        if (!form_.free_ceiling) {
            system(2, 2) = 1.0;
        }
        const Eigen::LDLT<Eigen::Matrix3d> solver(system);
        // The extreme of zeta where the quadratic model of the log likelihood keeps its value.
        const Parameters to_top = solver.solve(here.score);
        const Parameters along = solver.solve(gradient);
        const double height = here.value + 0.5 * here.score.dot(to_top) - log_likelihood;
        const double length = std::sqrt(std::max(0.0, 2.0 * height / gradient.dot(along)));
        const Parameters move = to_top + side * length * along;
        if (!move.allFinite() || parameters[2] + move[2] > 1.0) {
            return std::nullopt;
        }
        parameters += move;
        if (std::sqrt(std::abs(move.dot(system * move))) < kSettled) {
            // Far out the likelihood is flat, and a move is small there wherever it leads.
            const double reached = evaluate(parameters, std::nullopt).value;
            if (!(std::abs(reached - log_likelihood) < kOnContour)) {
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
    curve.slope = parameters[1] / spread_;
    curve.intercept = parameters[0] - curve.slope * centre_;
    curve.ceiling = parameters[2];
    return curve;
}

int PodLikelihood::sizes_in_transition(const Parameters& parameters) const {
    return static_cast<int>(std::count_if(u_.begin(), u_.end(), [&](double u) {
        const double eta = parameters[0] + parameters[1] * u;
        return std::min(link_probability(form_.link, eta), link_probability(form_.link, -eta)) >
               kInTransition;
    }));
}

}  // namespace gearpod::analysis
