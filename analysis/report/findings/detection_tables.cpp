#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "analysis/detection/reliable_size.hpp"
#include "analysis/report/findings/findings.hpp"
#include "analysis/report/wording.hpp"

namespace gearpod::analysis {
namespace {

std::string size_text(const SizeGroup& size, const SizeUnit& unit) {
    const std::string high = number_text(size.high / unit.per_unit(), 4);
    return size.low == size.high ? high
                                 : number_text(size.low / unit.per_unit(), 4) + " to " + high;
}

template <typename Has>
bool any_feature(const Findings& findings, std::size_t level, Has has) {
    return std::any_of(findings.detection.begin(), findings.detection.end(),
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
                 "false-alarm rate", "with healthy test " + many(findings.subject)},
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
                 many(findings.subject), "not computed"},
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

Table reliable_table(const Findings& findings) {
    const SizeUnit& unit = findings.request.size;
    const bool noise = findings.subject == Subject::gearboxes;
    Table table{"reliable_sizes",
                fmt::format("Smallest tested size at and above which the lower bound of Pd is at "
                            "least {}",
                            number_text(kReliablePd)),
                {noise ? "noise" : ""},
                {}};
    for (const FeatureDetection& feature : findings.detection) {
        table.columns.push_back(feature.feature);
    }
    for (std::size_t n = 0; n < findings.levels(); ++n) {
        std::vector<std::string> row{noise ? "x " + number_text(findings.request.noise_levels[n])
                                           : "size"};
        for (const FeatureDetection& feature : findings.detection) {
            const auto size = reliable_size(feature.levels[n], kReliablePd);
            const std::string shown = unit.shown_unit();
            row.push_back(std::isnan(feature.levels[n].threshold) ? "no threshold"
                          : !size                                 ? "not reached"
                                  : size_text(*size, unit) + (shown.empty() ? "" : " " + shown));
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
                true};
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

}  // namespace

void add_detection(Section& section, const Findings& findings, std::size_t level) {
    if (findings.unassessable.empty()) {
        section.state(fmt::format("headline.{}", level), headline_text(findings, level));
    }
    section.add(threshold_table(findings, level));
    section.add(rate_table(findings, level));
}

Section rates_section(const Findings& findings) {
    Section section{"rates", "", {}};
    if (has_sizes(findings.request)) {
        section.add(reliable_table(findings));
    }
    section.add(tail_table(findings));
    add_warnings(section, findings);
    return section;
}

}  // namespace gearpod::analysis
