#include "analysis/inputs/input_effects.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <numeric>
#include <set>

#include "analysis/statistics/binary_regression.hpp"
#include "analysis/statistics/distributions.hpp"
#include "analysis/statistics/link.hpp"
#include "analysis/statistics/rank_statistics.hpp"
#include "features/statistics/signal_statistics.hpp"
#include "machine/contracts.hpp"
#include "machine/no_value.hpp"

namespace gearpod::analysis {
namespace {

constexpr std::size_t kNeighbours = 100;
constexpr long kFewestOutcomes = 10;  // fewest misses, and hits, for the large-sample approximation

struct Stratum {
    std::vector<std::size_t> hits, misses;  // gearboxes
};

// Faulty gearboxes with a value, in strata of equal size or else of neighbouring sizes.
std::vector<Stratum> strata_of(std::span<const double> sizes, std::span<const int> hit) {
    std::vector<std::size_t> order;
    for (std::size_t i = 0; i < sizes.size(); ++i) {
        if (sizes[i] > 0.0 && hit[i] >= 0) {
            order.push_back(i);
        }
    }
    std::ranges::stable_sort(order,
                             [&](std::size_t a, std::size_t b) { return sizes[a] < sizes[b]; });
    std::vector<Stratum> strata;
    for (std::size_t first = 0; first < order.size();) {
        const auto equal = [&](std::size_t i) { return sizes[order[i]] == sizes[order[first]]; };
        std::size_t last = first;
        while (last < order.size() && (equal(last) || last - first < kNeighbours)) {
            if (!equal(last) && last > first + 1 && equal(first + 1)) {
                break;  // a repeated size is a stratum of its own
            }
            ++last;
        }
        Stratum stratum;
        for (std::size_t i = first; i < last; ++i) {
            (hit[order[i]] == 1 ? stratum.hits : stratum.misses).push_back(order[i]);
        }
        if (stratum.hits.size() >= 2 && stratum.misses.size() >= 2 &&
            stratum.hits.size() >= stratum.misses.size()) {
            strata.push_back(std::move(stratum));
        }
        first = last;
    }
    return strata;
}

std::vector<double> values_at(const InputColumn& input, const std::vector<std::size_t>& rows) {
    std::vector<double> values;
    for (const std::size_t row : rows) {
        values.push_back(input.values[row]);
    }
    return values;
}

bool varies(const InputColumn& input, const std::vector<Stratum>& strata) {
    const double first = input.values[strata.front().hits.front()];
    const auto differs = [&](std::size_t row) { return input.values[row] != first; };
    return std::ranges::any_of(strata, [&](const Stratum& stratum) {
        return std::ranges::any_of(stratum.hits, differs) ||
               std::ranges::any_of(stratum.misses, differs);
    });
}

InputInfluence influence(const InputColumn& input, const std::vector<Stratum>& strata,
                         double confidence) {
    double weights = 0.0, area = 0.0, variance = 0.0;
    long pairs = 0;
    for (const Stratum& stratum : strata) {
        const AucComponents components =
            auc_components(values_at(input, stratum.hits), values_at(input, stratum.misses));
        const auto m = static_cast<double>(stratum.hits.size());
        const auto n = static_cast<double>(stratum.misses.size());
        const double weight = m * n / (m + n + 1.0);
        weights += weight;
        area += weight * components.auc;
        variance += weight * weight * auc_covariance(components, components);
        pairs += static_cast<long>(std::min(stratum.hits.size(), stratum.misses.size()));
    }
    area /= weights;
    variance /= weights * weights;
    InputInfluence result{input.name, input.unit, area,
                          auc_interval(area, variance, pairs, confidence), 0.0};
    const double distance = std::abs(area - 0.5);
    result.p_value = variance > 0.0
                         ? 2.0 * link_probability(Link::probit, -distance / std::sqrt(variance))
                         : kNan;
    return result;
}

using Where = SizeEstimate::Where;
constexpr std::size_t kBins = 5;
constexpr std::size_t kFewValues = 9;  // an input with at most this many values has an a90 at each
constexpr double kReportedPod = 0.9;

// Faulty gearboxes with an outcome.
struct Outcomes {
    std::vector<std::size_t> rows;
    std::vector<double> sizes;
    std::vector<char> hits;

    Outcomes(std::span<const double> all_sizes, std::span<const int> hit) {
        for (std::size_t i = 0; i < hit.size(); ++i) {
            if (hit[i] >= 0 && std::isfinite(all_sizes[i]) && all_sizes[i] > 0.0) {
                rows.push_back(i);
                sizes.push_back(all_sizes[i]);
                hits.push_back(hit[i] == 1 ? 1 : 0);
            }
        }
    }
};

std::vector<double> sorted(std::vector<double> values) {
    std::ranges::sort(values);
    return values;
}

std::vector<InputBin> bins_of(const std::vector<double>& values, const Outcomes& outcomes,
                              const SizeGroup& range, double confidence) {
    std::vector<double> inside;
    std::vector<char> hits;
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (in_range(outcomes.sizes[i], range)) {
            inside.push_back(values[i]);
            hits.push_back(outcomes.hits[i]);
        }
    }
    const InputBins bins = equal_count_bins(inside, kBins);
    std::vector<std::vector<double>> members(bins.bins);
    std::vector<InputBin> result(bins.bins);
    for (std::size_t i = 0; i < inside.size(); ++i) {
        members[bins.of[i]].push_back(inside[i]);
        result[bins.of[i]].detected += hits[i];
    }
    for (std::size_t b = 0; b < bins.bins; ++b) {
        InputBin& bin = result[b];
        const std::vector<double> ascending = sorted(members[b]);
        bin.low = ascending.front();
        bin.high = ascending.back();
        bin.middle = features::median(ascending);
        bin.tested = static_cast<long>(ascending.size());
        bin.pd = static_cast<double>(bin.detected) / static_cast<double>(bin.tested);
        bin.bounds = wilson_interval(bin.detected, bin.tested, confidence);
    }
    return result;
}

// Standardisation of a covariate to mean 0 and standard deviation 1.
struct Scale {
    double centre = 0.0, spread = 1.0;

    explicit Scale(const Eigen::VectorXd& values) : centre(values.mean()) {
        spread = std::sqrt((values.array() - centre).square().mean());
    }
    double operator()(double value) const { return (value - centre) / spread; }
    double back(double scaled) const { return centre + spread * scaled; }
};

Eigen::VectorXd scaled_sizes(const Outcomes& outcomes, const PodForm& form) {
    Eigen::VectorXd x(static_cast<Eigen::Index>(outcomes.sizes.size()));
    for (Eigen::Index i = 0; i < x.size(); ++i) {
        x[i] = form.scaled(outcomes.sizes[static_cast<std::size_t>(i)]);
    }
    return x;
}

// Curve of all gearboxes with one input as a covariate.
struct CovariateCurve {
    const PodForm& form;
    Scale size, input;
    BinaryFit fit;
    double target = 0.0;  // eta at POD 0.9

    // Size at which the POD is 0.9, for a value of the input.
    SizeBounds a90(double value, double smallest, double largest, double confidence) const {
        const Eigen::VectorXd& b = fit.coefficients;
        const double z = input(value);
        Eigen::VectorXd level = Eigen::VectorXd::Zero(b.size());  // eta(u) = b . (level + u e_1)
        level[0] = 1.0;
        level[2] = z;
        if (b.size() > 3) {
            level[3] = z * z;
        }
        const double slope = b[1];
        const double away = b.dot(level) - target;  // eta - target at u = 0
        const auto estimate = [&](double u) {
            return estimate_within(form.size(size.back(u)), smallest, largest);
        };
        if (!(slope > 0.0)) {
            const SizeEstimate never{Where::not_reached, kNan};
            return {never, {Where::below_tested, kNan}, never};
        }
        const double q = link_quantile(Link::probit, confidence);
        const double v_level = level.dot(fit.covariance * level);
        const double v_cross = level.dot(fit.covariance.col(1));
        const double v_slope = fit.covariance(1, 1);
        // (away + slope u)^2 = q^2 var(away + slope u)
        const double a = slope * slope - q * q * v_slope;
        const double half = away * slope - q * q * v_cross;
        const double c = away * away - q * q * v_level;
        SizeBounds bounds{estimate(-away / slope), {Where::below_tested, kNan}, {}};
        bounds.upper = {Where::not_reached, kNan};
        if (a > 0.0) {
            const double root = std::sqrt(std::max(0.0, half * half - a * c));
            bounds.lower = estimate((-half - root) / a);
            bounds.upper = estimate((-half + root) / a);
        }
        return bounds;
    }
};

Eigen::MatrixXd design_of(const Eigen::VectorXd& x, const Scale& size, const Eigen::VectorXd& z,
                          const Scale& input, int powers) {
    Eigen::MatrixXd design(x.size(), 2 + powers);
    for (Eigen::Index i = 0; i < x.size(); ++i) {
        design(i, 0) = 1.0;
        design(i, 1) = size(x[i]);
        for (int p = 0; p < powers; ++p) {
            design(i, 2 + p) = p == 0 ? input(z[i]) : input(z[i]) * input(z[i]);
        }
    }
    return design;
}

std::vector<double> quantiles_of(const std::vector<double>& ascending) {
    std::vector<double> values(ascending);
    values.erase(std::unique(values.begin(), values.end()), values.end());
    if (values.size() <= kFewValues) {
        return values;
    }
    std::vector<double> out;
    for (const double share : kInputQuantiles) {
        const double position = share * static_cast<double>(ascending.size() - 1);
        const auto below = static_cast<std::size_t>(position);
        const double rest = position - static_cast<double>(below);
        const std::size_t above = std::min(below + 1, ascending.size() - 1);
        out.push_back((1.0 - rest) * ascending[below] + rest * ascending[above]);
    }
    return out;
}

// Computes the test and a90 of one input.
void fit_input(InputEffect& effect, const std::vector<double>& values, const Outcomes& outcomes,
               const Eigen::VectorXd& x, const HitMissPod& pod, const BinaryFit& without,
               const OutcomeCurve& model, double confidence) {
    effect.statistic = effect.p_value = kNan;
    const std::vector<double> ascending = sorted(values);
    effect.values = quantiles_of(ascending);
    effect.refusal = !pod.refusal.empty() ? pod.refusal : without.refusal;
    if (!effect.refusal.empty()) {
        return;
    }
    const Eigen::VectorXd z =
        Eigen::VectorXd::Map(values.data(), static_cast<Eigen::Index>(values.size()));
    const int powers = effect.values.size() > 2 ? 2 : 1;
    CovariateCurve curve{pod.chosen.curve.form, Scale(x), Scale(z), {}, 0.0};
    curve.fit = fit_binary(design_of(x, curve.size, z, curve.input, powers), outcomes.hits, model,
                           without.coefficients);
    effect.refusal = curve.fit.refusal;
    if (!effect.refusal.empty()) {
        return;
    }
    effect.degrees = powers;
    effect.statistic = std::max(0.0, 2.0 * (curve.fit.log_likelihood - without.log_likelihood));
    effect.p_value = chi_squared_upper_tail(effect.statistic, powers);
    const bool reachable = kReportedPod < model.ceiling;
    curve.target = reachable ? link_quantile(model.link, (kReportedPod - model.floor) /
                                                             (model.ceiling - model.floor))
                             : 0.0;
    for (const double value : effect.values) {
        const SizeEstimate never{Where::not_reached, kNan};
        effect.a90.push_back(reachable ? curve.a90(value, pod.smallest, pod.largest, confidence)
                                       : SizeBounds{never, never, never});
    }
}

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

MissSensitivity miss_sensitivity(std::span<const double> sizes, std::span<const int> hit,
                                 const std::vector<InputColumn>& inputs, double confidence) {
    MissSensitivity result;
    const std::vector<Stratum> strata = strata_of(sizes, hit);
    if (strata.empty()) {
        result.refusal = "no fault size at which most, but not all gearboxes are detected";
        return result;
    }
    result.smallest = std::numeric_limits<double>::infinity();
    for (const Stratum& stratum : strata) {
        result.hits += static_cast<long>(stratum.hits.size());
        result.misses += static_cast<long>(stratum.misses.size());
        for (const auto* rows : {&stratum.hits, &stratum.misses}) {
            for (const std::size_t row : *rows) {
                result.smallest = std::min(result.smallest, sizes[row]);
                result.largest = std::max(result.largest, sizes[row]);
            }
        }
    }
    if (std::min(result.misses, result.hits) < kFewestOutcomes) {
        result.refusal = fmt::format("{} misses and {} hits, {} of each are needed", result.misses,
                                     result.hits, kFewestOutcomes);
        return result;
    }
    std::vector<double> p_values;
    for (const InputColumn& input : inputs) {
        if (!varies(input, strata)) {
            result.left_out.push_back(input.name);
            continue;
        }
        result.inputs.push_back(influence(input, strata, confidence));
        p_values.push_back(result.inputs.back().p_value);
    }
    p_values = holm_adjusted(p_values);
    for (std::size_t i = 0; i < result.inputs.size(); ++i) {
        result.inputs[i].p_value = p_values[i];
    }
    std::ranges::stable_sort(result.inputs, [](const InputInfluence& a, const InputInfluence& b) {
        return std::abs(a.larger_in_misses - 0.5) > std::abs(b.larger_in_misses - 0.5);
    });
    return result;
}

InputBins equal_count_bins(std::span<const double> values, std::size_t bins) {
    EXPECTS(std::ranges::all_of(values, [](double value) { return std::isfinite(value); }));
    std::vector<std::size_t> order(values.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::stable_sort(order,
                             [&](std::size_t a, std::size_t b) { return values[a] < values[b]; });
    std::size_t distinct = 0;
    for (std::size_t i = 0; i < order.size(); ++i) {
        distinct += i == 0 || values[order[i]] != values[order[i - 1]] ? 1 : 0;
    }
    const bool each = distinct <= bins;
    InputBins result;
    result.of.resize(values.size());
    std::size_t last_share = 0;
    for (std::size_t first = 0; first < order.size();) {
        std::size_t end = first;
        while (end < order.size() && values[order[end]] == values[order[first]]) {
            ++end;
        }
        // Equal values share the bin of the middle one.
        const std::size_t share = (first + end - 1) * bins / (2 * order.size());
        if (result.bins == 0 || each || share != last_share) {
            ++result.bins;
        }
        last_share = share;
        for (; first < end; ++first) {
            result.of[order[first]] = result.bins - 1;
        }
    }
    return result;
}

SizeGroup transition_sizes(const std::vector<DetectionCell>& cells) {
    constexpr double kRare = 0.1, kSure = 0.95;
    SizeGroup range{kNan, kNan}, nearest{kNan, kNan};
    double distance = std::numeric_limits<double>::infinity();
    for (const DetectionCell& cell : cells) {
        if (cell.size.high <= 0.0 || std::isnan(cell.pd)) {
            continue;
        }
        if (cell.pd >= kRare && cell.pd <= kSure) {
            range = {std::isnan(range.low) ? cell.size.low : range.low, cell.size.high};
        }
        if (std::abs(cell.pd - 0.5) < distance) {
            distance = std::abs(cell.pd - 0.5);
            nearest = cell.size;
        }
    }
    return std::isnan(range.low) ? nearest : range;
}

bool in_range(double size, const SizeGroup& range) {
    constexpr double kSameSize = 1e-9;
    return size >= range.low * (1.0 - kSameSize) && size <= range.high * (1.0 + kSameSize);
}

InputEffects input_effects(std::span<const double> sizes, std::span<const int> hit,
                           const std::vector<InputColumn>& inputs, const HitMissPod& pod,
                           const SizeGroup& range, double confidence) {
    InputEffects result{range.low, range.high, {}, {}};
    const Outcomes outcomes(sizes, hit);
    const PodForm& form = pod.chosen.curve.form;
    const OutcomeCurve model{form.link, form.floor, pod.chosen.curve.ceiling};
    Eigen::VectorXd x;
    BinaryFit without;
    if (pod.refusal.empty() && !outcomes.rows.empty()) {
        x = scaled_sizes(outcomes, form);
        without = fit_binary(design_of(x, Scale(x), x, Scale(x), 0), outcomes.hits, model);
    }
    std::vector<double> p_values;
    for (const InputColumn& input : inputs) {
        const std::vector<double> values = values_at(input, outcomes.rows);
        if (!varies(values)) {
            result.left_out.push_back(input.name);
            continue;
        }
        InputEffect effect;
        effect.name = input.name;
        effect.unit = input.unit;
        effect.bins = bins_of(values, outcomes, range, confidence);
        fit_input(effect, values, outcomes, x, pod, without, model, confidence);
        p_values.push_back(effect.p_value);
        result.inputs.push_back(std::move(effect));
    }
    p_values = holm_adjusted(p_values);
    for (std::size_t i = 0; i < result.inputs.size(); ++i) {
        result.inputs[i].p_value = p_values[i];
    }
    return result;
}

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
    const Outcomes outcomes(sizes, hit);
    Eigen::MatrixXd values(outcomes.rows.size(), varying.size());
    for (std::size_t c = 0; c < varying.size(); ++c) {
        const std::vector<double> column = values_at(*varying[c], outcomes.rows);
        values.col(static_cast<Eigen::Index>(c)) =
            Eigen::VectorXd::Map(column.data(), values.rows());
    }
    const PodForm& form = pod.chosen.curve.form;
    const OutcomeCurve model{form.link, form.floor, pod.chosen.curve.ceiling};
    Standard size_scale, input_scale;
    const Eigen::VectorXd u = size_scale(scaled_sizes(outcomes, form)).col(0);
    const Eigen::MatrixXd z = covariates(input_scale(values));
    Eigen::MatrixXd design(u.size(), 2 + z.cols());
    design << Eigen::VectorXd::Ones(u.size()), u, z;
    const BinaryFit fit = fit_binary(design, outcomes.hits, model);
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
