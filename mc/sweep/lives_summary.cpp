#include "mc/sweep/lives_summary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <tuple>

#include "analysis/monitoring/monitor_ranking.hpp"
#include "analysis/report/json_values.hpp"
#include "mc/input/printable.hpp"
#include "mc/lives/life_rows.hpp"
#include "mc/report/lives_report.hpp"
#include "mc/results/file_rows.hpp"
#include "mc/sweep/columns.hpp"

namespace gearpod::mc {
namespace {

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

}  // namespace

LivesPoint summarise_lives(const SweepPoint& point, const std::string& results) {
    const Results frame = read_frame(results);
    const FileRows rows(results, frame);
    check_lives(results, frame, rows);
    LivesPoint summary;
    summary.point = point;
    summary.results = results;
    summary.study = read_study_text(frame.provenance_value("study"), results).study.value();
    const Campaign campaign = campaign_of(summary.study, frame, rows);
    summary.cracked = campaign.cracked.size();
    summary.failed = campaign.failed;
    summary.record = campaign.record;
    summary.interpolation = campaign.interpolation;
    const LifeMonitor monitor(summary.study, campaign);
    summary.monitored = monitor.results();
    summary.ranking = monitor.ranking();
    if (const std::string withheld = why_withheld(summary.study, campaign); !withheld.empty()) {
        summary.ranking.clear();
        for (MonitoredFeature& one : summary.monitored) {
            one.unranked = withheld;
        }
    }
    return summary;
}

const MonitoredFeature* best_over(const std::vector<LivesPoint>& points) {
    const MonitoredFeature* best = nullptr;
    std::tuple<double, double, double> least;
    for (const LivesPoint& first : points) {
        for (const MonitoredFeature& one : first.monitored) {
            double net = 0.0, deep_90 = 0.0, deep_50 = 0.0;
            bool ranked = false;
            for (const LivesPoint& point : points) {
                const double last = *point.study.life.last_depth_m;
                const MonitoredFeature* here = find_life_result(point, one);
                const bool counts = here != nullptr && here->unranked.empty();
                ranked = ranked || counts;
                net += counts ? analysis::net_share(here->performance) : 0.0;
                // std::fmin returns the number if the other argument is NaN.
                deep_90 += counts ? std::fmin(here->performance.size_90.value, last) : last;
                deep_50 += counts ? std::fmin(here->performance.size_50.value, last) : last;
            }
            const std::tuple key(-net, deep_90, deep_50);
            if (ranked && (best == nullptr || key < least)) {
                best = &one;
                least = key;
            }
        }
    }
    return best;
}

std::string lives_sweep_text(const std::vector<VariedKey>& keys,
                             const std::vector<LivesPoint>& points) {
    const MonitoredFeature* best = best_over(points);
    if (best == nullptr) {
        return "at no point does a detector find more cracks than chance with at most the stated "
               "false alarms\n";
    }
    std::vector<std::vector<std::string>> lines(1);
    for (const VariedKey& key : keys) {
        lines[0].push_back(short_key(key.key));
    }
    lines[0].insert(lines[0].end(), {"lives", "failed"});
    for (const std::string& column : life_result_columns(points[0].study)) {
        lines[0].push_back(column);
    }
    lines[0].emplace_back("best at this point");
    for (const LivesPoint& point : points) {
        std::vector<std::string> line = point.point.values;
        line.push_back(std::to_string(point.cracked));
        line.push_back(std::to_string(point.failed));
        const MonitoredFeature* here = find_life_result(point, *best);
        const auto cells = life_result_cells(
            here == nullptr ? analysis::MonitorPerformance{} : here->performance, point.study);
        line.insert(line.end(), cells.begin(), cells.end());
        line.push_back(name_of(best_at(point)));
        lines.push_back(std::move(line));
    }
    return fmt::format("by {}, which finds most cracks net of chance over all points\n",
                       name_of(best)) +
           aligned_columns(lines, keys.size());
}

nlohmann::json lives_sweep_json(const std::string& title, const std::vector<VariedKey>& keys,
                                const std::vector<LivesPoint>& points) {
    using Json = nlohmann::json;
    const MonitoredFeature* best = best_over(points);
    Json json{{"kind", "lives-sweep"},
              {"title", title},
              {"varied", Json::array()},
              {"best", nullptr},
              {"points", Json::array()}};
    if (best != nullptr) {
        json["best"] = {{"feature", best->feature}, {"detector", best->detector}};
    }
    for (const VariedKey& key : keys) {
        json["varied"].push_back({{"key", key.key}, {"values", key.values}});
    }
    for (const LivesPoint& point : points) {
        const InterpolationErrors& off = point.interpolation;
        Json one{{"results", point.results},
                 {"values", Json::object()},
                 {"lives", point.cracked},
                 {"failed", point.failed},
                 {"confidence", point.study.detection.confidence},
                 {"false_alarms_per_1000_h", point.study.monitoring.false_alarms_per_1000_h},
                 {"last_depth_m", *point.study.life.last_depth_m},
                 {"record", printable(point.record)},
                 {"interpolation",
                  {{"first", analysis::number(off.first)},
                   {"last", analysis::number(off.last)},
                   {"load", analysis::number(off.load)},
                   {"change", analysis::number(off.change)}}},
                 {"monitored", Json::array()},
                 {"ranking", point.ranking}};
        for (std::size_t k = 0; k < keys.size(); ++k) {
            one["values"][keys[k].key] = point.point.values[k];
        }
        for (const MonitoredFeature& monitored : point.monitored) {
            one["monitored"].push_back(life_result_json(monitored));
        }
        json["points"].push_back(std::move(one));
    }
    return json;
}

}  // namespace gearpod::mc
