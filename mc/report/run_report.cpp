#include "mc/report/run_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <utility>

#include "analysis/report/detection_json.hpp"
#include "analysis/report/findings/findings.hpp"
#include "analysis/report/json_values.hpp"
#include "analysis/report/wording.hpp"
#include "features/feature.hpp"
#include "mc/files/input/terminal_text.hpp"
#include "mc/report/run_sections.hpp"
#include "mc/results/reliability_of_results.hpp"

namespace gearpod::mc {
namespace {

// Notes on results that are not those of a whole study.
analysis::Section state_section(const Results& frame, const RowCounts& counts) {
    analysis::Section section{"state", "", {}};
    const std::string part = frame.provenance_value("part");
    section.state("part",
                  part.empty() ? ""
                               : fmt::format("Part {} of the study only; join all parts "
                                             "with `gearpod merge`.",
                                             part),
                  analysis::Shown::screen);
    const std::string state = frame.provenance_value("state");
    section.state("incomplete",
                  state != "running" && !state.starts_with("interrupted")
                      ? ""
                      : fmt::format("Incomplete study: {} of {} gearboxes ({}).", counts.all,
                                    printable(frame.provenance_value("gearboxes_asked_for")),
                                    printable(state)),
                  analysis::Shown::page);
    return section;
}

std::string facts_text(const analysis::Findings& findings, const RowCounts& counts,
                       const std::optional<RunFacts>& facts) {
    bool any = false;
    for (const analysis::FeatureDetection& feature : findings.detection) {
        for (const analysis::LevelDetection& level : feature.levels) {
            any |= !std::isnan(level.threshold);
        }
    }
    const bool recorded = findings.subject == analysis::Subject::recordings;
    const std::string thresholds =
        any ? fmt::format(" Thresholds from {} at a false-alarm rate of {}.",
                          recorded ? "these healthy recordings" : "an independent healthy sample",
                          analysis::percent_text(findings.request.false_alarm_rate))
            : "";
    return recorded ? fmt::format("{} recordings, {} of them known as healthy and {} as faulty.{}",
                                  counts.all, findings.healthy, findings.faulty, thresholds)
                    : fmt::format(
                          "{} simulated gearboxes, {}; {} healthy and {} "
                          "faulty ones have values.{}{}",
                          counts.all,
                          counts.failed() == 0
                              ? "all computed"
                              : fmt::format("{} of which could not be computed", counts.failed()),
                          findings.healthy, findings.faulty, thresholds,
                          facts && any ? " " + facts->false_alarms : "");
}

// Reason why an ensemble has rates only.
analysis::Section too_many_section(const analysis::Findings& findings, const Results& frame) {
    analysis::Section section{"too_many", "", {}};
    const std::size_t each =
        std::max<std::size_t>(1, frame.features.size() * frame.noise_levels.size());
    section.state(
        "too_many",
        findings.reliability != nullptr
            ? ""
            : fmt::format("No detection curves, areas and ranking: they need all values "
                          "at once, and the number of {} is limited to {} with these "
                          "features and noise levels.",
                          analysis::plural(findings.subject), kMostAssessedValues / each));
    return section;
}

// Numerical and statistical error of the feature in the answer; "" without them.
std::string numerical_of(const analysis::Findings& findings,
                         const std::vector<NumericalContribution>& contributions) {
    if (findings.smallest.empty() || !findings.smallest[findings.reference]) {
        return "";
    }
    return numerical_limit(contributions, findings.smallest[findings.reference]->feature,
                           findings.request.noise_levels[findings.reference]);
}

std::string other_fault_words(const RunFindings& run) {
    return run.facts ? run.facts->other_fault : "another fault";
}

// Alarms of the answer's feature that another fault raises; "" without one.
std::string other_fault_of(const analysis::Findings& findings, const Results& frame,
                           const RunFindings& run) {
    if (run.other_fault.empty() || findings.order.empty() ||
        findings.order[findings.reference].empty()) {
        return "";
    }
    return other_fault_limit(frame, other_fault_words(run), run.other_fault,
                             findings.name(findings.best(findings.reference)), findings.reference);
}

// Time of the run and of its gearboxes, and the largest part of theirs.
analysis::Section time_section(const Results& frame) {
    double all = 0.0;
    std::map<std::string, double> values;
    std::pair<double, std::string> most;
    for (const Timing& timing : frame.timing) {
        values[timing.name] = timing.seconds;
        if (timing.name.ends_with("_thread_s")) {
            all += timing.seconds;
            most = std::max(most,
                            {timing.seconds, timing.name.substr(0, timing.name.find("_thread_s"))});
        }
    }
    analysis::Section section{"time", "", {}};
    const std::string threads = frame.provenance_value("threads"),
                      ranks = frame.provenance_value("ranks");
    const std::string whole =
        values.contains("evaluation_s")  // since 0.3
            ? fmt::format("{:.1f} s to the results; ",
                          values["setup_s"] + values["ensemble_s"] + values["evaluation_s"])
            : "";
    if (all > 0.0) {
        section.state("time",
                      fmt::format("Time: {}gearboxes {:.1f} s with {} thread{}{}.", whole,
                                  values["ensemble_s"], threads, threads == "1" ? "" : "s",
                                  ranks == "1" ? "" : " in " + ranks + " ranks"),
                      analysis::Shown::screen);
        section.state("time.most",
                      fmt::format("The largest part of the gearboxes' time is {}, {:.0f} %.",
                                  most.second, 100.0 * most.first / all));
    }
    const double superposed = values["superposed_records"],
                 full = values["superposition_fallback_records"];
    section.state("time.superposed",
                  superposed + full > 0.0
                      ? fmt::format("{} of {} records were superposed; {} were integrated in full, "
                                    "because a tooth pair may lose contact or the fault acts "
                                    "during the whole span.",
                                    superposed, superposed + full, full)
                      : "");
    return section;
}

// Fills the report and the feature of its answer.
void fill_report(const Results& frame, const RowSource& rows,
                 const std::optional<analysis::Reliability>& reliability, RunFindings& run) {
    const FaultPlan fault = run.facts ? run.facts->fault : FaultPlan{};
    std::vector<std::string> units;
    for (const FeatureResult& feature : frame.features) {
        units.push_back(feature.unit);
    }
    const analysis::Findings findings(
        {frame.detection, reliability ? &*reliability : nullptr, frame.request, subject_of(frame),
         fault.words, reference_level(frame.noise_levels), units,
         [&fault](double size) { return fault.share.text(size); },
         run.facts ? run.facts->untested : "", run.facts ? run.facts->record.longer : ""});
    if (!findings.detection.empty() && findings.levels() > 0) {
        run.best_feature = findings.name(findings.best(findings.reference));
    }
    analysis::Report& report = run.report;
    report.add(state_section(frame, run.failures.counts));
    analysis::Section answer = analysis::headline_section(
        findings, run.facts ? run.facts->conditions : "", run.facts ? run.facts->noise : "",
        facts_text(findings, run.failures.counts, run.facts));
    answer.state("record", run.facts ? run.facts->record.conditions : "");
    if (run.monitoring) {
        report.add(monitoring_answer(*run.monitoring));
    }
    report.add(std::move(answer));
    AssumptionLimits assumptions = assumption_limits(frame, rows, findings);
    analysis::Section limits = analysis::limits_section(
        findings,
        {assumptions.strongest, numerical_of(findings, run.numerical), assumptions.fine_steps,
         other_fault_of(findings, frame, run), assumptions.decides});
    limits.add(std::move(assumptions.table));
    report.add(std::move(limits));
    analysis::Section values = feature_values(frame, rows);
    if (values.blocks.empty()) {
        add_detection_sections(report, findings);
    }
    report.add(std::move(values));
    report.add(too_many_section(findings, frame));
    const std::vector<std::size_t> ranked =
        findings.order.empty() ? std::vector<std::size_t>{} : findings.order[findings.reference];
    if (run.monitoring) {
        constexpr std::size_t kMostNamed = 3;
        std::vector<std::string> best;
        for (std::size_t i = 0; i < std::min(kMostNamed, ranked.size()); ++i) {
            best.push_back(frame.features[ranked[i]].name);
        }
        report.add(monitoring_section(*run.monitoring, best));
    }
    report.add(sensors_section(frame, run.sensors));
    report.add(other_fault_section(frame, other_fault_words(run), run.other_fault));
    report.add(contact_section(run.contact_loss));
    report.add(numerical_section(frame, run.numerical));
    report.add(failures_section(frame, run.failures));
    report.add(time_section(frame));
}

using Json = nlohmann::json;

// Numerical error compared with the statistical one; null if it was not verified.
Json numerical_json(const Results& frame, const std::vector<NumericalContribution>& contributions) {
    if (!frame.numerical) {
        return nullptr;
    }
    Json json{{"setting", frame.numerical->setting},
              {"finer", frame.numerical->finer},
              {"gearboxes", frame.numerical->gearboxes},
              {"shares", Json::array()}};
    for (const NumericalContribution& contribution : contributions) {
        Json share = analysis::fields_json(contribution);
        share["larger"] = contribution.numerical_dominates ? "numerical" : "statistical";
        json["shares"].push_back(std::move(share));
    }
    return json;
}

Json list_or_null(Json list) {
    return list.empty() ? Json(nullptr) : list;
}

Json change_json(const analysis::NumberDifference& change) {
    return change.refusal.empty() ? Json{{"difference", analysis::number(change.difference())},
                                         {"lower", analysis::number(change.bounds.lower)},
                                         {"upper", analysis::number(change.bounds.upper)}}
                                  : Json(nullptr);
}

// Detection by each sensor and by all together; null with one sensor.
Json sensors_json(const std::vector<SensorDetection>& sensors) {
    Json json = Json::array();
    for (const SensorDetection& sensor : sensors) {
        json.push_back({{"name", sensor.name},
                        {"noise_level", sensor.noise_level},
                        {"feature", sensor.feature},
                        {"size", sensor.smallest ? Json(sensor.smallest->size) : Json(nullptr)},
                        {"a90", sensor.change ? change_json(sensor.change->a90) : Json(nullptr)},
                        {"auc", sensor.change ? change_json(sensor.change->auc) : Json(nullptr)}});
    }
    return list_or_null(std::move(json));
}

// Alarms of healthy gearboxes with another fault; null without one.
Json other_fault_json(const Results& frame, const std::vector<OtherFaultAlarms>& alarms) {
    Json json = analysis::json_of(alarms);
    for (std::size_t i = 0; i < alarms.size(); ++i) {
        json[i]["feature"] = frame.features[alarms[i].feature].name;
        json[i]["noise_level"] = frame.noise_levels[alarms[i].level];
    }
    return list_or_null(std::move(json));
}

Json features_json(const Results& frame) {
    Json json = Json::array();
    for (const FeatureResult& result : frame.features) {
        json.push_back(definition_json(result.name, result.unit, result.alarm));
    }
    return json;
}

// Noise levels, and the noise that they multiply, if the study can be read.
Json noise_json(const Results& frame, const std::optional<RunFacts>& facts) {
    Json json{{"levels", frame.noise_levels},
              {"reference", reference_level(frame.noise_levels)},
              {"sensor_m_s2", nullptr},
              {"encoder_rad", nullptr}};
    if (facts) {
        json["encoder_rad"] = facts->encoder_noise_rad;
        json["sensor_m_s2"] = analysis::json_of(facts->sensor_noise_m_s2);
    }
    return json;
}

}  // namespace

RunFindings findings_of_run(const Results& frame, const RowSource& rows,
                            const std::optional<analysis::Reliability>& reliability) {
    RunFindings run{.facts = run_facts(frame.provenance_value("study")),
                    .failures = failures_of(frame, rows),
                    .numerical = numerical_contributions(frame, rows),
                    .other_fault = other_fault_alarms(frame, rows),
                    .monitoring = monitoring_over_time(frame, rows),
                    .sensors = sensor_detections(frame, rows),
                    .contact_loss = summarise_contact_loss(frame, rows)};
    fill_report(frame, rows, reliability, run);
    return run;
}

std::vector<std::string> screen_end(const std::string& file, bool part) {
    if (part) {
        return {"results: " + file,
                "Join it with all other parts: gearpod merge " + file + " ... --out WHOLE.h5"};
    }
    return {"results: " + file, fmt::format("All findings: gearpod report {} --full", file)};
}

nlohmann::json definition_json(std::string_view name, std::string_view unit,
                               analysis::Alarm alarm) {
    const features::Feature* feature = features::find_feature(name);
    return {{"name", name},
            {"title", feature != nullptr ? std::string(feature->title) : ""},
            {"unit", unit},
            {"alarm", analysis::alarm_name(alarm)},
            {"doc", feature != nullptr ? std::string(feature->doc) : ""}};
}

nlohmann::json report_json(const Results& frame, const RowSource& rows,
                           const std::optional<analysis::Reliability>& reliability,
                           const RunFindings& run) {
    Json json = examples_json(frame, rows);
    const std::optional<RunFacts>& facts = run.facts;
    const auto measured =
        facts ? std::nullopt : measuring_facts(frame.provenance_value("measured_by_study"));
    json["title"] = facts ? facts->ensemble.title : measured ? measured->title : "";
    json["assumptions"] = facts ? facts->conditions + " " + facts->record.conditions : "";
    json["fault"] = facts && facts->fault.given() ? Json(facts->fault.words) : Json(nullptr);
    json["detection"] = analysis::detection_json(frame.detection, frame.request, subject_of(frame));
    json["reliability"] =
        reliability ? analysis::reliability_json(*reliability, frame.request) : Json(nullptr);
    json["smallest_fault"] =
        analysis::smallest_faults_json(frame.detection, reliability ? &*reliability : nullptr);
    json["best_feature"] = run.best_feature;
    json["findings"] = analysis::findings_json(run.report);
    json["numerical"] = numerical_json(frame, run.numerical);
    json["step_error"] = analysis::json_of(frame.step_error);
    json["contact_loss"] = list_or_null(analysis::json_of(run.contact_loss));
    json["sensors"] = sensors_json(run.sensors);
    json["other_fault"] = other_fault_json(frame, run.other_fault);
    json["features"] = features_json(frame);
    json["noise"] = noise_json(frame, facts);
    json["failures"] = failures_json(frame, run.failures);
    json["monitoring"] = run.monitoring ? monitoring_json(*run.monitoring) : Json(nullptr);
    json["gearboxes"] = json["failures"]["gearboxes"];
    json["failed"] = run.failures.counts.failed();
    json["provenance"] = Json::object();
    for (const auto& [name, value] : frame.provenance) {
        json["provenance"][name] = value;
    }
    json["timing"] = Json::object();
    for (const Timing& timing : frame.timing) {
        json["timing"][timing.name] = timing.seconds;
    }
    return json;
}

nlohmann::json report_json(const Results& frame, const RowSource& rows,
                           const std::optional<analysis::Reliability>& reliability) {
    return report_json(frame, rows, reliability, findings_of_run(frame, rows, reliability));
}

}  // namespace gearpod::mc
