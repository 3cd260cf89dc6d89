#include "analysis/inputs/uncertain_inputs.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "analysis/statistics/binary_regression.hpp"

namespace gearpod::analysis {
namespace {

constexpr double kFound = 0.9;  // POD

// Standardises the columns of a design to mean 0 and standard deviation 1 and keeps the scales.
struct Standard {
    Eigen::RowVectorXd centre, spread;

    Eigen::MatrixXd operator()(const Eigen::MatrixXd& values) {
        centre = values.colwise().mean();
        const Eigen::MatrixXd away = values.rowwise() - centre;
        spread = (away.array().square().colwise().mean()).sqrt();
        return away.array().rowwise() / spread.array();
    }
};

struct Faulty {
    std::vector<double> sizes;
    std::vector<char> hits;
    Eigen::MatrixXd inputs;  // gearboxes x inputs
};

Faulty faulty_gearboxes(std::span<const double> sizes, std::span<const int> hit,
                        const std::vector<const InputColumn*>& inputs) {
    std::vector<std::size_t> rows;
    Faulty faulty;
    for (std::size_t i = 0; i < hit.size(); ++i) {
        if (hit[i] >= 0 && std::isfinite(sizes[i]) && sizes[i] > 0.0) {
            rows.push_back(i);
            faulty.sizes.push_back(sizes[i]);
            faulty.hits.push_back(hit[i] == 1 ? 1 : 0);
        }
    }
    faulty.inputs.resize(static_cast<Eigen::Index>(rows.size()),
                         static_cast<Eigen::Index>(inputs.size()));
    for (std::size_t c = 0; c < inputs.size(); ++c) {
        for (std::size_t r = 0; r < rows.size(); ++r) {
            faulty.inputs(static_cast<Eigen::Index>(r), static_cast<Eigen::Index>(c)) =
                inputs[c]->values[rows[r]];
        }
    }
    return faulty;
}

// The inputs and, for those with more than two values, their squares.
Eigen::MatrixXd covariates(const Eigen::MatrixXd& scaled) {
    Eigen::MatrixXd all(scaled.rows(), 2 * scaled.cols());
    Eigen::Index count = 0;
    for (Eigen::Index c = 0; c < scaled.cols(); ++c) {
        const auto column = scaled.col(c);
        all.col(count++) = column;
        if (std::set<double>(column.begin(), column.end()).size() > 2) {
            all.col(count++) = column.array().square();
        }
    }
    return all.leftCols(count);
}

double quantile(std::vector<double>& values, double share) {
    const auto at =
        static_cast<std::ptrdiff_t>(std::lround(share * static_cast<double>(values.size() - 1)));
    std::nth_element(values.begin(), values.begin() + at, values.end());
    return values[static_cast<std::size_t>(at)];
}

}  // namespace

EpistemicBand epistemic_band(std::span<const double> sizes, std::span<const int> hit,
                             const std::vector<InputColumn>& inputs, const HitMissPod& pod) {
    EpistemicBand result;
    std::vector<const InputColumn*> varying;
    for (const InputColumn& input : inputs) {
        if (varies(input.values)) {
            varying.push_back(&input);
            result.inputs.push_back(input.name);
        }
    }
    result.refusal = pod.refusal;
    if (varying.empty() || !result.refusal.empty()) {
        return result;
    }
    const Faulty faulty = faulty_gearboxes(sizes, hit, varying);
    const PodForm& form = pod.chosen.curve.form;
    const BinaryModel model{form.link, form.floor, pod.chosen.curve.ceiling};
    Eigen::MatrixXd x(static_cast<Eigen::Index>(faulty.sizes.size()), 1);
    for (Eigen::Index i = 0; i < x.rows(); ++i) {
        x(i, 0) = form.scaled(faulty.sizes[static_cast<std::size_t>(i)]);
    }
    Standard size_scale, input_scale;
    const Eigen::VectorXd u = size_scale(x).col(0);
    const Eigen::MatrixXd z = covariates(input_scale(faulty.inputs));
    Eigen::MatrixXd design(u.size(), 2 + z.cols());
    design << Eigen::VectorXd::Ones(u.size()), u, z;
    const BinaryFit fit = fit_binary(design, faulty.hits, model);
    result.refusal = fit.refusal;
    if (!result.refusal.empty()) {
        return result;
    }
    const double intercept = fit.coefficients[0], slope = fit.coefficients[1];
    const Eigen::VectorXd shift = z * fit.coefficients.tail(z.cols());
    const double target =
        kFound < model.ceiling
            ? link_quantile(model.link, (kFound - model.floor) / (model.ceiling - model.floor))
            : std::numeric_limits<double>::infinity();
    std::vector<double> a90, pods(static_cast<std::size_t>(shift.size()));
    for (const double offset : shift) {
        const double standardised = slope > 0.0 ? (target - intercept - offset) / slope
                                                : std::numeric_limits<double>::infinity();
        a90.push_back(std::isfinite(standardised)
                          ? form.size(size_scale.centre[0] + size_scale.spread[0] * standardised)
                          : std::numeric_limits<double>::infinity());
    }
    const auto estimate = [&](double share) {
        return estimate_within(quantile(a90, share), pod.smallest, pod.largest);
    };
    result.a90_low = estimate(kEpistemicQuantiles[0]);
    result.a90_high = estimate(kEpistemicQuantiles[1]);
    for (const PodPoint& point : pod.band) {
        const double eta = intercept + slope * (form.scaled(point.size) - size_scale.centre[0]) /
                                           size_scale.spread[0];
        for (std::size_t i = 0; i < pods.size(); ++i) {
            pods[i] = model.floor +
                      (model.ceiling - model.floor) *
                          link_probability(model.link, eta + shift[static_cast<Eigen::Index>(i)]);
        }
        result.band.push_back({point.size, quantile(pods, 0.5),
                               quantile(pods, kEpistemicQuantiles[0]),
                               quantile(pods, kEpistemicQuantiles[1])});
    }
    return result;
}

}  // namespace gearpod::analysis
