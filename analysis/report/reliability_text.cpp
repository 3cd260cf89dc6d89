#include "analysis/report/reliability_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "analysis/report/false_alarm_text.hpp"
#include "analysis/report/robustness_text.hpp"
#include "analysis/report/text_lines.hpp"
#include "analysis/smallest_fault.hpp"

namespace gearpod::analysis {
namespace {

constexpr long kFewestReported = 10;  // fewest healthy and faulty gearboxes for a report

std::string auc_text(const Auc& auc) {
    if (std::isnan(auc.auc)) {
        return "-";
    }
    return std::isnan(auc.bounds.lower) ? fmt::format("{:.3f}", auc.auc)
                                        : fmt::format("{:.3f} [{:.3f}, {:.3f}]", auc.auc,
                                                      auc.bounds.lower, auc.bounds.upper);
}

// Features in order of rank, those without a rank last.
std::vector<const FeatureReliability*> in_order(const Reliability& reliability, std::size_t level) {
    std::vector<const FeatureReliability*> order;
    for (const std::size_t f : in_rank_order(reliability, level)) {
        order.push_back(&reliability.features[f]);
    }
    return order;
}

std::string fit_note(const HitMissPod& pod) {
    const GoodnessOfFit& fit = pod.chosen.fit;
    if (fit.test == GoodnessOfFit::Test::none) {
        return "fit not testable";
    }
    return fmt::format("fit p {:.2g}{}", fit.p_value, pod.doubtful ? " (rejected)" : "");
}

void add_feature(std::string& out, const FeatureReliability& feature, std::size_t n,
                 std::size_t name_width, const SizeUnit& unit) {
    const LevelReliability& level = feature.levels[n];
    const HitMissPod& pod = level.hit_miss;
    std::string row = fmt::format("{:<{}}{:<22}", feature.feature, name_width, auc_text(level.auc));
    if (pod.refusal.empty()) {
        const auto text = [&](const SizeEstimate& estimate) {
            return size_estimate_text(estimate, pod.smallest, pod.largest, unit);
        };
        row +=
            fmt::format("{:>8}{:>8}{:>8}  {}; {}", text(pod.a50.estimate), text(pod.a90.estimate),
                        text(pod.a90.upper), form_text(pod.chosen.curve.form), fit_note(pod));
        if (pod.chosen.curve.form.free_ceiling) {
            const std::string fitted = "ceiling fitted";
            row.replace(row.find(fitted), fitted.size(),
                        fmt::format("ceiling {:.3g}", pod.chosen.curve.ceiling));
        }
    } else {
        row += "  no curve: " + pod.refusal;
    }
    add_wrapped(out, row, name_width + 22);
}

// Adds the uncertainty from epistemic inputs, separate from that of the number of gearboxes.
void add_uncertain(std::string& out, const std::vector<const FeatureReliability*>& features,
                   std::size_t n, const SizeUnit& unit) {
    std::string list;
    const std::vector<std::string>* inputs = nullptr;
    for (const FeatureReliability* feature : features) {
        const LevelReliability& level = feature->levels[n];
        if (level.uncertain.inputs.empty() || !level.uncertain.refusal.empty()) {
            continue;
        }
        inputs = &level.uncertain.inputs;
        const auto text = [&](const SizeEstimate& estimate) {
            return size_estimate_text(estimate, level.hit_miss.smallest, level.hit_miss.largest,
                                      unit);
        };
        list += fmt::format("{} {} {} to {}", list.empty() ? "" : ";", feature->feature,
                            text(level.uncertain.a90_low), text(level.uncertain.a90_high));
    }
    if (inputs != nullptr) {
        add_wrapped(
            out,
            fmt::format("UNKNOWN properties of the machine, which more gearboxes do not resolve: "
                        "{}. Over the middle 90 % of their possible values, a90{} is{}",
                        fmt::join(*inputs, ", "),
                        unit.shown_unit().empty() ? "" : " in " + unit.shown_unit(), list),
            4);
    }
}

void add_signal_response(std::string& out, const std::vector<const FeatureReliability*>& features,
                         std::size_t n, const SizeUnit& unit) {
    std::string refused;
    for (const FeatureReliability* feature : features) {
        const SignalResponsePod& pod = feature->levels[n].signal_response;
        if (!pod.refusal.empty()) {
            refused += (refused.empty() ? "" : ", ") + feature->feature;
            continue;
        }
        const SignalResponseFit& fit = pod.candidates[pod.chosen];
        const auto text = [&](const SizeEstimate& estimate) {
            return size_estimate_text(estimate, pod.band.front().size, pod.band.back().size, unit);
        };
        add_wrapped(out,
                    fmt::format("a-hat against a: {} ({}): a50 {}, a90 {}, upper bound {}",
                                feature->feature, fit.scale.text(), text(pod.a50.estimate),
                                text(pod.a90.estimate), text(pod.a90.upper)),
                    4);
    }
    if (!refused.empty()) {
        add_wrapped(out, "a-hat against a refused (reasons in the JSON): " + refused, 4);
    }
}

void add_ranking(std::string& out, const FeatureRanking& ranking) {
    if (!ranking.refusal.empty()) {
        add_wrapped(out, "no ranking: " + ranking.refusal, 4);
    } else if (ranking.ranks.size() > 1) {
        std::string same;
        for (std::size_t i = 1; i < ranking.ranks.size(); ++i) {
            if (!(ranking.ranks.front().p_values[i] < kTestLevel)) {
                same += (same.empty() ? "" : ", ") + ranking.ranks[i].name;
            }
        }
        add_wrapped(
            out,
            same.empty()
                ? fmt::format("{} has the largest AUC, significantly larger than all others",
                              ranking.ranks.front().name)
                : fmt::format("{} has the largest AUC, not significantly larger than: {}",
                              ranking.ranks.front().name, same),
            4);
    }
    for (const std::string& line : ranking.left_out) {
        add_wrapped(out, "not ranked: " + line, 4);
    }
}

// Adds false alarms of the best ranked feature, and of the feature with the least expected cost.
void add_false_alarms(std::string& out, const std::vector<const FeatureReliability*>& features,
                      std::size_t n, const DetectionRequest& request) {
    if (!features.empty()) {
        const FeatureReliability& best = *features.front();
        const LevelReliability& level = best.levels[n];
        add_wrapped(out,
                    false_alarm_text(best.feature, level.by_rate,
                                     {level.hit_miss.smallest, level.hit_miss.largest},
                                     request.size, request.confidence),
                    4);
    }
    const FeatureReliability* cheapest = nullptr;
    for (const FeatureReliability* feature : features) {
        const auto& own = feature->levels[n].least_cost;
        if (own && (cheapest == nullptr || own->cost < cheapest->levels[n].least_cost->cost)) {
            cheapest = feature;
        }
    }
    if (cheapest != nullptr) {
        add_wrapped(
            out,
            least_cost_text(cheapest->feature, *cheapest->levels[n].least_cost, request.confidence),
            4);
    }
}

void add_misses(std::string& out, const FeatureReliability& feature, std::size_t n,
                const SizeUnit& unit) {
    const MissSensitivity& misses = feature.levels[n].misses;
    if (!misses.refusal.empty()) {
        return;
    }
    const std::string range = range_text({misses.smallest, misses.largest}, unit);
    std::string text = fmt::format(
        "misses of {} at {} ({} of {}), probability that a missed gearbox has the larger",
        feature.feature, range, misses.misses, misses.misses + misses.hits);
    bool any = false;
    for (const InputInfluence& input : misses.inputs) {
        if (input.p_value < kTestLevel) {
            text += fmt::format("{} {} {:.2f} [{:.2f}, {:.2f}]", any ? "," : "", input.name,
                                input.larger_in_misses, input.bounds.lower, input.bounds.upper);
            any = true;
        }
    }
    add_wrapped(
        out,
        any ? text
            : fmt::format("misses of {} ({} of {}): no random input has a significant influence",
                          feature.feature, misses.misses, misses.misses + misses.hits),
        4);
}

std::string basis_text(const SmallestFault& least) {
    const std::string tested =
        least.from_curve ? "" : "demonstrated at a tested size, no curve fits";
    if (least.own) {
        return tested.empty() ? "" : " (" + tested + ")";
    }
    return fmt::format(" (from {} at noise x {:g}, which finds no more faults of any size{})",
                       least.source.feature, least.source.noise_level,
                       tested.empty() ? "" : "; " + tested);
}

// Number of features without a threshold at the level, whose detection is therefore unknown; "" if
// all have one.
std::string no_threshold_text(const Reliability& reliability, std::size_t n) {
    const auto silent = std::ranges::count_if(
        reliability.features,
        [&](const FeatureReliability& feature) { return !feature.levels[n].has_threshold; });
    return silent == 0
               ? ""
               : fmt::format(
                     "; {} of the {} features {} no threshold, so their detection is unknown",
                     silent, reliability.features.size(), silent == 1 ? "has" : "have");
}

void add_unsized_level(std::string& out, const Reliability& reliability, std::size_t n) {
    const auto features = in_order(reliability, n);
    std::size_t width = 8;
    for (const FeatureReliability* feature : features) {
        width = std::max(width, feature->feature.size() + 2);
    }
    out += fmt::format("{:<{}}AUC\n", "feature", width);
    for (const FeatureReliability* feature : features) {
        out += fmt::format("{:<{}}{}\n", feature->feature, width, auc_text(feature->levels[n].auc));
    }
    add_ranking(out, reliability.rankings[n]);
}

void add_level(std::string& out, const Reliability& reliability, std::size_t n,
               const DetectionRequest& request, Subject subject) {
    const SizeUnit& unit = request.size;
    const double percent = 100.0 * request.confidence;
    if (subject == Subject::gearboxes) {
        out += fmt::format("\nNoise x {:g}\n", request.noise_levels[n]);
    }
    if (!has_sizes(request)) {
        return add_unsized_level(out, reliability, n);
    }
    if (const auto least = smallest_fault(reliability, n)) {
        add_wrapped(
            out,
            fmt::format("smallest fault found with 90 % probability at {:g} % confidence: {} "
                        "by {}{}",
                        percent, with_unit(least->size, unit), least->feature, basis_text(*least)),
            4);
    } else if (without_threshold(reliability, n)) {
        out += "no threshold, so detection is unknown\n";
    } else {
        add_wrapped(
            out,
            fmt::format("no tested fault is found with 90 % probability at {:g} % confidence{}",
                        percent, no_threshold_text(reliability, n)),
            4);
    }
    const auto features = in_order(reliability, n);
    std::size_t width = 8;
    for (const FeatureReliability* feature : features) {
        width = std::max(width, feature->feature.size() + 2);
    }
    out += fmt::format("{:<{}}{:<22}{:>8}{:>8}{:>8}  POD curve\n", "feature", width, "AUC", "a50",
                       "a90", fmt::format("a90/{:g}", percent));
    for (const FeatureReliability* feature : features) {
        add_feature(out, *feature, n, width, unit);
    }
    add_uncertain(out, features, n, unit);
    add_ranking(out, reliability.rankings[n]);
    add_signal_response(out, features, n, unit);
    add_false_alarms(out, features, n, request);
    for (const FeatureReliability* feature : features) {
        add_misses(out, *feature, n, unit);
    }
    out += robustness_text(reliability, n, request);
}

// Gearboxes of the feature and noise level that have the most.
struct Sample {
    long healthy = 0, faulty = 0;
};

Sample largest_sample(const Reliability& reliability) {
    Sample sample;
    for (const FeatureReliability& feature : reliability.features) {
        for (const LevelReliability& level : feature.levels) {
            sample.healthy = std::max(sample.healthy, level.auc.healthy);
            sample.faulty = std::max(sample.faulty, level.auc.faulty);
        }
    }
    return sample;
}

// Description of the figures at all levels.
std::string figures_text(const DetectionRequest& request) {
    const double percent = 100.0 * request.confidence;
    if (!has_sizes(request)) {
        return fmt::format(
            "Area under the ROC, healthy against faulty, with DeLong's interval at "
            "{:g} %",
            percent);
    }
    const std::string unit = request.size.shown_unit();
    return fmt::format(
        "Probability of detection over {}{}: sizes with POD 50 % and 90 %, and "
        "the latter's upper bound, one-sided at {:g} % (likelihood ratio); AUC "
        "with DeLong's interval at {:g} %",
        request.size.name, unit.empty() ? "" : ", shown in " + unit, percent, percent);
}

void add_levels(std::string& out, const Reliability& reliability, const DetectionRequest& request,
                Subject subject) {
    const Sample sample = largest_sample(reliability);
    if (std::min(sample.healthy, sample.faulty) < kFewestReported) {
        add_wrapped(out,
                    fmt::format("no POD curves, areas and ranking: only {} healthy and {} faulty "
                                "{} have values, {} of each are needed",
                                sample.healthy, sample.faulty, many(subject), kFewestReported),
                    4);
        return;
    }
    add_wrapped(out, figures_text(request), 0);
    for (std::size_t n = 0; n < request.noise_levels.size(); ++n) {
        add_level(out, reliability, n, request, subject);
    }
}

void add_condition(std::string& out, const ConditionDetection& detection, const SizeUnit& unit) {
    for (const ConditionLevel& level : detection.levels) {
        std::string text =
            fmt::format("{}, noise x {:g}: thresholds", detection.feature, level.noise_level);
        for (const ConditionThreshold& threshold : level.thresholds) {
            text += std::isnan(threshold.threshold)
                        ? fmt::format(" {:g}: none;", threshold.condition)
                        : fmt::format(" {:g}: {:.5g};", threshold.condition, threshold.threshold);
        }
        text += " Pd";
        for (const DetectionCell& cell : level.cells) {
            if (cell.tested > 0) {
                text +=
                    fmt::format(" {:.4g}: {:.2f} [{:.2f}, {:.2f}]",
                                cell.size.high / unit.per_unit(), cell.pd, cell.lower, cell.upper);
            }
        }
        add_wrapped(out, text, 4);
    }
    for (const std::string& warning : detection.warnings) {
        add_wrapped(out, fmt::format("warning: {} ({})", warning, detection.feature), 4);
    }
}

}  // namespace

std::string reliability_text(const Reliability& reliability, const DetectionRequest& request,
                             Subject subject) {
    if (reliability.features.empty() || request.noise_levels.empty()) {
        return "no POD curves: no features or no noise levels\n";
    }
    std::string out;
    add_levels(out, reliability, request, subject);
    if (!reliability.conditions.empty()) {
        out += fmt::format("\nThresholds by {} ({})\n", reliability.conditions.front().input,
                           reliability.conditions.front().unit);
        std::string refusal;
        for (const ConditionDetection& detection : reliability.conditions) {
            if (!detection.refusal.empty()) {
                refusal = detection.refusal;  // reason from the input, so the same for all features
                continue;
            }
            add_condition(out, detection, request.size);
        }
        if (!refusal.empty()) {
            add_wrapped(out, "none: " + refusal, 4);
        }
    }
    return out;
}

}  // namespace gearpod::analysis
