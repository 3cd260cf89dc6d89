#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>
#include <tuple>

#include "analysis/monitoring/monitor_performance.hpp"
#include "analysis/report/json_values.hpp"
#include "analysis/report/wording.hpp"
#include "analysis/statistics/interval.hpp"
#include "mc/files/input/terminal_text.hpp"
#include "mc/lives/campaign.hpp"
#include "mc/report/lives_report.hpp"
#include "mc/report/sweep/summaries.hpp"
#include "mc/results/result_rows.hpp"

namespace gearpod::mc {
namespace {

using analysis::number_text;
using analysis::percent_text;

const MonitoredFeature* find_life_result(const LivesPoint& point, const MonitoredFeature& like) {
    const auto at = std::ranges::find_if(point.monitored, [&](const MonitoredFeature& one) {
        return one.feature == like.feature && one.detector == like.detector;
    });
    return at == point.monitored.end() ? nullptr : &*at;
}

std::string name_of(const MonitoredFeature* one) {
    return one == nullptr ? "-" : one->feature + ", " + one->detector;
}

// Null if none has a rank.
const MonitoredFeature* best_at(const LivesPoint& point) {
    return point.ranking.empty() ? nullptr : &point.monitored[point.ranking.front()];
}

LivesPoint summarise_life_point(const SweepPoint& point, const std::string& results) {
    const Results frame = read_frame(results);
    const FileRows rows(results, frame);
    LivesPoint summary;
    summary.point = point;
    summary.results = results;
    summary.plan = check_lives(results, frame, rows);
    const Campaign campaign = campaign_of(summary.plan, frame, rows);
    summary.cracked = campaign.cracked.size();
    for (const GearboxLife& life : campaign.cracked) {
        summary.tooth_failed.push_back(life.status != Status::ok ? -1
                                       : life.history.end_hours  ? 1
                                                                 : 0);
    }
    summary.failed = campaign.failed;
    summary.record = campaign.record;
    summary.interpolation = campaign.interpolation;
    const LifeMonitor monitor(summary.plan, campaign);
    summary.monitored = monitor.results();
    summary.ranking = monitor.ranking();
    if (const std::string withheld = why_withheld(summary.plan, campaign); !withheld.empty()) {
        summary.withheld = withheld;
        summary.ranking.clear();
        for (MonitoredFeature& one : summary.monitored) {
            one.performance = {};
            one.unranked = withheld;
        }
    }
    return summary;
}

// Sum of the shares found net of chance, negative, and of the depths found, over all points.
using LivesScore = std::tuple<double, double, double>;

std::optional<LivesScore> score_of(const std::vector<LivesPoint>& points,
                                   const MonitoredFeature& one) {
    double net = 0.0, deep_90 = 0.0, deep_50 = 0.0;
    bool ranked = false;
    for (const LivesPoint& point : points) {
        const double last = point.plan.last_m;
        const MonitoredFeature* here = find_life_result(point, one);
        const bool counts = here != nullptr && here->unranked.empty();
        ranked = ranked || counts;
        net += counts ? analysis::net_share(here->performance) : 0.0;
        // std::fmin returns the number if the other argument is NaN.
        deep_90 += counts ? std::fmin(here->performance.size_90.value, last) : last;
        deep_50 += counts ? std::fmin(here->performance.size_50.value, last) : last;
    }
    return ranked ? std::optional(LivesScore{-net, deep_90, deep_50}) : std::nullopt;
}

std::vector<MonitoredFeature> order_over(const std::vector<LivesPoint>& points) {
    std::vector<std::pair<LivesScore, const MonitoredFeature*>> scored;
    for (const LivesPoint& point : points) {
        for (const MonitoredFeature& one : point.monitored) {
            if (const auto score = score_of(points, one)) {
                scored.emplace_back(*score, &one);
            }
        }
    }
    std::ranges::stable_sort(scored, {}, [](const auto& entry) { return entry.first; });
    std::vector<MonitoredFeature> order;
    for (const auto& [score, one] : scored) {
        if (std::ranges::count(order, one->feature, &MonitoredFeature::feature) == 0) {
            order.push_back(*one);
        }
    }
    return order;
}

// Outcome by gearbox: 1 if the crack is found before the tooth fails, 0 if not, -1 if it does not
// fail.
std::vector<int> life_outcomes(const LivesPoint& point, const MonitoredFeature& one) {
    std::vector<int> outcomes;
    std::size_t life = 0;
    for (const int failed : point.tooth_failed) {
        const bool found = failed >= 0 && life < one.performance.alarm_hours.size() &&
                           !std::isnan(one.performance.alarm_hours[life]);
        life += failed >= 0;
        outcomes.push_back(failed == 1 ? found : -1);
    }
    return outcomes;
}

// P-value for equal shares found at two points: exact McNemar on the lives that end at both, or the
// pooled test for other gearboxes.
double p_of_equal_shares(const LivesPoint& a, const MonitoredFeature& at_a, const LivesPoint& b,
                         const MonitoredFeature& at_b) {
    if (a.plan.ensemble.seed != b.plan.ensemble.seed) {
        return analysis::pooled_p_value(at_a.performance.found, at_a.performance.ended,
                                        at_b.performance.found, at_b.performance.ended);
    }
    const std::vector<int> first = life_outcomes(a, at_a), second = life_outcomes(b, at_b);
    analysis::PairedCounts counts;
    for (std::size_t i = 0; i < std::min(first.size(), second.size()); ++i) {
        if (first[i] >= 0 && second[i] >= 0) {
            counts.add(first[i], second[i]);
        }
    }
    return analysis::mcnemar_p_value(counts);
}

// Points with a share found by the best feature and detector, with a rank or not, and that result.
struct KnownShare {
    const LivesPoint* point;
    const MonitoredFeature* result;
    double share() const { return result->performance.share; }
};

std::vector<KnownShare> known_shares(const LivesSweep& sweep) {
    std::vector<KnownShare> known;
    for (const LivesPoint& point : sweep.points) {
        const MonitoredFeature* here = find_life_result(point, sweep.order.front());
        if (here != nullptr && !std::isnan(here->performance.share)) {
            known.push_back({&point, here});
        }
    }
    return known;
}

std::string best_text(const LivesSweep& sweep) {
    const MonitoredFeature& best = sweep.order.front();
    return fmt::format("{} by {}", analysis::feature_text(best.feature), best.detector);
}

// "; it has no rank at 1 of 3 points (records = 1)", "" for no such points.
std::string exempt_points_text(const char* exception, const LivesSweep& sweep,
                               const std::function<bool(const LivesPoint&)>& excepted) {
    std::vector<std::string> names;
    for (const LivesPoint& point : sweep.points) {
        if (excepted(point)) {
            names.push_back(point_text(sweep.keys, point.point));
        }
    }
    return names.empty() ? ""
                         : fmt::format("; {} at {} of {} points ({})", exception, names.size(),
                                       sweep.points.size(), names_text(names));
}

std::string lives_headline_text(const LivesSweep& sweep) {
    if (std::ranges::none_of(sweep.points, &std::string::empty, &LivesPoint::withheld)) {
        return "The results are withheld at every point.";
    }
    if (sweep.order.empty()) {
        return "At no point does a detector find more cracks than chance with at most the stated "
               "false alarms.";
    }
    const std::vector<KnownShare> known = known_shares(sweep);
    std::string text = analysis::capitalised(best_text(sweep));
    if (known.empty()) {
        return text + " finds nothing in time, because no tooth fails within its records.";
    }
    const auto at = [&](const KnownShare& one) {
        return fmt::format("{} [{}, {}]", percent_text(one.share()),
                           percent_text(one.result->performance.share_bounds.lower),
                           percent_text(one.result->performance.share_bounds.upper));
    };
    const auto [low, high] = std::ranges::minmax_element(known, {}, &KnownShare::share);
    text += fmt::format(" finds {} of the cracks before the tooth fails", at(*high));
    text += low->share() < high->share()
                ? fmt::format(" at {}, {} at {}", point_text(sweep.keys, high->point->point),
                              at(*low), point_text(sweep.keys, low->point->point))
            : known.size() == sweep.points.size() ? " at every point"
                                                  : " at every point with a known share";
    std::vector<KnownShare> warned = known;
    std::erase_if(warned, [](const KnownShare& one) {
        return std::isnan(one.result->performance.warning_50);
    });
    if (!warned.empty()) {
        const auto hours = [](const KnownShare& one) { return one.result->performance.warning_50; };
        const auto [least, most] = std::ranges::minmax_element(warned, {}, hours);
        text +=
            fmt::format("; half of those found at least {} h before at {}",
                        number_text(hours(*least)), point_text(sweep.keys, least->point->point));
        if (hours(*most) > hours(*least)) {
            text += fmt::format(", {} h at {}", number_text(hours(*most)),
                                point_text(sweep.keys, most->point->point));
        }
    }
    const auto result_at = [&](const LivesPoint& point) {
        const auto here = std::ranges::find(known, &point, &KnownShare::point);
        return here == known.end() ? nullptr : here->result;
    };
    text += exempt_points_text("it has no rank", sweep, [&](const LivesPoint& point) {
        return result_at(point) != nullptr && !result_at(point)->unranked.empty();
    });
    text += exempt_points_text("no share is known", sweep, [&](const LivesPoint& point) {
        return result_at(point) == nullptr;
    });
    return text + ".";
}

// Sentence on the shares that differ from the largest beyond scatter.
std::string lives_differences_text(const LivesSweep& sweep) {
    const std::vector<KnownShare> known =
        sweep.order.empty() ? std::vector<KnownShare>{} : known_shares(sweep);
    if (known.size() < 2) {
        return "";
    }
    const auto best = std::ranges::max_element(known, {}, &KnownShare::share);
    const double pairs = 0.5 * static_cast<double>(known.size() * (known.size() - 1));
    const double confidence = best->point->plan.ensemble.request.confidence;
    std::size_t smaller = 0;
    std::vector<std::string> within;
    for (auto one = known.begin(); one != known.end(); ++one) {
        if (one == best) {
            continue;
        }
        const double p = p_of_equal_shares(*best->point, *best->result, *one->point, *one->result);
        if (pairs * p < 1.0 - confidence) {
            ++smaller;
        } else {
            within.push_back(point_text(sweep.keys, one->point->point));
        }
    }
    return within_scatter_text(fmt::format("The share found is largest at {}.",
                                           point_text(sweep.keys, best->point->point)),
                               "smaller", smaller, within) +
           fmt::format(
               " Differences: exact McNemar tests on the lives that end at both points, at {} "
               "for all pairs of points together (Bonferroni).",
               percent_text(confidence));
}

std::vector<std::string> lives_row(const LivesPoint& point, const MonitoredFeature& one) {
    const MonitoredFeature* here = find_life_result(point, one);
    return life_result_cells(here == nullptr ? analysis::MonitorPerformance{} : here->performance,
                             point.plan);
}

analysis::Table lives_table(const LivesSweep& sweep, const std::string& key,
                            const std::string& title, std::initializer_list<const char*> columns) {
    analysis::Table table{key, title, key_columns(sweep.keys), {}};
    table.labels = sweep.keys.size();
    table.columns.insert(table.columns.end(), columns.begin(), columns.end());
    return table;
}

void append(std::vector<std::string>& row, std::vector<std::string> cells) {
    std::ranges::move(cells, std::back_inserter(row));
}

analysis::Table best_table(const LivesSweep& sweep) {
    const bool ranked = !sweep.order.empty();
    analysis::Table table =
        lives_table(sweep, "points", ranked ? "By " + best_text(sweep) : "Points", {});
    append(table.columns, life_result_columns(sweep.points.front().plan));
    append(table.columns, {"best at this point", "lives", "failed"});
    for (const LivesPoint& point : sweep.points) {
        std::vector<std::string> row = point.point.labels;
        append(row, lives_row(point, ranked ? sweep.order.front() : MonitoredFeature{}));
        append(row, {name_of(best_at(point)), std::to_string(point.cracked),
                     std::to_string(point.failed)});
        table.rows.push_back(std::move(row));
    }
    return table;
}

analysis::Table all_features_table(const LivesSweep& sweep) {
    analysis::Table table = lives_table(sweep, "features", "Features, each with its best detector",
                                        {"feature", "detector"});
    append(table.columns, life_result_columns(sweep.points.front().plan));
    table.shown = analysis::Shown::page;
    for (const LivesPoint& point : sweep.points) {
        for (const MonitoredFeature& one : sweep.order) {
            std::vector<std::string> row = point.point.labels;
            append(row, {one.feature, one.detector});
            append(row, lives_row(point, one));
            table.rows.push_back(std::move(row));
        }
    }
    return table;
}

analysis::Table records_table(const LivesSweep& sweep) {
    analysis::Table table =
        lives_table(sweep, "records", "Records and interpolation errors",
                    {"record", "error at the first depths", "at the last", "between loads"});
    table.shown = analysis::Shown::page;
    const auto error = [](double share) {
        return std::isnan(share) ? std::string("-") : percent_text(share);
    };
    for (const LivesPoint& point : sweep.points) {
        const InterpolationErrors& off = point.interpolation;
        std::vector<std::string> row = point.point.labels;
        append(row, {printable(point.record), error(off.first), error(off.last), error(off.load)});
        table.rows.push_back(std::move(row));
    }
    return table;
}

}  // namespace

LivesSweep summarise_lives(const std::string& title, const std::vector<VariedKey>& keys,
                           const std::vector<SweepPoint>& points,
                           const std::vector<std::string>& results) {
    LivesSweep sweep{title, keys, {}, {}};
    for (std::size_t p = 0; p < points.size(); ++p) {
        sweep.points.push_back(summarise_life_point(points[p], results[p]));
    }
    sweep.order = order_over(sweep.points);
    return sweep;
}

analysis::Report lives_sweep_report(const LivesSweep& sweep) {
    analysis::Report report;
    analysis::Section headline{"headline", "", {}};
    headline.state("headline", lives_headline_text(sweep), analysis::Shown::screen);
    headline.state("differences", lives_differences_text(sweep), analysis::Shown::screen);
    const std::string withheld = exempt_points_text(
        "", sweep, [](const LivesPoint& point) { return !point.withheld.empty(); });
    headline.state("withheld",
                   withheld.empty() ? ""
                                    : "Results are withheld" + withheld.substr(2) +
                                          "; `lives` there states why.",
                   analysis::Shown::screen);
    analysis::Table table = best_table(sweep);
    table.shown = analysis::Shown::screen;
    headline.add(std::move(table));
    report.add(std::move(headline));
    report.add({"details", "", {all_features_table(sweep), records_table(sweep)}});
    report.add(files_section(sweep.keys, {sweep.points.begin(), sweep.points.end()}));
    return report;
}

nlohmann::json lives_sweep_json(const LivesSweep& sweep) {
    using Json = nlohmann::json;
    Json order = Json::array(), points = Json::array();
    for (const MonitoredFeature& one : sweep.order) {
        order.push_back({{"feature", one.feature}, {"detector", one.detector}});
    }
    for (const LivesPoint& point : sweep.points) {
        Json results = Json::array();
        for (const MonitoredFeature& monitored : point.monitored) {
            results.push_back(life_result_json(monitored));
        }
        points.push_back({{"results", point.results},
                          {"values", values_json(sweep.keys, point.point)},
                          {"lives", point.cracked},
                          {"failed", point.failed},
                          {"confidence", point.plan.ensemble.request.confidence},
                          {"false_alarms_per_1000_h", point.plan.false_alarms_per_1000_h},
                          {"last_depth_m", point.plan.last_m},
                          {"record", printable(point.record)},
                          {"interpolation", analysis::fields_json(point.interpolation)},
                          {"withheld", analysis::text_or_null(point.withheld)},
                          {"monitored", results},
                          {"ranking", point.ranking}});
    }
    return {{"kind", "lives-sweep"},
            {"title", sweep.title},
            {"varied", analysis::json_of(sweep.keys)},
            {"order", order},
            {"findings", analysis::findings_json(lives_sweep_report(sweep))},
            {"points", points}};
}

}  // namespace gearpod::mc
