#include "analysis/report/robustness_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "analysis/report/text_lines.hpp"

namespace gearpod::analysis {
namespace {

constexpr double kNamedShare = 0.01;  // smallest share of the variance for which an input is named

std::string a90_text(const HeldOutDetector& detector, const SizeUnit& unit) {
    const HitMissPod& pod = detector.pod;
    if (!pod.refusal.empty()) {
        return "no curve";
    }
    return fmt::format("a90 {}, upper bound {}",
                       size_estimate_text(pod.a90.estimate, pod.smallest, pod.largest, unit),
                       size_estimate_text(pod.a90.upper, pod.smallest, pod.largest, unit));
}

void add_combined(std::string& out, const CombinedDetector& combined, const SizeUnit& unit) {
    if (!combined.refusal.empty()) {
        add_wrapped(out, "no combined detector: " + combined.refusal, 4);
        return;
    }
    std::vector<FeatureWeight> weights = combined.weights;
    std::stable_sort(weights.begin(), weights.end(), [](const auto& a, const auto& b) {
        return std::abs(a.weight) > std::abs(b.weight);
    });
    std::string list;
    for (const FeatureWeight& weight : weights) {
        list += fmt::format("{}{} {:.2f}", list.empty() ? "" : ", ", weight.name, weight.weight);
    }
    add_wrapped(
        out,
        fmt::format("combined detector, tested on the held-out half: AUC {:.3f} (gain {:+.3f} over "
                    "{}, {}), {}; {}: {}; weights {}",
                    combined.combined.auc.auc, combined.combined.auc.auc - combined.single.auc.auc,
                    combined.single.name,
                    std::isnan(combined.p_value) ? std::string("not testable")
                                                 : fmt::format("p {:.2g}", combined.p_value),
                    a90_text(combined.combined, unit), combined.single.name,
                    a90_text(combined.single, unit), list),
        4);
    for (const std::string& line : combined.left_out) {
        add_wrapped(out, "not combined: " + line, 4);
    }
}

std::string bin_text(const InputBin& bin) {
    return fmt::format("{:.2f} [{:.2f}, {:.2f}]", bin.pd, bin.bounds.lower, bin.bounds.upper);
}

void add_effects(std::string& out, const FeatureReliability& feature, const LevelReliability& level,
                 const SizeUnit& unit) {
    const InputEffects& effects = level.inputs;
    std::vector<const InputEffect*> significant;
    std::size_t width = 8;
    for (const InputEffect& effect : effects.inputs) {
        if (effect.p_value < kTestLevel && !effect.bins.empty()) {
            significant.push_back(&effect);
            width = std::max(width, effect.name.size() + 2);
        }
    }
    if (significant.empty()) {
        return;
    }
    std::stable_sort(significant.begin(), significant.end(),
                     [](const auto* a, const auto* b) { return a->statistic > b->statistic; });
    const std::string shown = unit.shown_unit();
    add_wrapped(out,
                fmt::format("{} by random input: Pd at {} in the lowest and highest fifth of each "
                            "significant input; a90{} at its 5, 50 and 95 % quantiles",
                            feature.feature, range_text({effects.smallest, effects.largest}, unit),
                            shown.empty() ? "" : " in " + shown),
                4);
    // Names are on separate lines, with p, if they and the numbers are too wide for one line.
    constexpr std::size_t kNumbers = 84;
    const bool apart = width + kNumbers > text_width();
    const auto row = [&](const std::string& name, const std::string& p, const auto&... numbers) {
        out += apart ? name + ", " + p + "\n" : fmt::format("{:<{}}", name, width);
        out += fmt::format("{:>9}{:>9}{:>18}{:>18}{:>9}{:>7}{:>7}", numbers...);
        out += apart ? "\n" : fmt::format("{:>7}\n", p);
    };
    row("input", "p", "from", "to", "Pd low", "Pd high", "a90 low", "middle", "high");
    const HitMissPod& pod = level.hit_miss;
    const auto a90 = [&](const SizeBounds& bounds) {
        return size_estimate_text(bounds.estimate, pod.smallest, pod.largest, unit);
    };
    for (const InputEffect* effect : significant) {
        const auto value = [](double number) { return fmt::format("{:.3g}", number); };
        row(effect->name, fmt::format("{:.1g}", effect->p_value),
            value(effect->bins.front().middle), value(effect->bins.back().middle),
            bin_text(effect->bins.front()), bin_text(effect->bins.back()), a90(effect->a90.front()),
            a90(effect->a90[effect->a90.size() / 2]), a90(effect->a90.back()));
    }
}

void add_sensitivity(std::string& out, const LevelSensitivity& sensitivity, const SizeUnit& unit) {
    const SobolIndices& misses = sensitivity.misses;
    if (sensitivity.feature.empty() || !misses.refusal.empty()) {
        return;
    }
    std::string list;
    for (const SobolIndex& index : misses.inputs) {
        if (index.first.bounds.lower > kNamedShare || index.total_bounds.lower > kNamedShare) {
            list += fmt::format("{} {} {:.2f} [{:.2f}, {:.2f}], total {:.2f} [{:.2f}, {:.2f}]",
                                list.empty() ? "" : ";", index.name, index.first.share,
                                index.first.bounds.lower, index.first.bounds.upper, index.total,
                                index.total_bounds.lower, index.total_bounds.upper);
        }
    }
    add_wrapped(
        out,
        fmt::format("share of the variance of {}'s misses at {} ({} gearboxes; Sobol indices, "
                    "first order and total):{}; all inputs {:.2f}, the rest is noise",
                    sensitivity.feature, range_text(sensitivity.sizes, unit), misses.count,
                    list.empty() ? " no input above 0.01" : list, misses.explained),
        4);
}

}  // namespace

std::string robustness_text(const Reliability& reliability, std::size_t level,
                            const DetectionRequest& request) {
    std::string out;
    add_combined(out, reliability.combined[level], request.size);
    const LevelSensitivity& sensitivity = reliability.sensitivities[level];
    for (const FeatureReliability& feature : reliability.features) {
        if (feature.feature == sensitivity.feature) {
            add_effects(out, feature, feature.levels[level], request.size);
        }
    }
    add_sensitivity(out, sensitivity, request.size);
    return out;
}

}  // namespace gearpod::analysis
