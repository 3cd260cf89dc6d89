#include "mc/recordings/calibration/calibrate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include "analysis/calibration/regression_abc.hpp"
#include "analysis/statistics/every_nth.hpp"
#include "analysis/statistics/rank_statistics.hpp"
#include "mc/files/input/terminal_text.hpp"

namespace gearpod::mc {
namespace {

constexpr double kAcceptedShare = 0.2;  // fraction of the simulated sets that ABC accepts

// Simulated sets whose parameters lie inside a region, with parameters relative to it.
struct SetsInRegion {
    analysis::AbcSamples abc;
    std::vector<const SimulatedSet*> sets;
};

SetsInRegion sets_in_region(const PriorRegion& region, std::span<const SimulatedSet> sets,
                            std::size_t summaries) {
    SetsInRegion in_region;
    in_region.abc.parameters = region.low.size();
    in_region.abc.summaries = summaries;
    for (const SimulatedSet& set : sets) {
        bool inside = !set.summary.empty();
        for (std::size_t p = 0; p < region.low.size(); ++p) {
            inside = inside && set.unit[p] >= region.low[p] && set.unit[p] <= region.high[p];
        }
        if (!inside) {
            continue;
        }
        for (std::size_t p = 0; p < region.low.size(); ++p) {
            in_region.abc.unit.push_back((set.unit[p] - region.low[p]) /
                                         (region.high[p] - region.low[p]));
        }
        in_region.abc.summary.insert(in_region.abc.summary.end(), set.summary.begin(),
                                     set.summary.end());
        in_region.abc.group.push_back(set.integration);
        in_region.sets.push_back(&set);
    }
    return in_region;
}

// Posterior sample of parameter p, given in a region, as quantiles of the prior.
std::vector<double> in_prior(const analysis::AbcPosterior& posterior, const PriorRegion& region,
                             std::size_t p) {
    std::vector<double> values = analysis::every_nth(posterior.unit, p, region.low.size());
    for (double& value : values) {
        value = region.low[p] + value * (region.high[p] - region.low[p]);
    }
    return values;
}

// Range of the posterior, extended by half its width on both sides.
PriorRegion narrowed(const analysis::AbcPosterior& posterior, const PriorRegion& region) {
    constexpr double kTail = 0.005;
    PriorRegion next = region;
    for (std::size_t p = 0; p < region.low.size(); ++p) {
        const auto values = in_prior(posterior, region, p);
        const double low = analysis::weighted_quantile(values, posterior.weight, kTail);
        const double high = analysis::weighted_quantile(values, posterior.weight, 1.0 - kTail);
        constexpr double kMargin = 0.5, kLeast = 0.01;
        const double margin = kMargin * (high - low) + kLeast;
        next.low[p] = std::max(region.low[p], low - margin);
        next.high[p] = std::min(region.high[p], high + margin);
    }
    return next;
}

InputPosterior found_input(const CalibratedInput& input, std::span<const double> values,
                           std::span<const double> weights) {
    constexpr double kTail = 0.05, kInformedRatio = 0.8;
    InputPosterior found;
    found.input = input;
    const double low = analysis::weighted_quantile(values, weights, kTail);
    const double high = analysis::weighted_quantile(values, weights, 1.0 - kTail);
    found.median = input.at(analysis::weighted_quantile(values, weights, 0.5));
    found.low = input.at(low);
    found.high = input.at(high);
    found.width_ratio = (high - low) / (1.0 - 2.0 * kTail);
    found.is_informed = found.width_ratio < kInformedRatio;
    return found;
}

// Indices of `count` equally likely members that represent a weighted sample: those at equidistant
// values of the cumulative weight.
std::vector<std::size_t> equally_likely(std::span<const double> weights, std::size_t count) {
    std::vector<std::size_t> members;
    double cumulated = weights.front();
    for (std::size_t i = 0, member = 0; i < count; ++i) {
        const double target = (static_cast<double>(i) + 0.5) / static_cast<double>(count);
        while (cumulated < target && member + 1 < weights.size()) {
            cumulated += weights[++member];
        }
        members.push_back(member);
    }
    return members;
}

std::vector<std::string> strongest_summaries(const analysis::AbcPosterior& posterior, std::size_t p,
                                             const SetSummary& summary) {
    constexpr std::size_t kNamed = 3;
    constexpr double kWeak = 0.3;
    const std::size_t count = summary.names().size();
    std::vector<std::size_t> order(count);
    std::iota(order.begin(), order.end(), std::size_t{0});
    const auto strength = [&](std::size_t k) {
        return std::abs(posterior.correlation[p * count + k]);
    };
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return strength(a) > strength(b); });
    std::vector<std::string> names;
    for (const std::size_t k : order) {
        if (names.size() < kNamed && strength(k) >= kWeak) {
            names.push_back(fmt::format("{} ({:+.2f})", summary.names()[k],
                                        posterior.correlation[p * count + k]));
        }
    }
    return names;
}

double rank_correlation(const std::vector<double>& a, const std::vector<double>& b) {
    const auto x = analysis::midranks(a), y = analysis::midranks(b);
    const double middle = 0.5 * (static_cast<double>(a.size()) + 1.0);
    double xy = 0.0, xx = 0.0, yy = 0.0;
    for (std::size_t i = 0; i < x.size(); ++i) {
        xy += (x[i] - middle) * (y[i] - middle);
        xx += (x[i] - middle) * (x[i] - middle);
        yy += (y[i] - middle) * (y[i] - middle);
    }
    return xx > 0.0 && yy > 0.0 ? xy / std::sqrt(xx * yy) : 0.0;
}

std::vector<CorrelatedPair> correlated_pairs(const std::vector<std::vector<double>>& posterior) {
    constexpr double kBound = 0.7;
    std::vector<CorrelatedPair> pairs;
    for (std::size_t a = 0; a < posterior.size(); ++a) {
        for (std::size_t b = a + 1; b < posterior.size(); ++b) {
            const double correlation = rank_correlation(posterior[a], posterior[b]);
            if (std::abs(correlation) > kBound) {
                pairs.push_back({a, b, correlation});
            }
        }
    }
    return pairs;
}

std::vector<FeatureCheck> checks(const analysis::AbcPosterior& posterior,
                                 const SetsInRegion& in_region, const SetSummary& summary,
                                 std::span<const double> observed) {
    constexpr double kTail = 0.01;
    std::vector<FeatureCheck> all;
    for (std::size_t k = 0; summary.is_mean(k) && k < observed.size(); ++k) {
        std::vector<double> values;
        for (const std::size_t draw : posterior.draw) {
            values.push_back(in_region.sets[draw]->summary[k]);
        }
        const features::Feature& feature = *summary.features()[k];
        all.push_back(
            {std::string(feature.name), std::string(feature.unit), summary.in_unit(k, observed[k]),
             summary.in_unit(k, analysis::weighted_quantile(values, posterior.weight, kTail)),
             summary.in_unit(k,
                             analysis::weighted_quantile(values, posterior.weight, 1.0 - kTail))});
    }
    return all;
}

void check_count(const SetsInRegion& in_region, std::size_t of, std::size_t inputs) {
    constexpr std::size_t kFewest = 50;
    if (in_region.sets.size() < kFewest * inputs) {
        throw std::runtime_error(
            fmt::format("only {} of {} simulated sets have all features, but at least {} are "
                        "needed; raise --draws, or use a prior for which the gearboxes work",
                        in_region.sets.size(), of, kFewest * inputs));
    }
}

}  // namespace

CalibrationResult calibrate(const CalibrationTask& task, const SetSummary& summary,
                            std::vector<SimulatedSet>& first, const SimulateRound& simulate) {
    const std::size_t inputs = task.inputs.size();
    const PriorRegion prior{std::vector<double>(inputs, 0.0), std::vector<double>(inputs, 1.0)};
    const std::vector<double> observed = summary.of(task.measured);
    if (first.empty()) {
        first = simulate(prior, {task.integrated, task.backgrounds, 0});
    }
    const std::size_t summaries = summary.names().size();
    const SetsInRegion coarse = sets_in_region(prior, first, summaries);
    check_count(coarse, first.size(), inputs);
    const PriorRegion region =
        narrowed(analysis::regression_abc(coarse.abc, observed, kAcceptedShare), prior);

    std::vector<SimulatedSet> sets =
        simulate(region, {task.integrated, task.backgrounds, task.integrated});
    sets.insert(sets.end(), first.begin(), first.end());
    const SetsInRegion fine = sets_in_region(region, sets, summaries);
    check_count(fine, sets.size(), inputs);
    const analysis::AbcPosterior posterior =
        analysis::regression_abc(fine.abc, observed, kAcceptedShare);

    CalibrationResult result;
    result.sets = sets.size();
    result.failed = static_cast<std::size_t>(
        std::ranges::count_if(sets, [](const SimulatedSet& set) { return set.summary.empty(); }));
    std::vector<std::vector<double>> samples;
    for (std::size_t p = 0; p < inputs; ++p) {
        samples.push_back(in_prior(posterior, region, p));
        result.found.push_back(found_input(task.inputs[p], samples.back(), posterior.weight));
        result.found.back().strongest_summaries = strongest_summaries(posterior, p, summary);
    }
    constexpr std::size_t kSamples = 200;
    const std::vector<std::size_t> members = equally_likely(posterior.weight, kSamples);
    for (std::size_t p = 0; p < inputs; ++p) {
        result.samples.emplace_back();
        for (const std::size_t member : members) {
            result.samples.back().push_back(
                task.inputs[p].at(std::clamp(samples[p][member], 0.0, 1.0)));
        }
    }
    result.pairs = correlated_pairs(samples);
    result.checks = checks(posterior, fine, summary, observed);
    return result;
}

// Implements calibrated_study().

namespace {

// TOML text of an empirical distribution whose inputs are drawn jointly, row by row. This keeps the
// correlations between inputs that the calibration found.
std::string distribution_of(const std::vector<double>& samples) {
    std::string values;
    for (const double value : samples) {
        values += fmt::format("{}{:.5g}", values.empty() ? "" : ", ", value);
    }
    return fmt::format("{{ distribution = \"empirical\", rows = 1, values = [{}] }}", values);
}

std::string comment_of(const CalibrationResult& result, std::size_t p) {
    const InputPosterior& found = result.found[p];
    std::string text =
        fmt::format("# median {:.4g}, 90 % interval {:.4g} to {:.4g} (prior {:g} to {:g}{})",
                    found.median, found.low, found.high, found.input.low, found.input.high,
                    found.input.logarithmic ? ", log" : "");
    text += found.is_informed ? "\n" : ": THE RECORDINGS DO NOT DETERMINE IT, this is the prior\n";
    if (found.is_informed && !found.strongest_summaries.empty()) {
        text +=
            fmt::format("# most correlated with {}\n", fmt::join(found.strongest_summaries, ", "));
    }
    for (const CorrelatedPair& pair : result.pairs) {
        if (pair.first == p || pair.second == p) {
            const std::size_t other = pair.first == p ? pair.second : pair.first;
            text += fmt::format(
                "# determined only together with {}, rank correlation {:+.2f}: sampled in rows\n",
                result.found[other].input.key, pair.correlation);
        }
    }
    return text;
}

}  // namespace

std::string calibrated_study(std::string study, const CalibrationResult& result,
                             const std::vector<std::string>& intro) {
    std::string out;
    for (const std::string& line : intro) {
        out += "# " + line + "\n";
    }
    std::string found;
    for (std::size_t p = 0; p < result.found.size(); ++p) {
        found += comment_of(result, p);
        found +=
            fmt::format("{} = {}\n", result.found[p].input.key, distribution_of(result.samples[p]));
    }
    const std::string section = "[random]\n";
    const std::size_t random = study.find("\n" + section);
    if (random == std::string::npos) {
        const std::size_t features = study.find("\n[features]");
        study.insert(features == std::string::npos ? study.size() : features,
                     "\n" + section + found);
    } else {
        study.insert(random + 1 + section.size(), found);
    }
    return out + study;
}

std::vector<std::string> calibration_intro(std::uint64_t seed, const HealthySet& set,
                                           const CalibrationResult& result) {
    std::vector<std::string> lines{
        fmt::format("Calibrated to {} record(s) of {} healthy gearbox(es) by approximate",
                    set.records, set.lengths.size()),
        fmt::format("Bayesian computation: {} simulated sets ({} failed), seed {}.", result.sets,
                    result.failed, seed),
        "Each distribution is the uncertainty of one value, the same for all gearboxes.",
        "A run with this study includes that uncertainty."};
    for (const FeatureCheck& check : result.checks) {
        if (check.outside()) {
            lines.push_back(fmt::format("NOT REPRODUCED: {} {:.4g}, simulated {:.4g} to {:.4g}",
                                        check.name, check.measured, check.low, check.high));
        }
    }
    return lines;
}

std::string calibration_text(const CalibrationResult& result) {
    std::string text =
        fmt::format("{:<36}{:>11}{:>11}{:>11}{:>8}\n", "input", "median", "5 %", "95 %", "width");
    for (const InputPosterior& posterior : result.found) {
        const std::string source =
            posterior.is_informed
                ? fmt::format("determined by {}", fmt::join(posterior.strongest_summaries, ", "))
                : "NOT DETERMINED by the recordings: this is the prior";
        text += fmt::format("{:<36}{:>11.4g}{:>11.4g}{:>11.4g}{:>6.0f} %\n    {}\n",
                            posterior.input.key, posterior.median, posterior.low, posterior.high,
                            100.0 * posterior.width_ratio, wrapped_text(source, 4));
    }
    for (const CorrelatedPair& pair : result.pairs) {
        const std::string both =
            fmt::format("{} and {} are only determined jointly, rank correlation {:+.2f}",
                        result.found[pair.first].input.key, result.found[pair.second].input.key,
                        pair.correlation);
        text += fmt::format("{}\n", wrapped_text(both, 2));
    }
    text += fmt::format(
        "width: width of the 90 % interval divided by that of the prior\n"
        "determined by: features that determine the input, with their rank "
        "correlations\n\n{:<22}{:>12}{:>26}\n",
        "feature", "measured", "simulated, 98 %");
    for (const FeatureCheck& check : result.checks) {
        text +=
            fmt::format("{:<22}{:>12.5g}{:>13.5g} to{:>10.5g}  {}\n", check.name, check.measured,
                        check.low, check.high, check.outside() ? "NOT REPRODUCED" : "");
    }
    if (result.failed > 0) {
        text += fmt::format("{} of {} simulated sets have no features and were ignored\n",
                            result.failed, result.sets);
    }
    return text;
}

nlohmann::ordered_json calibration_json(const HealthySet& set, const CalibrationTask& task,
                                        const CalibrationResult& result) {
    nlohmann::ordered_json json;
    json["records"] = set.records;
    json["gearboxes"] = set.lengths.size();
    json["left_out"] = set.left_out;
    json["integrated_draws"] = kCalibrationRounds * task.integrated;
    json["simulated_sets"] = result.sets;
    json["failed_sets"] = result.failed;
    json["inputs"] = nlohmann::ordered_json::array();
    for (const InputPosterior& posterior : result.found) {
        json["inputs"].push_back({{"key", posterior.input.key},
                                  {"prior_low", posterior.input.low},
                                  {"prior_high", posterior.input.high},
                                  {"logarithmic", posterior.input.logarithmic},
                                  {"median", posterior.median},
                                  {"low", posterior.low},
                                  {"high", posterior.high},
                                  {"left", posterior.width_ratio},
                                  {"is_informed", posterior.is_informed},
                                  {"informed_by", posterior.strongest_summaries}});
    }
    json["together"] = nlohmann::ordered_json::array();
    for (const CorrelatedPair& pair : result.pairs) {
        json["together"].push_back({{"first", result.found[pair.first].input.key},
                                    {"second", result.found[pair.second].input.key},
                                    {"correlation", pair.correlation}});
    }
    json["features"] = nlohmann::ordered_json::array();
    for (const FeatureCheck& check : result.checks) {
        json["features"].push_back({{"name", check.name},
                                    {"measured", check.measured},
                                    {"low", check.low},
                                    {"high", check.high},
                                    {"reproduced", !check.outside()}});
    }
    return json;
}

}  // namespace gearpod::mc
