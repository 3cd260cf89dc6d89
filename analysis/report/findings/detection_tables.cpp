#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "analysis/detection/detection.hpp"
#include "analysis/report/findings/findings.hpp"
#include "analysis/report/wording.hpp"

namespace gearpod::analysis {
namespace {

std::string size_text(const SizeGroup& size, const SizeUnit& unit) {
    const std::string high = number_text(size.high / unit.per_unit(), 4);
    return size.low == size.high ? high
                                 : number_text(size.low / unit.per_unit(), 4) + " to " + high;
}

// At most `most` of the indices below `count`, evenly spread, with the first, the last and
// `needed`.
std::vector<std::size_t> spread(std::size_t count, std::size_t most, std::size_t needed) {
    std::vector<std::size_t> chosen;
    for (std::size_t i = 0; i < std::min(count, most); ++i) {
        chosen.push_back(count <= most ? i : i * (count - 1) / (most - 1));
    }
    if (std::ranges::count(chosen, needed) == 0 && count > 0) {
        *std::ranges::min_element(chosen.begin() + 1, chosen.end() - 1, {}, [&](std::size_t i) {
            return i < needed ? needed - i : i - needed;
        }) = needed;
    }
    return chosen;
}

template <typename Has>
bool any_feature(const Findings& findings, std::size_t level, Has has) {
    return std::ranges::any_of(findings.detection,
                               [&](const FeatureDetection& f) { return has(f.levels[level]); });
}

bool extrapolated(const LevelDetection& level) {
    return level.tail.has_value();
}

bool weighted(const LevelDetection& level) {
    return level.importance_sampled.has_value();
}

Table threshold_table(const Findings& findings, std::size_t n) {
    const bool tails = any_feature(findings, n, extrapolated);
    const bool weights = any_feature(findings, n, weighted);
    Table table{fmt::format("thresholds.{}", n),
                fmt::format("Alarm thresholds{}, for at most {} expected false alarms",
                            findings.at_noise(n), percent_text(findings.request.false_alarm_rate)),
                {"feature", "alarm if",
                 findings.subject == Subject::recordings  ? "healthy: alarms/recordings"
                 : findings.request.threshold_records > 1 ? "healthy: alarms/records"
                                                          : "healthy: alarms/gearboxes",
                 "false-alarm rate", "with healthy test " + plural(findings.subject)},
                {}};
    if (tails) {
        table.columns.insert(table.columns.end(), {"extrapolated", "values fitted"});
    }
    if (weights) {
        table.columns.emplace_back("importance sampling, gearboxes");
    }
    for (std::size_t f = 0; f < findings.detection.size(); ++f) {
        const FeatureDetection& feature = findings.detection[f];
        const LevelDetection& level = feature.levels[n];
        std::vector<std::string> row{
            feature.feature, findings.alarm_if(f, n, 5),
            fmt::format("{}/{}", level.threshold_alarms, level.threshold_sample),
            rate_interval_text(level.threshold_rate),
            rate_text(level.healthy_rate, level.healthy_rate_bounds)};
        if (tails) {
            const auto& tail = level.tail;
            row.push_back(tail ? number_text(tail->extrapolation, 2) + " times" : "no");
            row.push_back(tail ? fmt::format("{}", tail->choices.front().exceedances) : "-");
        }
        if (weights) {
            const auto& sampled = level.importance_sampled;
            row.push_back(
                sampled ? fmt::format("{:.0f} of {}", sampled->contributing, sampled->gearboxes)
                        : "no");
        }
        table.rows.push_back(std::move(row));
    }
    return table;
}

Table rate_table(const Findings& findings, std::size_t n) {
    const SizeUnit& unit = findings.request.size;
    const bool sized = has_sizes(findings.request);
    const std::string shown = unit.shown_unit();
    Table table{fmt::format("rates.{}", n),
                fmt::format("Detection rates Pd{} [lower, upper] at {} confidence (Wilson)",
                            findings.at_noise(n), findings.percent()),
                {!sized ? kNoSize : "size" + (shown.empty() ? "" : " " + shown),
                 plural(findings.subject), "not computed"},
                {}};
    table.labels = 3;
    for (const FeatureDetection& feature : findings.detection) {
        table.columns.push_back(feature.feature);
    }
    const std::vector<DetectionCell>& first = findings.detection.front().levels[n].cells;
    for (std::size_t c = 0; c < first.size(); ++c) {
        // Failures may differ between features: the row shows the largest number, the JSON all.
        long failed = 0;
        for (const FeatureDetection& feature : findings.detection) {
            failed = std::max(failed, feature.levels[n].cells[c].failed);
        }
        std::vector<std::string> row{sized ? size_text(first[c].size, unit) : "faulty",
                                     fmt::format("{}", first[c].tested + first[c].failed),
                                     fmt::format("{}", failed)};
        for (const FeatureDetection& feature : findings.detection) {
            const DetectionCell& cell = feature.levels[n].cells[c];
            row.push_back(rate_text(cell.pd, cell.lower, cell.upper));
        }
        table.rows.push_back(std::move(row));
    }
    return table;
}

// Every fit of the thresholds beyond the healthy sample.
Table tail_table(const Findings& findings) {
    Table table{"tails",
                "Extrapolated thresholds: how far, and results with fewer values",
                {"feature", "noise", "rarer than one in the sample", "values fitted",
                 "fitted above", "shape", "threshold", "expected rate of the threshold used"},
                {},
                Shown::page};
    for (const FeatureDetection& feature : findings.detection) {
        for (const LevelDetection& level : feature.levels) {
            for (const TailChoice& choice :
                 level.tail ? level.tail->choices : std::vector<TailChoice>{}) {
                table.rows.push_back({feature.feature, "x " + number_text(level.noise_level),
                                      number_text(level.tail->extrapolation, 2) + " times",
                                      fmt::format("{}", choice.exceedances),
                                      number_text(choice.above, 4), number_text(choice.shape, 2),
                                      number_text(choice.threshold, 4),
                                      number_text(choice.rate, 2)});
            }
        }
    }
    return table;
}

// States a warning shared by several features once.
void add_warnings(Section& section, const Findings& findings) {
    std::vector<std::string> order;
    std::map<std::string, std::vector<std::string>> features;
    for (const FeatureDetection& feature : findings.detection) {
        for (const std::string& warning : feature.warnings) {
            if (features[warning].empty()) {
                order.push_back(warning);
            }
            features[warning].push_back(feature.feature);
        }
    }
    for (const std::string& warning : order) {
        section.state(fmt::format("warning.{}", section.blocks.size()),
                      fmt::format("Warning: {} ({}).", warning, joined(features[warning])));
    }
}

std::string curve_text(const HitMissPod& pod) {
    std::string form = form_text(pod.chosen.curve.form);
    if (pod.chosen.curve.form.free_ceiling) {
        const std::string fitted = "ceiling fitted";
        form.replace(form.find(fitted), fitted.size(),
                     "ceiling " + number_text(pod.chosen.curve.ceiling));
    }
    return form + (pod.chosen.fit.test == GoodnessOfFit::Test::none
                       ? "; fit not testable"
                       : fmt::format("; fit p {}{}", p_text(pod.chosen.fit.p_value),
                                     pod.doubtful ? " (rejected)" : ""));
}

Table curve_table(const Findings& findings, std::size_t n) {
    const SizeUnit& unit = findings.request.size;
    Table table{
        fmt::format("curves.{}", n),
        has_sizes(findings.request)
            ? fmt::format("Probability of detection against {}{}: sizes with POD 50 % and 90 "
                          "%, and the latter's upper bound, one-sided at {} (likelihood "
                          "ratio); AUC with DeLong's interval at {}",
                          input_name(unit.name, unit.unit), findings.at_noise(n),
                          findings.percent(), findings.percent())
            : fmt::format("Area under the ROC, healthy against faulty, with DeLong's "
                          "interval at {}",
                          findings.percent()),
        {"feature", "AUC"},
        {}};
    if (has_sizes(findings.request)) {
        table.columns.insert(table.columns.end(), {in_unit("a50", unit), in_unit("a90", unit),
                                                   in_unit(findings.bound(), unit), "POD curve"});
    }
    for (const std::size_t f : findings.order[n]) {
        const LevelReliability& level = findings.reliable(f, n);
        const HitMissPod& pod = level.hit_miss;
        std::vector<std::string> row{findings.name(f), area_text(level.auc.auc, level.auc.bounds)};
        if (has_sizes(findings.request)) {
            const bool curve = pod.refusal.empty();
            row.push_back(curve ? findings.size(pod.a50.estimate, pod) : "-");
            row.push_back(curve ? findings.size(pod.a90.estimate, pod) : "-");
            row.push_back(curve ? findings.size(pod.a90.upper, pod) : "-");
            row.push_back(curve ? curve_text(pod) : "no curve, because " + pod.refusal);
        }
        table.rows.push_back(std::move(row));
    }
    return table;
}

std::string ranking_text(const Findings& findings, const FeatureRanking& ranking, std::size_t n) {
    if (!ranking.refusal.empty()) {
        return fmt::format("No ranking{}: {}.", findings.at_noise(n), ranking.refusal);
    }
    if (ranking.ranks.size() < 2) {
        return "";
    }
    std::vector<std::string> same;
    for (std::size_t i = 1; i < ranking.ranks.size(); ++i) {
        if (!(ranking.ranks.front().p_values[i] < kTestLevel)) {
            same.push_back(ranking.ranks[i].name);
        }
    }
    return fmt::format("{} has the largest area under the ROC, {}.", ranking.ranks.front().name,
                       same.empty() ? "significantly larger than all others"
                                    : "not significantly larger than " + joined(same));
}

void add_ranking(Section& section, const Findings& findings, std::size_t n) {
    const FeatureRanking& ranking = findings.reliability->rankings[n];
    section.state(fmt::format("ranking.{}", n), ranking_text(findings, ranking, n));
    Table table{fmt::format("ranks.{}", n),
                fmt::format("Ranking{}, {} healthy and {} faulty {}", findings.at_noise(n),
                            ranking.healthy, ranking.faulty, plural(findings.subject)),
                {"rank", "feature", "area", "p against the first"},
                {},
                Shown::page};
    for (std::size_t i = 0; i < ranking.ranks.size(); ++i) {
        const FeatureRank& rank = ranking.ranks[i];
        table.rows.push_back({fmt::format("{}", i + 1), rank.name,
                              area_text(rank.auc.auc, rank.auc.bounds),
                              i == 0 ? "" : p_text(ranking.ranks.front().p_values[i])});
    }
    section.add(std::move(table));
    for (std::size_t i = 0; i < ranking.left_out.size(); ++i) {
        section.state(fmt::format("unranked.{}.{}", n, i),
                      fmt::format("Not ranked: {}.", ranking.left_out[i]));
    }
}

void add_responses(Section& section, const Findings& findings, std::size_t n) {
    const SizeUnit& unit = findings.request.size;
    Table table{
        fmt::format("responses.{}", n),
        fmt::format("The feature itself over the size (a-hat against a){}", findings.at_noise(n)),
        {"feature", "scale", in_unit("a50", unit), in_unit("a90", unit),
         in_unit(findings.bound(), unit)},
        {}};
    std::vector<std::string> refused;
    for (const std::size_t f : findings.order[n]) {
        const SignalResponsePod& pod = findings.reliable(f, n).signal_response;
        if (!pod.refusal.empty()) {
            refused.push_back(findings.name(f));
            continue;
        }
        const auto text = [&](const SizeEstimate& estimate) {
            return size_estimate_text(estimate, pod.band.front().size, pod.band.back().size, unit);
        };
        table.rows.push_back({findings.name(f), pod.candidates[pod.chosen].scale.text(),
                              text(pod.a50.estimate), text(pod.a90.estimate), text(pod.a90.upper)});
    }
    section.add(std::move(table));
    section.state(fmt::format("responses_refused.{}", n),
                  refused.empty() ? ""
                                  : fmt::format("No curve of the feature itself over the size "
                                                "(a-hat against a){} for {}; reasons: report "
                                                "--json.",
                                                findings.at_noise(n), joined(refused)));
}

std::string beyond_text(double extrapolation, bool importance_sampled) {
    return extrapolation > 0.0 ? number_text(extrapolation, 2) + " times" +
                                     (importance_sampled ? ", by importance sampling" : "")
                               : "";
}

// a90 by false-alarm rate, for the best ranked features that have one; on the terminal at the
// reference level only.
void add_false_alarms(Section& section, const Findings& findings, std::size_t n) {
    constexpr int kMostFeatures = 3;
    const SizeUnit& unit = findings.request.size;
    Table table{fmt::format("false_alarms.{}", n),
                fmt::format("a90 by false-alarm rate{}, with bounds at {} that include the "
                            "uncertainty of the threshold; the healthy sample is too small for "
                            "rarer false alarms",
                            findings.at_noise(n), findings.percent()),
                {"feature", "false-alarm rate", "alarm beyond", "rarer than one in the sample",
                 in_unit("a90", unit), "lower bound", "upper bound"},
                {},
                n == findings.reference ? Shown::full : Shown::page,
                2};
    int features = 0;
    for (const std::size_t f : findings.order[n]) {
        const LevelReliability& level = findings.reliable(f, n);
        const auto& points = level.by_rate.points;
        if (features == kMostFeatures || std::ranges::none_of(points, [](const RatePoint& point) {
                return point.a90.estimate.where == SizeEstimate::Where::reached;
            })) {
            continue;
        }
        ++features;
        const auto text = [&](const SizeEstimate& estimate) {
            return findings.size(estimate, level.hit_miss);
        };
        for (const RatePoint& point : points) {
            table.rows.push_back({findings.name(f), number_text(point.false_alarm_rate),
                                  number_text(point.threshold, 4),
                                  beyond_text(point.extrapolation, point.importance_sampled),
                                  text(point.a90.estimate), text(point.a90.lower),
                                  text(point.a90.upper)});
        }
    }
    const std::size_t best = findings.order[n].front();
    const FalseAlarmCurve& curve = findings.reliable(best, n).by_rate;
    std::vector<std::string> unfitted;
    for (const double rate : curve.unfitted) {
        unfitted.push_back(number_text(rate));
    }
    section.state(fmt::format("no_false_alarms.{}", n),
                  !curve.refusal.empty() && features == 0
                      ? fmt::format("No a90 of {} by false-alarm rate: {}.", findings.name(best),
                                    curve.refusal)
                  : !unfitted.empty()
                      ? fmt::format("No curve of {} fits at a false-alarm rate of {}.",
                                    findings.name(best), joined(unfitted))
                      : "");
    section.add(std::move(table));
}

std::string condition_title(const Findings& findings, const ConditionDetection& detection,
                            const ConditionLevel& level, std::size_t n) {
    std::vector<std::string> thresholds;
    for (const ConditionThreshold& condition : level.thresholds) {
        thresholds.push_back(fmt::format(
            "{}: {}", quantity_text(condition.condition, detection.unit),
            std::isnan(condition.threshold)
                ? "none"
                : quantity_text(condition.threshold,
                                findings.unit(findings.feature(detection.feature)), 4)));
    }
    return fmt::format("{}{}; thresholds at {} {}", detection.feature, findings.at_noise(n),
                       input_name(detection.input, detection.unit), joined(thresholds));
}

}  // namespace

Table noise_table(const Findings& findings) {
    constexpr std::size_t kMostSizes = 7, kMostLevels = 4;
    const std::size_t shown = findings.tabled_level(), best = findings.best(shown);
    const bool noise = findings.subject == Subject::gearboxes, sized = has_sizes(findings.request);
    const auto& cells = findings.detection[best].levels.front().cells;
    std::vector<std::size_t> faulty;
    for (std::size_t c = 0; c < cells.size(); ++c) {
        if (cells[c].size.high > 0.0) {
            faulty.push_back(c);
        }
    }
    Table table{"rates_by_noise",
                "",
                {sized ? in_unit("size", findings.request.size) : ""},
                {},
                Shown::screen};
    const std::size_t sizes = faulty.size();
    const std::vector<std::size_t> levels =
        spread(findings.levels(), kMostLevels, findings.reference);
    table.title = fmt::format(
        "Alarms of {} in % with {} interval{}{}{}", findings.name(best), findings.percent(),
        best == findings.best(findings.reference) ? "" : ", best at " + findings.noise(shown),
        sizes > kMostSizes ? fmt::format("; {} of {} sizes", kMostSizes, sizes) : "",
        findings.levels() > kMostLevels
            ? fmt::format("; {} of {} noise levels", kMostLevels, findings.levels())
            : "");
    std::vector<std::string> healthy{"healthy"};
    for (const std::size_t n : levels) {
        const LevelDetection& level = findings.detection[best].levels[n];
        table.columns.push_back(noise ? "noise x " + number_text(level.noise_level) : "alarms");
        healthy.push_back(
            std::isnan(level.threshold)
                ? "no threshold"
                : percent_rate_text(findings.request.false_alarm_rate, level.threshold_rate));
    }
    table.rows.push_back(std::move(healthy));
    for (const std::size_t i : spread(sizes, kMostSizes, 0)) {
        const SizeGroup& size = cells[faulty[i]].size;
        std::vector<std::string> row{sized ? size_text(size, findings.request.size) : "faulty"};
        for (const std::size_t n : levels) {
            const DetectionCell& cell = findings.detection[best].levels[n].cells[faulty[i]];
            row.push_back(percent_rate_text(cell.pd, {cell.lower, cell.upper}));
        }
        table.rows.push_back(std::move(row));
    }
    return table;
}

Section thresholds_section(const Findings& findings) {
    Section section{"thresholds", "Thresholds", {}};
    for (std::size_t n = 0; n < findings.levels(); ++n) {
        section.add(threshold_table(findings, n));
    }
    section.add(tail_table(findings));
    add_warnings(section, findings);
    return section;
}

Section rates_section(const Findings& findings) {
    Section section{"rates", "Detection rates", {}};
    for (std::size_t n = 0; n < findings.levels(); ++n) {
        if (findings.unassessable.empty()) {
            section.state(fmt::format("headline.{}", n), headline_text(findings, n));
        }
        section.add(rate_table(findings, n));
    }
    return section;
}

Section pod_section(const Findings& findings) {
    const bool sized = has_sizes(findings.request);
    Section section{"pod", sized ? "Probability of detection" : "Area under the ROC", {}};
    for (std::size_t n = 0; n < findings.levels(); ++n) {
        section.add(curve_table(findings, n));
        if (sized) {
            section.state(fmt::format("unknown.{}", n), unknown_text(findings, n));
            add_responses(section, findings, n);
        }
    }
    return section;
}

Section ranking_section(const Findings& findings) {
    Section section{"ranking", "Ranking of the features", {}};
    for (std::size_t n = 0; n < findings.levels(); ++n) {
        add_ranking(section, findings, n);
    }
    return section;
}

Section false_alarms_section(const Findings& findings) {
    Section section{"false_alarms", "Detection by false-alarm rate", {}};
    for (std::size_t n = 0; has_sizes(findings.request) && n < findings.levels(); ++n) {
        add_false_alarms(section, findings, n);
    }
    return section;
}

Section conditions_section(const Findings& findings) {
    const auto none = std::vector<ConditionDetection>{};
    const auto& all = findings.has_curves() ? findings.reliability->conditions : none;
    if (all.empty()) {
        return {};
    }
    const std::string name = input_name(all.front().input, all.front().unit);
    Section section{"conditions", "Thresholds by " + name, {}};
    section.state("conditions.how",
                  fmt::format("Each value of {} has its own threshold, set by healthy {} with that "
                              "value.",
                              name, plural(findings.subject)));
    std::string refusal;
    for (std::size_t f = 0; f < all.size(); ++f) {
        if (!all[f].refusal.empty()) {
            refusal = all[f].refusal;  // reason from the input, so the same for all features
            continue;
        }
        for (std::size_t n = 0; n < all[f].levels.size(); ++n) {
            const ConditionLevel& level = all[f].levels[n];
            Table table{fmt::format("conditions.{}.{}", f, n),
                        condition_title(findings, all[f], level, n),
                        {in_unit("size", findings.request.size), "detection rate"},
                        {}};
            for (const DetectionCell& cell : level.cells) {
                if (cell.tested > 0) {
                    table.rows.push_back({range_text(cell.size, findings.request.size),
                                          rate_text(cell.pd, cell.lower, cell.upper)});
                }
            }
            section.add(std::move(table));
        }
        for (std::size_t i = 0; i < all[f].warnings.size(); ++i) {
            section.state(fmt::format("conditions.warning.{}.{}", f, i),
                          fmt::format("Warning: {} ({}).", all[f].warnings[i], all[f].feature));
        }
    }
    section.state("conditions.none",
                  refusal.empty() ? "" : fmt::format("No thresholds by {}: {}.", name, refusal));
    return section;
}

}  // namespace gearpod::analysis
