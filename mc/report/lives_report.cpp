#include "mc/report/lives_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <utility>

#include "analysis/monitoring/monitor_performance.hpp"
#include "analysis/report/json_values.hpp"
#include "analysis/report/wording.hpp"
#include "mc/files/input/terminal_text.hpp"

namespace gearpod::mc {
namespace {

using analysis::number_text;
using analysis::percent_text;
using analysis::Section;
using analysis::Shown;

// Formats a depth in mm: "2.31", or "> 4" if the probability is not reached at the last depth.
std::string depth_text(double depth_m, const CampaignPlan& plan) {
    return std::isinf(depth_m) ? "> " + number_text(1e3 * plan.last_m) : number_text(1e3 * depth_m);
}

std::string interval_text(const analysis::Interval& interval) {
    return fmt::format("{} to {}", number_text(interval.lower), number_text(interval.upper));
}

long ended_lives(const Campaign& campaign) {
    return std::ranges::count_if(campaign.cracked, [](const GearboxLife& one) {
        return one.status == Status::ok && one.history.end_hours.has_value();
    });
}

// Formats the share found: "27/32 [0.68, 0.93]"; "-" if no tooth fails or there is no threshold.
std::string share_text(const analysis::MonitorPerformance& a) {
    return std::isnan(a.share) ? "-"
                               : fmt::format("{}/{} [{:.2f}, {:.2f}]", a.found, a.ended,
                                             a.share_bounds.lower, a.share_bounds.upper);
}

std::string fixed_text(double share) {
    return std::isnan(share) ? "-" : fmt::format("{:.2f}", share);
}

// "6.2 % of the signal and 8 % of what a crack of 2 mm changes"; "" if all records have the same
// load.
std::string load_error_text(const InterpolationErrors& off, const CampaignPlan& plan) {
    std::string text = off.load > 0.0 ? percent_text(off.load) + " of the signal" : "";
    if (off.change > 0.0) {
        text += fmt::format("{}{} of what a crack of {} mm changes", text.empty() ? "" : " and ",
                            percent_text(off.change), number_text(1e3 * plan.smallest_m));
    }
    return text;
}

std::string interpolation_text(const Campaign& campaign, const CampaignPlan& plan) {
    const InterpolationErrors& off = campaign.interpolation;
    const std::string load = load_error_text(off, plan);
    if (std::isnan(off.first)) {
        return "";  // none of the gearboxes used for the error estimate was integrated
    }
    return fmt::format(
        "Signals are interpolated between integrated ones. The error (rms) is {} of the crack's "
        "effect at {} mm and {} of it at {} mm{}.",
        percent_text(off.first), number_text(1e3 * plan.middle_m(plan.first_step)),
        percent_text(off.last), number_text(1e3 * plan.middle_m(plan.depth_steps - 1)),
        load.empty() ? "" : "; between the integrated torques and speeds it is " + load);
}

std::string best_text(const LifeMonitor& monitor, const MonitoredFeature& best) {
    const analysis::MonitorPerformance& a = best.performance;
    std::string text = fmt::format(
        "{} by {} finds {} of {} cracks before the tooth fails ({} to {})",
        analysis::capitalised(analysis::feature_text(best.feature)), best.detector, a.found,
        a.ended, percent_text(a.share_bounds.lower), percent_text(a.share_bounds.upper));
    text +=
        std::isnan(a.share_by_chance)
            ? fmt::format("; alarms at random would find {}", percent_text(a.share_at_stated_rate))
            : fmt::format("; false alarms alone would find {}", percent_text(a.share_by_chance));
    if (!std::isnan(a.warning_50)) {
        text += fmt::format(
            ". Half of those found are found at least {} h before, 90 % at least {} "
            "h before; alarms at cracks below {} mm, which it does not show, count as false",
            number_text(a.warning_50), number_text(a.warning_90), number_text(1e3 * a.effect_size));
    }
    const double stated = monitor.plan().false_alarms_per_1000_h;
    const analysis::FalseAlarms& alarms = a.false_alarms;
    const InterpolationErrors& off = monitor.campaign().interpolation;
    if (off.load > kMostInterpolationError || off.change > kMostInterpolationError) {
        text += ". Not reliable: signals between the integrated torques and speeds are off by " +
                load_error_text(off, monitor.plan());
    }
    return text +
           (std::isnan(alarms.per_1000_h)
                ? fmt::format(". False alarms: set to {} in 1000 h, not counted, for lack of "
                              "healthy lives.",
                              number_text(stated))
                : fmt::format(". False alarms: {} in 1000 h ({}), set to {}.",
                              number_text(alarms.per_1000_h), interval_text(alarms.bounds),
                              number_text(stated)));
}

// The headline where no detector has a rank.
std::string nothing_found_text(const LifeMonitor& monitor) {
    const CampaignPlan& plan = monitor.plan();
    const double stated = plan.false_alarms_per_1000_h;
    const auto& results = monitor.results();
    if (ended_lives(monitor.campaign()) == 0) {
        return fmt::format(
            "No tooth fails within {} records, one every {} h, so no crack can be "
            "found before failure; raise life.records.",
            plan.records, number_text(plan.interval_h));
    }
    const auto without_threshold = std::ranges::count_if(
        results, [](const auto& one) { return std::isnan(one.performance.threshold.value); });
    if (without_threshold == static_cast<long>(results.size())) {
        const analysis::MonitorThreshold& threshold = results.front().performance.threshold;
        return threshold.least_per_1000_h > stated
                   ? fmt::format(
                         "No threshold: {:.0f} h of healthy lives are too few for {} false "
                         "alarms in 1000 h{}.",
                         threshold.hours, number_text(stated),
                         threshold.hours > 0.0 ? "; the smallest number possible is " +
                                                     number_text(threshold.least_per_1000_h)
                                               : "")
                   : fmt::format("No threshold: {} needs more than {} records after the baseline.",
                                 results.front().detector, plan.records - plan.baseline_records);
    }
    return "No detector finds more cracks than chance with at most the stated false alarms.";
}

std::string crack_records_statement(const Campaign& campaign, const CampaignPlan& plan) {
    std::vector<const LifeHistory*> histories;
    for (const GearboxLife& life : campaign.cracked) {
        histories.push_back(&life.history);
    }
    return ended_lives(campaign) == 0
               ? ""
               : fmt::format(
                     "A crack has {} records, one every {} h, from its start to the "
                     "failure of its tooth (median and range).",
                     crack_records_text(histories), number_text(plan.interval_h));
}

Section headline(const LifeMonitor& monitor, bool shows_withheld) {
    const CampaignPlan& plan = monitor.plan();
    const Campaign& campaign = monitor.campaign();
    Section section{"answer", "", {}};
    const std::string withheld = shows_withheld ? "" : why_withheld(plan, campaign);
    section.state("headline",
                  !withheld.empty() ? withheld
                  : monitor.ranking().empty()
                      ? nothing_found_text(monitor)
                      : best_text(monitor, monitor.results()[monitor.ranking()[0]]),
                  Shown::screen);
    section.state("holds", plan.assumptions, Shown::screen);
    section.state("records", crack_records_statement(campaign, plan), Shown::screen);
    section.state("interpolation", interpolation_text(campaign, plan), Shown::screen);
    section.state("failed",
                  campaign.failed > 0
                      ? fmt::format("{} gearboxes failed and are left out.", campaign.failed)
                      : "",
                  Shown::screen);
    return section;
}

// Depth from which the crack has an effect on each feature.
std::string effect_text(const LifeMonitor& monitor) {
    std::vector<std::string> effects;
    long alarms = 0;
    double hours = 0.0;
    for (const MonitoredFeature& one : monitor.results()) {
        const analysis::MonitorPerformance& a = one.performance;
        if (!one.best_of_feature || std::isnan(a.effect_size)) {
            continue;
        }
        effects.push_back(fmt::format(
            "{} {}", one.feature,
            std::isinf(a.effect_size) ? "never" : number_text(1e3 * a.effect_size) + " mm"));
        alarms += a.early_alarms;
        hours += a.early_hours;
    }
    return effects.empty()
               ? ""
               : fmt::format(
                     "Effect of the crack: the median or the 90 % quantile of the records has "
                     "moved "
                     "by {:g} standard deviations of healthy records, from these depths on: {}. "
                     "Earlier alarms "
                     "count as false, not as warnings: {} in {} h of cracked gearboxes, over the "
                     "best detector of each feature.",
                     analysis::kEffectDeviations, analysis::joined(effects), alarms,
                     number_text(hours));
}

Section results_section(const LifeMonitor& monitor) {
    const CampaignPlan& plan = monitor.plan();
    Section section{"results", "Features and detectors", {}};
    analysis::Table table{"results", "", {"feature", "detector", "rank"}, {}, Shown::screen, 2};
    for (std::string& column : life_result_columns(plan)) {
        table.columns.push_back(std::move(column));
    }
    std::map<std::string, std::vector<std::string>> unranked;
    std::vector<std::size_t> order = monitor.ranking();  // then those without a rank
    for (std::size_t i = 0; i < monitor.results().size(); ++i) {
        if (std::ranges::count(monitor.ranking(), i) == 0) {
            order.push_back(i);
        }
    }
    for (std::size_t place = 0; place < order.size(); ++place) {
        const MonitoredFeature& one = monitor.results()[order[place]];
        std::vector<std::string> row{one.feature, one.detector,
                                     one.unranked.empty() ? std::to_string(place + 1) : "-"};
        for (std::string& cell : life_result_cells(one.performance, plan)) {
            row.push_back(std::move(cell));
        }
        table.rows.push_back(std::move(row));
        if (!one.unranked.empty()) {
            unranked[one.unranked].push_back(one.feature + " by " + one.detector);
        }
    }
    section.add(std::move(table));
    section.state(
        "terms",
        fmt::format("Intervals and bounds hold at {}. Found: cracks with an alarm between their "
                    "effect on the feature and the tooth's failure. By chance: the share that "
                    "false alarms alone would find in "
                    "lives of the same length. Net: the share found less that. a50, a90: "
                    "crack depth at which 50 % and 90 % of the cracks are found. w50, "
                    "w90: time from the alarm to failure that 50 % and 90 % of the cracks "
                    "found exceed.",
                    percent_text(plan.ensemble.request.confidence)));
    section.state("effect", effect_text(monitor));
    for (std::size_t reason = 0; const auto& [text, names] : unranked) {
        section.state(fmt::format("unranked.{}", reason++),
                      fmt::format("Not ranked ({}): {}.", text, analysis::joined(names)));
    }
    return section;
}

Section basis(const LifeMonitor& monitor) {
    const CampaignPlan& plan = monitor.plan();
    const Campaign& campaign = monitor.campaign();
    Section section{"basis", "Basis of the results", {}};
    section.state(
        "basis.cracks",
        fmt::format("{} cracks grow from {} to {} mm, with a record every {} h, the first "
                    "{} of which are the gearbox's baseline; {} teeth fail within {} "
                    "records.",
                    campaign.cracked.size(), number_text(1e3 * plan.begin_m),
                    number_text(1e3 * plan.last_m), number_text(plan.interval_h),
                    plan.baseline_records, ended_lives(campaign), plan.records));
    section.state(
        "basis.thresholds",
        fmt::format("Thresholds are set to {} false alarms in 1000 h on {} healthy lives; "
                    "{} other healthy lives count the false alarms.",
                    number_text(plan.false_alarms_per_1000_h), campaign.threshold_lives.size(),
                    campaign.healthy.size()));
    section.state("basis.record", "A record: " + printable(campaign.record) + ".");
    const LifeCosts& costs = campaign.costs;
    // An earlier run may have computed all gearboxes.
    section.state(
        "basis.costs",
        costs.gearbox_count == 0
            ? ""
            : fmt::format("Processor time: {} s per gearbox, {} ms per record ({} "
                          "gearboxes, {} records).",
                          number_text(costs.gearboxes / static_cast<double>(costs.gearbox_count)),
                          number_text(1e3 * costs.records /
                                      static_cast<double>(std::max(1L, costs.record_count))),
                          costs.gearbox_count, costs.record_count));
    return section;
}

}  // namespace

std::string why_withheld(const CampaignPlan& plan, const Campaign& campaign) {
    const InterpolationErrors& off = campaign.interpolation;
    return off.load > kMostInterpolationError || off.change > kMostInterpolationError
               ? fmt::format(
                     "No answer: between the integrated torques and speeds the signals are off by "
                     "{} (at most {} is accepted). Let more of them be integrated (raise "
                     "life.integrated_torques and life.integrated_speeds), let the records have "
                     "only some torques and speeds (life.distinct_torques and "
                     "life.distinct_speeds), or reduce the scatter of the records. --show-withheld "
                     "prints the results all the same.",
                     load_error_text(off, plan), percent_text(kMostInterpolationError))
               : "";
}

std::vector<std::string> life_result_columns(const CampaignPlan& plan) {
    return {"threshold",
            "false alarms in 1000 h",
            "found",
            "by chance",
            "net",
            "a50, mm",
            fmt::format("a90, mm ({} bound)", percent_text(plan.ensemble.request.confidence)),
            "w50, h",
            "w90, h"};
}

std::vector<std::string> life_result_cells(const analysis::MonitorPerformance& a,
                                           const CampaignPlan& plan) {
    const analysis::FalseAlarms& f = a.false_alarms;
    return {number_text(a.threshold.value),
            std::isnan(f.per_1000_h)
                ? "-"
                : fmt::format("{} [{}, {}]", number_text(f.per_1000_h), number_text(f.bounds.lower),
                              number_text(f.bounds.upper)),
            share_text(a),
            fixed_text(a.share_by_chance),
            fixed_text(analysis::net_share(a)),
            depth_text(a.size_50.value, plan),
            std::isnan(a.size_90.value) ? "-"
                                        : depth_text(a.size_90.value, plan) + " (" +
                                              depth_text(a.size_90.bound, plan) + ")",
            number_text(a.warning_50),
            number_text(a.warning_90)};
}

analysis::Report lives_report(const LifeMonitor& monitor, bool shows_withheld) {
    analysis::Report report;
    report.add(headline(monitor, shows_withheld));
    if (shows_withheld || why_withheld(monitor.plan(), monitor.campaign()).empty()) {
        report.add(results_section(monitor));
    }
    report.add(basis(monitor));
    return report;
}

nlohmann::json life_result_json(const MonitoredFeature& one) {
    const analysis::MonitorPerformance& a = one.performance;
    nlohmann::json json = analysis::fields_json(a);
    json.update({{"feature", one.feature},
                 {"detector", one.detector},
                 {"threshold", analysis::number(a.threshold.value)},
                 {"threshold_hours", a.threshold.hours},
                 {"false_alarms",
                  {{"count", a.false_alarms.alarms},
                   {"hours", a.false_alarms.hours},
                   {"per_1000_h", analysis::number(a.false_alarms.per_1000_h)},
                   {"bounds", analysis::json_of(a.false_alarms.bounds)},
                   {"dispersion", a.false_alarms.dispersion},
                   {"expected", analysis::json_of(a.expected_per_1000_h)}}},
                 {"net_share", analysis::number(analysis::net_share(a))},
                 {"unranked", analysis::text_or_null(one.unranked)},
                 {"best_of_feature", one.best_of_feature},
                 {"depth_50_m", analysis::number(a.size_50.value)},
                 {"depth_50_bound_m", analysis::number(a.size_50.bound)},
                 {"depth_90_m", analysis::number(a.size_90.value)},
                 {"depth_90_bound_m", analysis::number(a.size_90.bound)}});
    return json;
}

nlohmann::json lives_json(const LifeMonitor& monitor, bool shows_withheld) {
    const CampaignPlan& plan = monitor.plan();
    const Campaign& campaign = monitor.campaign();
    nlohmann::json watched = nlohmann::json::array(), lives = nlohmann::json::array();
    nlohmann::json interpolation = analysis::fields_json(campaign.interpolation);
    interpolation.update({{"first_depth_m", plan.middle_m(plan.first_step)},
                          {"last_depth_m", plan.middle_m(plan.depth_steps - 1)},
                          {"smallest_depth_m", plan.smallest_m}});
    for (const MonitoredFeature& result : monitor.results()) {
        watched.push_back(life_result_json(result));
        watched.back()["alarm_h"] = analysis::json_of(result.performance.alarm_hours);
    }
    for (const GearboxLife& life : campaign.cracked) {
        nlohmann::json hours = nlohmann::json::array(), depths = nlohmann::json::array();
        for (const LifeRecord& record : life.history.records) {
            hours.push_back(record.hours);
            depths.push_back(record.depth_m);
        }
        lives.push_back({{"status", static_cast<int>(life.status)},
                         {"end_h", analysis::json_of(life.history.end_hours)},
                         {"hours", hours},
                         {"depth_m", depths}});
    }
    return {
        {"kind", "lives"},
        {"title", plan.ensemble.title},
        {"interval_h", plan.interval_h},
        {"record", printable(campaign.record)},
        {"baseline_records", plan.baseline_records},
        {"first_depth_m", plan.begin_m},
        {"last_depth_m", plan.last_m},
        {"healthy_lives",
         {{"setting", campaign.threshold_lives.size()}, {"counting", campaign.healthy.size()}}},
        {"false_alarms_per_1000_h", plan.false_alarms_per_1000_h},
        {"failed", campaign.failed},
        {"interpolation", interpolation},
        {"costs",
         {{"gearboxes", campaign.costs.gearbox_count},
          {"gearbox_s", campaign.costs.gearboxes},
          {"records", campaign.costs.record_count},
          {"record_s", campaign.costs.records}}},
        {"withheld", analysis::text_or_null(shows_withheld ? "" : why_withheld(plan, campaign))},
        {"findings", findings_json(lives_report(monitor, shows_withheld))},
        {"monitored", watched},
        {"ranking", monitor.ranking()},
        {"trade_offs", analysis::json_of(monitor.trade_offs())},
        {"fans", analysis::json_of(monitor.feature_quantiles())},
        {"lives", lives}};
}

}  // namespace gearpod::mc
