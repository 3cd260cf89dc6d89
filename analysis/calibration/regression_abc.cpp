#include "analysis/calibration/regression_abc.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include "analysis/statistics/rank_statistics.hpp"
#include "machine/upper_median.hpp"

namespace gearpod::analysis {
namespace {

using Matrix = Eigen::MatrixXd;
using Vector = Eigen::VectorXd;
using Rows =
    Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>;

constexpr int kFolds = 5;

// Robust centre and scale of each summary over the samples, so that summaries are of order 1.
// Outliers are clipped; otherwise their squares would dominate the regression.
class Scaling {
  public:
    explicit Scaling(const Matrix& summaries)
        : centre_(summaries.cols()), scale_(summaries.cols()) {
        for (Eigen::Index k = 0; k < summaries.cols(); ++k) {
            std::vector<double> values(summaries.col(k).begin(), summaries.col(k).end());
            centre_(k) = machine::upper_median(values);
            for (double& value : values) {
                value = std::abs(value - centre_(k));
            }
            const double deviation = 1.4826 * machine::upper_median(std::move(values));
            scale_(k) = deviation > 0.0 ? 1.0 / deviation : 0.0;
        }
    }
    // Design row: 1, the summaries, and with `squares` their squares.
    Vector row(const Vector& summary, bool squares) const {
        constexpr double kFar = 5.0;
        const Vector scaled = ((summary - centre_).array() * scale_.array()).max(-kFar).min(kFar);
        Vector row(1 + (squares ? 2 : 1) * scaled.size());
        row(0) = 1.0;
        row.segment(1, scaled.size()) = scaled;
        if (squares) {
            row.tail(scaled.size()) = scaled.array().square();
        }
        return row;
    }

  private:
    Vector centre_, scale_;
};

Matrix ridge_fit(const Matrix& design, const Matrix& response, const Vector& weight, double ridge) {
    Matrix normal = design.transpose() * weight.asDiagonal() * design;
    normal.diagonal().tail(normal.rows() - 1).array() += ridge * weight.sum();
    return normal.ldlt().solve(design.transpose() * weight.asDiagonal() * response);
}

// Conditional mean of each parameter given the summaries: for the samples, and for the observation.
struct Means {
    Matrix samples;
    Vector observed;
};

Means conditional_means(const AbcSamples& samples, const Matrix& unit, const Matrix& summaries,
                        const Vector& observed) {
    const Scaling scaling(summaries);
    const std::size_t groups = 1 + *std::max_element(samples.group.begin(), samples.group.end());
    constexpr std::size_t kSamplesPerCoefficient = 5;
    const bool squares =
        std::min(groups, samples.size()) > kSamplesPerCoefficient * (2 * samples.summaries + 1);
    const Vector centre = scaling.row(observed, squares);
    Matrix design(summaries.rows(), centre.size());
    for (Eigen::Index i = 0; i < summaries.rows(); ++i) {
        design.row(i) = scaling.row(summaries.row(i).transpose(), squares).transpose();
    }
    constexpr double kRidge = 1e-3;
    Means means{Matrix::Zero(unit.rows(), unit.cols()), Vector::Zero(unit.cols())};
    for (int fold = 0; fold < kFolds; ++fold) {
        Vector weight(unit.rows());
        for (Eigen::Index i = 0; i < unit.rows(); ++i) {
            const bool held_out = samples.group[static_cast<std::size_t>(i)] % kFolds ==
                                  static_cast<std::size_t>(fold);
            weight(i) = held_out ? 0.0 : 1.0;
        }
        const Matrix fit = ridge_fit(design, unit, weight, kRidge);
        for (Eigen::Index i = 0; i < unit.rows(); ++i) {
            if (weight(i) == 0.0) {
                means.samples.row(i) = design.row(i) * fit;
            }
        }
        means.observed += fit.transpose() * centre / kFolds;
    }
    return means;
}

// Keeps the nearest samples with Epanechnikov weights.
void keep_nearest(const Means& means, double share, AbcPosterior& posterior) {
    const Vector distance = (means.samples.rowwise() - means.observed.transpose()).rowwise().norm();
    std::vector<std::size_t> order(static_cast<std::size_t>(distance.size()));
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        return distance(static_cast<Eigen::Index>(a)) < distance(static_cast<Eigen::Index>(b));
    });
    const auto needed = static_cast<std::size_t>(share * static_cast<double>(order.size()));
    const std::size_t kept = std::clamp<std::size_t>(needed, 1, order.size() - 1);
    const double reach = distance(static_cast<Eigen::Index>(order[kept]));
    for (std::size_t i = 0; i < kept; ++i) {
        const double near = distance(static_cast<Eigen::Index>(order[i]));
        const double weight = reach > 0.0 ? 1.0 - near * near / (reach * reach) : 1.0;
        if (weight > 0.0) {
            posterior.draw.push_back(order[i]);
            posterior.weight.push_back(weight);
        }
    }
    const double sum = std::accumulate(posterior.weight.begin(), posterior.weight.end(), 0.0);
    for (double& weight : posterior.weight) {
        weight /= sum;
    }
}

double logit(double u) {
    constexpr double kEdge = 1e-6;
    const double inside = std::clamp(u, kEdge, 1.0 - kEdge);
    return std::log(inside / (1.0 - inside));
}

// Adjusts the samples kept to the observation.
void adjust(const Means& means, const Matrix& unit, AbcPosterior& posterior) {
    const auto kept = static_cast<Eigen::Index>(posterior.draw.size());
    const Eigen::Index parameters = unit.cols();
    Matrix design(kept, parameters + 1), logits(kept, parameters);
    Vector weight(kept);
    for (Eigen::Index i = 0; i < kept; ++i) {
        const auto row = static_cast<Eigen::Index>(posterior.draw[static_cast<std::size_t>(i)]);
        design(i, 0) = 1.0;
        design.row(i).tail(parameters) = means.samples.row(row) - means.observed.transpose();
        logits.row(i) = unit.row(row).unaryExpr(&logit);
        weight(i) = posterior.weight[static_cast<std::size_t>(i)];
    }
    constexpr double kRidge = 1e-6;
    const Matrix line = ridge_fit(design, logits, weight, kRidge);
    const Matrix residual = logits - design * line;
    constexpr double kLeast = 1e-12;
    const Matrix spread = (residual.array().square() + kLeast).log();
    const Matrix fit = ridge_fit(design, spread, weight, kRidge);
    const Matrix fitted = design * fit;
    posterior.unit.resize(static_cast<std::size_t>(kept * parameters));
    for (Eigen::Index i = 0; i < kept; ++i) {
        for (Eigen::Index p = 0; p < parameters; ++p) {
            // Half of the difference of log squares is the log ratio of the spreads, limited to a
            // safe extrapolation.
            const double scale = std::exp(std::clamp(0.5 * (fit(0, p) - fitted(i, p)), -1.0, 1.0));
            const double moved = line(0, p) + scale * residual(i, p);
            posterior.unit[static_cast<std::size_t>(i * parameters + p)] =
                1.0 / (1.0 + std::exp(-moved));
        }
    }
}

std::vector<double> ranks_of(const Vector& values) {
    return midranks({values.data(), static_cast<std::size_t>(values.size())});
}

void correlate(const Matrix& unit, const Matrix& summaries, AbcPosterior& posterior) {
    const auto ranks = [&](const Matrix& all, Eigen::Index column) {
        Vector values(static_cast<Eigen::Index>(posterior.draw.size()));
        for (Eigen::Index i = 0; i < values.size(); ++i) {
            values(i) =
                all(static_cast<Eigen::Index>(posterior.draw[static_cast<std::size_t>(i)]), column);
        }
        const std::vector<double> rank = ranks_of(values);
        Vector centred = Eigen::Map<const Vector>(rank.data(), values.size());
        centred.array() -= centred.mean();
        const double norm = centred.norm();
        return norm > 0.0 ? Vector(centred / norm) : centred;
    };
    std::vector<Vector> of_summary;
    for (Eigen::Index k = 0; k < summaries.cols(); ++k) {
        of_summary.push_back(ranks(summaries, k));
    }
    for (Eigen::Index p = 0; p < unit.cols(); ++p) {
        const Vector ranked = ranks(unit, p);
        for (const Vector& summary : of_summary) {
            posterior.correlation.push_back(ranked.dot(summary));
        }
    }
}

}  // namespace

AbcPosterior regression_abc(const AbcSamples& samples, std::span<const double> observed,
                            double share) {
    constexpr std::size_t kFewest = 10;
    if (samples.unit.size() != samples.size() * samples.parameters ||
        samples.summary.size() != samples.size() * samples.summaries ||
        observed.size() != samples.summaries || samples.parameters == 0 || samples.summaries == 0) {
        throw std::invalid_argument("abc: samples and observation differ in shape");
    }
    if (samples.size() < kFewest * samples.parameters) {
        throw std::invalid_argument("abc: fewer than ten samples per parameter");
    }
    const auto count = static_cast<Eigen::Index>(samples.size());
    const Matrix unit =
        Rows(samples.unit.data(), count, static_cast<Eigen::Index>(samples.parameters));
    const Matrix summaries =
        Rows(samples.summary.data(), count, static_cast<Eigen::Index>(samples.summaries));
    const Vector at =
        Eigen::Map<const Vector>(observed.data(), static_cast<Eigen::Index>(observed.size()));
    const Means means = conditional_means(samples, unit, summaries, at);
    AbcPosterior posterior;
    keep_nearest(means, share, posterior);
    adjust(means, unit, posterior);
    correlate(unit, summaries, posterior);
    return posterior;
}

double weighted_quantile(std::span<const double> values, std::span<const double> weights,
                         double probability) {
    std::vector<std::size_t> order(values.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return values[a] < values[b]; });
    double below = 0.0, before = 0.0;
    for (std::size_t i = 0; i < order.size(); ++i) {
        const double middle = below + 0.5 * weights[order[i]];
        if (middle >= probability) {
            if (i == 0) {
                return values[order[0]];
            }
            const double part = (probability - before) / (middle - before);
            return values[order[i - 1]] + part * (values[order[i]] - values[order[i - 1]]);
        }
        before = middle;
        below += weights[order[i]];
    }
    return values[order.back()];
}

}  // namespace gearpod::analysis
