#include "analysis/pod_likelihood.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace gearpod::analysis {
namespace {

constexpr double kTiny = 1e-290;
constexpr double kInTransition = 1e-6;

// k ln P, 0 where nothing was counted.
double term(double count, double probability) {
    return count > 0.0 ? count * std::log(probability) : 0.0;
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
    for (const HitMissRow& row : table) {
        u_.push_back(standardised(row.size));
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
    // Plain sums: this loop is nearly all of the time of a report.
    double value = 0.0, s0 = 0.0, s1 = 0.0, s2 = 0.0;
    double i00 = 0.0, i01 = 0.0, i11 = 0.0, i02 = 0.0, i12 = 0.0, i22 = 0.0;
    const double origin = through ? through->u : 0.0;
    for (std::size_t i = 0; i < table_.size(); ++i) {
        const HitMissRow& row = table_[i];
        const LinkValues link = link_values(form_.link, parameters[0] + parameters[1] * u_[i]);
        const double hit = floor + rise * link.up;
        const double miss = (1.0 - ceiling) + rise * link.down;
        value += term(row.hits, hit) + term(row.tests - row.hits, miss);
        if (hit * miss < kTiny) {
            continue;
        }
        const double weight = 1.0 / (hit * miss);
        const double left = (row.hits - row.tests * hit) * weight;
        const double by_eta = rise * link.density;
        const double by_slope = by_eta * (u_[i] - origin);
        const double bend = row.tests * weight;
        s0 += left * by_eta;
        s1 += left * by_slope;
        i00 += bend * by_eta * by_eta;
        i01 += bend * by_eta * by_slope;
        i11 += bend * by_slope * by_slope;
        if (form_.free_ceiling) {
            const double by_ceiling = link.up + by_eta * eta_by_ceiling;
            s2 += left * by_ceiling;
            i02 += bend * by_eta * by_ceiling;
            i12 += bend * by_slope * by_ceiling;
            i22 += bend * by_ceiling * by_ceiling;
        }
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
    constexpr int kMostSteps = 100;
    constexpr double kConverged = 1e-10;  // of the log likelihood
    Maximum maximum;
    meet(parameters, through);
    Slopes here = evaluate(parameters, through);
    for (int step = 0; step < kMostSteps; ++step) {
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
        if (gain < kConverged) {
            maximum.converged = true;
            break;
        }
        bool better = false;
        for (double length = 1.0; length > 1e-8 && !better; length *= 0.5) {
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
