#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "analysis/report/findings/findings.hpp"
#include "analysis/report/wording.hpp"

namespace gearpod::analysis {
namespace {

std::string miss_count(const MissSensitivity& misses) {
    return fmt::format("{} of {}", misses.misses, misses.misses + misses.hits);
}

// Inputs of the missed gearboxes of every feature.
void add_misses(Section& section, const Findings& findings, std::size_t n) {
    for (const std::size_t f : findings.order[n]) {
        const MissSensitivity& misses = findings.reliable(f, n).misses;
        if (!misses.refusal.empty()) {
            continue;
        }
        section.state(fmt::format("misses.{}.{}", n, f), misses_text(findings, f, n));
        Table table{
            fmt::format("miss_inputs.{}.{}", n, f),
            fmt::format("{}{}, {}: {} missed", findings.name(f), findings.at_noise(n),
                        range_text({misses.smallest, misses.largest}, findings.request.size),
                        miss_count(misses)),
            {"input", "probability that missed is larger", "p, adjusted"},
            {},
            Shown::page};
        for (const InputInfluence& input : misses.inputs) {
            table.rows.push_back({input_name(input.name, input.unit),
                                  rate_text(input.larger_in_misses, input.bounds),
                                  p_text(input.p_value)});
        }
        section.add(std::move(table));
    }
}

// Inputs with bins in order of significance.
std::vector<const InputEffect*> effects_of(const InputEffects& effects) {
    std::vector<const InputEffect*> sorted;
    for (const InputEffect& effect : effects.inputs) {
        if (!effect.bins.empty()) {
            sorted.push_back(&effect);
        }
    }
    std::stable_sort(sorted.begin(), sorted.end(), [](const auto* a, const auto* b) {
        return !std::isnan(a->p_value) &&
               (std::isnan(b->p_value) || a->p_value < b->p_value ||
                (a->p_value == b->p_value && a->statistic > b->statistic));
    });
    return sorted;
}

std::string bin_text(const InputBin& bin) {
    return rate_text(bin.pd, bin.bounds);
}

// Detection at low and high values of each significant input.
Table effect_table(const Findings& findings, std::size_t f, std::size_t n) {
    const LevelReliability& level = findings.reliable(f, n);
    const SizeUnit& unit = findings.request.size;
    const std::string shown = unit.shown_unit();
    Table table{
        fmt::format("effects.{}", n),
        fmt::format("{} by random input{}: Pd at {} in the lowest and highest fifth of each "
                    "significant input; a90{} at its 5, 50 and 95 % quantiles",
                    findings.name(f), findings.at_noise(n),
                    range_text({level.inputs.smallest, level.inputs.largest}, unit),
                    shown.empty() ? "" : " in " + shown),
        {"input", "from", "to", "Pd low", "Pd high", "a90 low", "middle", "high", "p"},
        {}};
    const auto a90 = [&](const SizeBounds& bounds) {
        return findings.size(bounds.estimate, level.hit_miss);
    };
    for (const InputEffect* effect : effects_of(level.inputs)) {
        if (effect->p_value < kTestLevel) {
            const std::string unit_shown = quantity_unit(effect->unit);
            table.rows.push_back(
                {input_name(effect->name, effect->unit) +
                     (unit_shown.empty() ? "" : ", " + unit_shown),
                 number_text(effect->bins.front().middle), number_text(effect->bins.back().middle),
                 bin_text(effect->bins.front()), bin_text(effect->bins.back()),
                 a90(effect->a90.front()), a90(effect->a90[effect->a90.size() / 2]),
                 a90(effect->a90.back()), p_text(effect->p_value)});
        }
    }
    return table;
}

std::string effects_text(const Findings& findings, std::size_t f, std::size_t n) {
    std::vector<std::string> clear;
    const auto effects = effects_of(findings.reliable(f, n).inputs);
    for (const InputEffect* effect : effects) {
        if (effect->p_value < kTestLevel) {
            clear.push_back(input_name(effect->name, effect->unit));
        }
    }
    return effects.empty() ? ""
           : clear.empty() ? fmt::format(
                                 "The detection curve of {} does not change significantly "
                                 "with any input.",
                                 findings.name(f))
                           : fmt::format(
                                 "The detection curve of {} changes significantly with {} "
                                 "(likelihood ratio, 5 % for all inputs together).",
                                 findings.name(f), joined(clear));
}

// Rates in bins of every input.
void add_input_details(Section& section, const Findings& findings, std::size_t f, std::size_t n) {
    for (const InputEffect* effect : effects_of(findings.reliable(f, n).inputs)) {
        const std::string& unit = effect->unit;
        const std::string name = input_name(effect->name, unit);
        Table bins{"bins." + effect->name,
                   fmt::format("{}, {} ({})", findings.name(f), name,
                               std::isnan(effect->p_value)
                                   ? "no test: " + effect->refusal
                                   : fmt::format("p {}, adjusted", p_text(effect->p_value))),
                   {"input", "found", "detection rate"},
                   {},
                   Shown::page};
        for (const InputBin& bin : effect->bins) {
            bins.rows.push_back(
                {quantity_text(bin.low, unit) + " to " + quantity_text(bin.high, unit),
                 fmt::format("{} of {}", bin.detected, bin.tested), bin_text(bin)});
        }
        section.add(std::move(bins));
    }
}

}  // namespace

std::string misses_text(const Findings& findings, std::size_t feature, std::size_t level) {
    const MissSensitivity& misses = findings.reliable(feature, level).misses;
    if (!misses.refusal.empty()) {
        return "";
    }
    constexpr std::size_t kMostNamed = 3;
    std::vector<std::string> named;
    for (const InputInfluence& input : misses.inputs) {
        if (input.p_value < kTestLevel && named.size() < kMostNamed) {
            const bool larger = input.larger_in_misses >= 0.5;
            named.push_back(fmt::format(
                "{} {} ({} %{})", larger ? "larger" : "smaller", input_name(input.name, input.unit),
                number_text(
                    100.0 * (larger ? input.larger_in_misses : 1.0 - input.larger_in_misses), 2),
                named.empty() ? " of pairs, 50 % is chance" : ""));
        }
    }
    return fmt::format("Misses of {} at {} ({}): {}.", findings.name(feature),
                       range_text({misses.smallest, misses.largest}, findings.request.size),
                       miss_count(misses),
                       named.empty() ? "no random input has a significant influence"
                                     : fmt::format("the missed {} tends to have the {}",
                                                   singular(findings.subject), joined(named)));
}

Section inputs_section(const Findings& findings) {
    Section section{"inputs", "Influence of the inputs", {}};
    for (std::size_t n = 0; has_sizes(findings.request) && n < findings.levels(); ++n) {
        add_misses(section, findings, n);
        const std::size_t best = findings.best(n);
        section.state(fmt::format("effects_text.{}", n), effects_text(findings, best, n));
        section.add(effect_table(findings, best, n));
        if (n == findings.reference) {
            add_input_details(section, findings, best, n);
        }
    }
    return section;
}

}  // namespace gearpod::analysis
