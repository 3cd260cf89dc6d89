#include "analysis/smooth_response.hpp"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <random>

#include "analysis/pod/response_bounds.hpp"
#include "analysis/statistics/link.hpp"

namespace gearpod::analysis {
namespace {

constexpr std::size_t kFewestSpecimens = 15, kFewestSizes = 8;
constexpr double kSteepestGrowth = 4.0;
constexpr int kSizes = 41, kTables = 600;

std::map<long, std::vector<std::size_t>> by_specimen(const ResponseRows& rows) {
    std::map<long, std::vector<std::size_t>> all;
    for (std::size_t i = 0; i < rows.size.size(); ++i) {
        all[rows.specimen.empty() ? static_cast<long>(i) : rows.specimen[i]].push_back(i);
    }
    return all;
}

// Intraclass correlation of unit-variance values by one-way analysis of variance: S. R. Searle, G.
// Casella, C. E. McCulloch, Variance Components (1992), section 3.6.
double intraclass_correlation(const ResponseRows& rows, const std::vector<double>& z) {
    const auto specimens = by_specimen(rows);
    const auto n = static_cast<double>(z.size()), groups = static_cast<double>(specimens.size());
    if (groups >= n) {
        return 0.0;
    }
    double between = 0.0, within = 0.0, squares = 0.0;
    for (const auto& [specimen, lines] : specimens) {
        const auto count = static_cast<double>(lines.size());
        double mean = 0.0;
        for (const std::size_t i : lines) {
            mean += z[i] / count;
        }
        for (const std::size_t i : lines) {
            within += (z[i] - mean) * (z[i] - mean);
        }
        between += count * mean * mean;
        squares += count * count;
    }
    const double in_group = within / (n - groups);
    const double per_group = (n - squares / n) / (groups - 1.0);
    const double of_groups = std::max(0.0, (between / (groups - 1.0) - in_group) / per_group);
    return of_groups / (of_groups + in_group);
}

// Last size at which `excess` becomes positive; linear between the sizes.
SizeEstimate last_rise(const std::vector<double>& sizes, const std::vector<double>& excess) {
    if (!(excess.back() >= 0.0)) {
        return {SizeEstimate::Where::not_reached, kNan};
    }
    for (std::size_t i = sizes.size() - 1; i > 0; --i) {
        if (!(excess[i - 1] >= 0.0)) {
            const double share = excess[i] / (excess[i] - excess[i - 1]);
            return {SizeEstimate::Where::reached, sizes[i] - share * (sizes[i] - sizes[i - 1])};
        }
    }
    return {SizeEstimate::Where::below_tested, kNan};
}

double quantile_of(std::vector<double> values, double share) {
    std::sort(values.begin(), values.end());
    const auto n = static_cast<double>(values.size());
    const double position = std::clamp(share * (n + 1.0) - 1.0, 0.0, n - 1.0);
    const auto low = static_cast<std::size_t>(position);
    return std::lerp(values[low], values[std::min(low + 1, values.size() - 1)],
                     position - static_cast<double>(low));
}

}  // namespace

SmoothResponse::SmoothResponse(const ResponseRows& rows, double threshold, Alarm alarm,
                               double confidence) {
    std::vector<double> sizes = rows.size;
    std::sort(sizes.begin(), sizes.end());
    sizes.erase(std::unique(sizes.begin(), sizes.end()), sizes.end());
    const std::size_t specimens = by_specimen(rows).size();
    if (specimens < kFewestSpecimens || sizes.size() < kFewestSizes) {
        refusal_ = fmt::format("a curve needs {} specimens of {} sizes, not {} of {}",
                               kFewestSpecimens, kFewestSizes, specimens, sizes.size());
        return;
    }
    for (int k = 0; k < kNodes; ++k) {
        nodes_[static_cast<std::size_t>(k)] =
            sizes[(sizes.size() - 1) * static_cast<std::size_t>(k) / (kNodes - 1)];
    }
    double logs = 0.0;
    for (const double size : rows.size) {
        logs += std::log(size);
    }
    middle_ = std::exp(logs / static_cast<double>(rows.size.size()));
    const double side = alarm_sign(alarm);
    fit(rows, side);
    check(rows);
    if (refusal_.empty()) {
        refusal_ = too_few_tables(kTables, confidence);
    }
    if (refusal_.empty()) {
        add_bounds(rows, threshold, side, confidence);
    }
}

// Integrals of the hat functions of the nodes, each relative to the range of the sizes.
SmoothResponse::Slopes SmoothResponse::basis(double size) const {
    Slopes slopes{1.0};
    const double range = nodes_.back() - nodes_.front();
    for (std::size_t k = 0; k + 1 < kNodes; ++k) {
        const double width = nodes_[k + 1] - nodes_[k];
        const double along = std::clamp((size - nodes_[k]) / width, 0.0, 1.0);
        slopes[k + 1] += width / range * along * (1.0 - 0.5 * along);
        slopes[k + 2] += width / range * 0.5 * along * along;
    }
    return slopes;
}

double SmoothResponse::at(const Slopes& basis) const {
    return std::inner_product(basis.begin(), basis.end(), slopes_.begin(), 0.0);
}

double SmoothResponse::mean(double size) const {
    return at(basis(size));
}

double SmoothResponse::scatter(double size) const {
    return sigma_ * std::pow(size / middle_, growth_);
}

double SmoothResponse::distance(double size, double threshold, double side) const {
    return side * (mean(size) - threshold) / scatter(size);
}

// Weighted least squares with slopes to one side: the best of all choices of slopes that are zero.
void SmoothResponse::fit_mean(const std::vector<Slopes>& bases, const std::vector<double>& values,
                              const std::vector<double>& weights, double side) {
    constexpr int kAll = kNodes + 1;
    Eigen::Matrix<double, kAll, kAll> normal = Eigen::Matrix<double, kAll, kAll>::Zero();
    Eigen::Matrix<double, kAll, 1> right = Eigen::Matrix<double, kAll, 1>::Zero();
    for (std::size_t i = 0; i < bases.size(); ++i) {
        const Eigen::Map<const Eigen::Matrix<double, kAll, 1>> row(bases[i].data());
        normal += weights[i] * row * row.transpose();
        right += weights[i] * values[i] * row;
    }
    double best = -std::numeric_limits<double>::infinity();
    for (int used = 0; used < 1 << kNodes; ++used) {
        std::vector<int> columns{0};
        for (int k = 0; k < kNodes; ++k) {
            if ((used >> k & 1) != 0) {
                columns.push_back(k + 1);
            }
        }
        const Eigen::VectorXd found =
            Eigen::MatrixXd(normal(columns, columns)).ldlt().solve(right(columns));
        const double gain = found.dot(right(columns));
        const auto slopes = found.tail(found.size() - 1);
        if (found.allFinite() && gain > best && (side * slopes.array() >= 0.0).all()) {
            best = gain;
            slopes_.fill(0.0);
            for (std::size_t c = 0; c < columns.size(); ++c) {
                slopes_[static_cast<std::size_t>(columns[c])] = found[static_cast<Eigen::Index>(c)];
            }
            active_ = static_cast<int>(columns.size());
        }
    }
}

// Newton's method for ln sigma and the growth, given the mean.
void SmoothResponse::fit_scatter(const ResponseRows& rows, const std::vector<Slopes>& bases) {
    constexpr int kSteps = 20;
    const std::size_t n = rows.size.size();
    std::vector<double> squares(n), x(n);
    double scale = 0.0;
    for (std::size_t i = 0; i < n; ++i) {
        squares[i] = std::pow(rows.value[i] - at(bases[i]), 2);
        x[i] = std::log(rows.size[i] / middle_);
        scale += squares[i];
    }
    scale /= static_cast<double>(n);
    double log_sigma = sigma_ > 0.0 ? std::log(sigma_) : 0.5 * std::log(scale);
    for (int step = 0; step < kSteps; ++step) {
        Eigen::Vector2d score = Eigen::Vector2d::Zero();
        Eigen::Matrix2d information = Eigen::Matrix2d::Zero();
        for (std::size_t i = 0; i < n; ++i) {
            const double z = squares[i] * std::exp(-2.0 * (log_sigma + growth_ * x[i]));
            const Eigen::Vector2d row(1.0, x[i]);
            score += (z - 1.0) * row;
            information += 2.0 * std::max(z, 1e-3) * row * row.transpose();
        }
        const Eigen::Vector2d move = information.ldlt().solve(score);
        log_sigma += std::clamp(move[0], -1.0, 1.0);
        growth_ =
            std::clamp(growth_ + std::clamp(move[1], -1.0, 1.0), -kSteepestGrowth, kSteepestGrowth);
        if (move.cwiseAbs().maxCoeff() < 1e-9) {
            break;
        }
    }
    sigma_ = std::exp(log_sigma);
}

void SmoothResponse::fit(const ResponseRows& rows, double side) {
    constexpr int kRounds = 40;
    std::vector<Slopes> bases;
    for (const double size : rows.size) {
        bases.push_back(basis(size));
    }
    std::vector<double> weights(rows.size.size(), 1.0);
    sigma_ = growth_ = 0.0;
    for (int round = 0; round < kRounds; ++round) {
        const double before = sigma_, grown = growth_;
        fit_mean(bases, rows.value, weights, side);
        fit_scatter(rows, bases);
        for (std::size_t i = 0; i < weights.size(); ++i) {
            weights[i] = std::pow(rows.size[i] / middle_, -2.0 * growth_);
        }
        if (std::abs(sigma_ - before) < 1e-7 * sigma_ && std::abs(growth_ - grown) < 1e-7) {
            break;
        }
    }
}

std::vector<double> SmoothResponse::standardised(const ResponseRows& rows) const {
    std::vector<double> z;
    for (std::size_t i = 0; i < rows.size.size(); ++i) {
        z.push_back((rows.value[i] - mean(rows.size[i])) / scatter(rows.size[i]));
    }
    return z;
}

void SmoothResponse::check(const ResponseRows& rows) {
    const std::vector<double> z = standardised(rows);
    if (!(sigma_ > 0.0) || !std::isfinite(growth_) || active_ < 2) {
        refusal_ = "the responses do not move to the alarm side as the flaw grows";
        return;
    }
    correlation_ = intraclass_correlation(rows, z);
    // Means of specimens, because values of one specimen are not independent.
    std::vector<double> x, means;
    for (const auto& [specimen, lines] : by_specimen(rows)) {
        double sum = 0.0;
        for (const std::size_t i : lines) {
            sum += z[i];
        }
        const auto count = static_cast<double>(lines.size());
        x.push_back(rows.size[lines.front()]);
        means.push_back(sum / std::sqrt(count * (1.0 + (count - 1.0) * correlation_)));
    }
    normality_ = normality_check(x, means, regression_line(x, means)).p_value;
    if (!(normality_ >= kCheckLevel)) {
        refusal_ =
            fmt::format("the residuals of a curve are not normal either (p = {:.2g})", normality_);
    }
}

void SmoothResponse::add_bounds(const ResponseRows& rows, double threshold, double side,
                                double confidence) {
    const double shares[] = {0.5, 0.9};
    std::vector<double> sizes(kSizes);
    for (int i = 0; i < kSizes; ++i) {
        sizes[static_cast<std::size_t>(i)] =
            std::lerp(smallest(), largest(), static_cast<double>(i) / (kSizes - 1));
    }
    // Maximum likelihood underestimates the scatter, as the mean follows the values.
    const auto specimens = by_specimen(rows);
    const auto n = static_cast<double>(rows.size.size());
    const double repeats = n / static_cast<double>(specimens.size());
    const double independent = n / (1.0 + (repeats - 1.0) * correlation_);
    const double widened = sigma_ * std::sqrt(independent / (independent - active_));
    SmoothResponse truth = *this;
    truth.sigma_ = widened;

    std::mt19937_64 engine(20230417);
    const auto normal = [&] {
        return link_quantile(Link::probit, (static_cast<double>(engine() >> 11) + 0.5) * 0x1p-53);
    };
    std::vector<double> errors[2][kSizes], at_threshold[kSizes];
    SmoothResponse again;
    again.nodes_ = nodes_;
    again.middle_ = middle_;
    ResponseRows drawn = rows;
    for (int table = 0; table < kTables; ++table) {
        for (const auto& [specimen, lines] : specimens) {
            const double shared = std::sqrt(correlation_) * normal();
            for (const std::size_t i : lines) {
                const double e = shared + std::sqrt(1.0 - correlation_) * normal();
                drawn.value[i] = mean(rows.size[i]) + truth.scatter(rows.size[i]) * e;
            }
        }
        again.fit(drawn, side);
        for (std::size_t p = 0; p < 2; ++p) {
            const double u = link_quantile(Link::probit, shares[p]);
            for (std::size_t i = 0; i < kSizes; ++i) {
                const double x = mean(sizes[i]) - side * u * truth.scatter(sizes[i]);
                const double error = again.distance(sizes[i], x, side) - u;
                if (std::isfinite(error)) {
                    errors[p][i].push_back(error);
                }
            }
        }
        for (std::size_t i = 0; i < kSizes; ++i) {
            const double error = again.distance(sizes[i], threshold, side) -
                                 truth.distance(sizes[i], threshold, side);
            if (std::isfinite(error)) {
                at_threshold[i].push_back(error);
            }
        }
    }
    for (std::size_t i = 0; i < kSizes; ++i) {
        const double found = distance(sizes[i], threshold, side);
        const auto pod_at = [&](double error) {
            return link_probability(Link::probit, found - error);
        };
        band_.push_back({sizes[i], pod_at(0.0), pod_at(quantile_of(at_threshold[i], confidence)),
                         pod_at(quantile_of(at_threshold[i], 1.0 - confidence))});
    }
    for (std::size_t p = 0; p < 2; ++p) {
        const double u = link_quantile(Link::probit, shares[p]);
        std::vector<double> found(kSizes), low(kSizes), high(kSizes);
        for (std::size_t i = 0; i < kSizes; ++i) {
            found[i] = distance(sizes[i], threshold, side) - u;
            low[i] = found[i] - quantile_of(errors[p][i], confidence);
            high[i] = found[i] - quantile_of(errors[p][i], 1.0 - confidence);
        }
        SizeBounds& bounds = p == 0 ? a50_ : a90_;
        bounds = {last_rise(sizes, found), last_rise(sizes, high), last_rise(sizes, low)};
    }
}

}  // namespace gearpod::analysis
