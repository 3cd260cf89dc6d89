#include "analysis/report/evidence/evidence.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <span>
#include <string_view>

#include "analysis/detection/detection_table.hpp"
#include "analysis/report/wording.hpp"
#include "features/feature.hpp"

namespace gearpod::analysis {
namespace {

using Block = std::variant<Statement, Table>;

// A subject of the evidence. `keys` name the findings that belong to it; one that ends in a point
// stands for all keys with this beginning.
struct EvidenceSubject {
    const char* key;
    const char* title;
    const char* monitoring;  // what it is in the terms of AMC1 29.1465
    const char* inspection;  // what it is in the terms of MIL-HDBK-1823A
    std::vector<std::string_view> keys;
};

const std::array<EvidenceSubject, 8>& evidence_subjects() {
    static const std::array<EvidenceSubject, 8> all{{
        {"definition",
         "Definition of the indicators",
         "indicator, the component and the kind of damage that it monitors",
         "inspection system and its response a-hat",
         {"evidence.indicators"}},
        {"threshold",
         "Thresholds and their derivation",
         "alert threshold",
         "decision threshold",
         {"thresholds.", "tails", "threshold", "conditions.", "costs.", "costs_rarest.",
          "monitoring.how", "basis.thresholds", "facts"}},
        {"false_alarms",
         "False-alarm evidence",
         "false alerts",
         "noise analysis and false calls; trade-off with detection",
         {"shortage", "monitoring.sample", "monitoring.drift", "monitoring.note", "false_alarms.",
          "no_false_alarms.", "false_calls", "other_fault", "other_fault.", "noise.", "trade_off",
          "effect"}},
        {"detection",
         "Detection evidence",
         "detection of incipient damage, and its lead",
         "POD(a), a90 and its confidence bound; hit/miss or a-hat data",
         {"headline",
          "headline.",
          "figure",
          "smallest_fault",
          "sizes",
          "bound",
          "coverage",
          "measured_coverage",
          "curves.",
          "rates.",
          "sensors",
          "sensors.",
          "reliable_sizes",
          "responses.",
          "responses_refused.",
          "monitoring",
          "monitoring.refusal",
          "over_time",
          "results",
          "terms",
          "unranked.",
          "curve",
          "parameters",
          "line",
          "smooth",
          "correlation",
          "scales",
          "growing",
          "ceiling",
          "demonstrated",
          "repeats",
          "firth",
          "all_found",
          "target"}},
        {"limits",
         "Assumptions, conditions and limits",
         "operating conditions for which the application is shown",
         "targets and conditions of the demonstration",
         {"assumptions", "holds", "unknown", "unknown.", "limit.", "warning.", "part", "incomplete",
          "interpolation", "numerical", "numerical.", "step_error", "contact_loss", "contact.how",
          "failed", "failures", "failures.", "too_many", "note."}},
        {"data",
         "Data",
         "vibration data acquired",
         "specimens and raw data",
         {"table", "values.", "basis."}},
        {"software",
         "Software",
         "processing and its software",
         "software of the demonstration, as it is to be used",
         {}},
        {"further", "Further findings", "", "", {}},
    }};
    return all;
}

// Keys as in EvidenceSubject::keys.
using Keys = std::span<const std::string_view>;

bool belongs(const std::string& key, Keys keys) {
    return std::any_of(keys.begin(), keys.end(), [&](std::string_view prefix) {
        return prefix.ends_with('.') ? key.starts_with(prefix) : key == prefix;
    });
}

const std::string& key_of(const Block& block) {
    return std::visit([](const auto& shown) -> const std::string& { return shown.key; }, block);
}

// Place of the subject to which a finding belongs; the last one if to none.
std::size_t subject_of_finding(const std::string& key) {
    const auto& all = evidence_subjects();
    const auto found = std::find_if(all.begin(), all.end(), [&](const EvidenceSubject& subject) {
        return belongs(key, subject.keys);
    });
    return found == all.end() ? all.size() - 1 : static_cast<std::size_t>(found - all.begin());
}

bool has_finding(const Section& section, Keys keys) {
    return std::any_of(section.blocks.begin(), section.blocks.end(),
                       [&](const Block& block) { return belongs(key_of(block), keys); });
}

Table indicator_table(const std::vector<std::string>& names) {
    Table table{"evidence.indicators",
                "",
                {"indicator", "in words", "unit", "alarm if", "definition and source"},
                {}};
    for (const std::string& name : names) {
        const features::Feature* feature = features::find_feature(name);
        if (feature == nullptr) {
            table.rows.push_back({name, "-", "-", "-",
                                  "Not an indicator of this program; the study names the program "
                                  "that computes it."});
            continue;
        }
        table.rows.push_back({name, std::string(feature->title),
                              feature->unit == "1" ? "ratio" : std::string(feature->unit),
                              alarm_name(feature->alarm), std::string(feature->doc)});
    }
    return table;
}

const char* evidence_rows(EvidenceKind kind) {
    switch (kind) {
        case EvidenceKind::gearboxes:
            return "simulated gearboxes";
        case EvidenceKind::recordings:
            return "measured recordings";
        case EvidenceKind::lives:
            return "simulated gearboxes whose cracks grow until the tooth fails";
        case EvidenceKind::inspections:
            return "a table of inspections";
    }
    return "";
}

// Rule by which thresholds follow from healthy values; "" without such thresholds.
std::string threshold_rule(const EvidenceSource& source, const Report& sorted) {
    const auto has = [&](std::initializer_list<std::string_view> keys) {
        return std::any_of(sorted.sections.begin(), sorted.sections.end(),
                           [&](const Section& section) { return has_finding(section, keys); });
    };
    if (source.kind == EvidenceKind::inspections || !has({"thresholds."})) {
        return "";
    }
    const std::string_view tail =
        " Where the sample is too small for the rate, a generalised Pareto distribution of its "
        "most "
        "extreme values extrapolates it.";
    return fmt::format(
        "A threshold is the order statistic of rank r = ceil((n + 1)(1 - q)) of n healthy values, "
        "in "
        "the order of the alarm side, for the false-alarm rate q. Its rate has the Beta(n + 1 - r, "
        "r) distribution (Wilks 1941), from which its interval follows; values of one gearbox "
        "count "
        "with their effective number.{}",
        has({"tails"}) ? tail : "");
}

// Evidence that the results do not provide under each subject, by its key.
std::map<std::string, std::vector<std::string>> absent_evidence(const EvidenceSource& source,
                                                                const Report& sorted) {
    const auto has = [&](std::string_view subject, std::initializer_list<std::string_view> keys) {
        return std::any_of(sorted.sections.begin(), sorted.sections.end(),
                           [&](const Section& section) {
                               return section.key == subject && has_finding(section, keys);
                           });
    };
    const bool simulated =
        source.kind == EvidenceKind::gearboxes || source.kind == EvidenceKind::lives;
    std::map<std::string, std::vector<std::string>> absent;
    if (source.kind == EvidenceKind::inspections) {
        absent["definition"].emplace_back(
            "a definition of the response (the table has only its values)");
    }
    if (source.kind == EvidenceKind::recordings) {
        absent["definition"].emplace_back(
            "the component and the kind of damage behind the label of the faulty recordings");
    }
    if (!has("threshold", {"thresholds.", "threshold", "monitoring.how", "basis.thresholds"})) {
        absent["threshold"].emplace_back(
            source.kind == EvidenceKind::inspections
                ? "a threshold (the table has decisions, hit or miss)"
                : "a threshold (see the false-alarm evidence for the reason)");
    }
    if (!has("false_alarms", {"monitoring.sample"})) {
        absent["false_alarms"].emplace_back(
            source.kind == EvidenceKind::recordings
                ? "held-out alarms (the recordings have no times, or are not watched over time)"
            : source.kind == EvidenceKind::inspections && !has("false_alarms", {"false_calls"})
                ? "false calls (the table has no rows without flaw)"
                : "");
    }
    absent["false_alarms"].emplace_back(
        simulated ? "alarms of real machines in service"
                  : "a rate per flight hour over a fleet (alarms are counted per record)");
    const bool curves = has("detection", {"curves."}) && has("detection", {"smallest_fault"});
    if (!curves && !has("detection", {"curve", "results", "smooth"})) {
        absent["detection"].emplace_back(
            "a POD curve with a90 and its bound (it needs faulty rows of several known sizes)");
    }
    if (source.kind != EvidenceKind::inspections && !has("detection", {"monitoring", "results"})) {
        absent["detection"].emplace_back(
            source.kind == EvidenceKind::gearboxes
                ? "sustained alarms and the lead before failure (`gearpod lives` provides them)"
                : "sustained alarms and the lead before failure (they need times and a later "
                  "fault)");
    }
    absent["detection"].emplace_back(
        simulated ? "detection on real machines, in tests with seeded faults or in service"
                  : "an independent check of the labels and sizes that the table states");
    if (source.kind == EvidenceKind::recordings && !source.has_hashes) {
        absent["data"].emplace_back(
            "hashes of the recordings (the results are of an earlier version; run `features` "
            "again)");
    }
    if (!simulated) {
        absent["data"].emplace_back("calibration of the sensors, and how the data were acquired");
    }
    for (auto& [key, texts] : absent) {
        std::erase(texts, "");
    }
    return absent;
}

std::string held_text(const Section& section) {
    std::size_t statements = 0, tables = 0;
    for (const Block& block : section.blocks) {
        (std::holds_alternative<Table>(block) ? tables : statements)++;
    }
    const auto count = [](std::size_t number, const char* name) {
        return fmt::format("{} {}{}", number, name, number == 1 ? "" : "s");
    };
    return statements + tables == 0
               ? "not provided"
               : fmt::format("{}, {}", count(statements, "statement"), count(tables, "table"));
}

Section scope_section(const EvidenceSource& source, const std::vector<Section>& sections) {
    Section scope{"scope", "Scope", {}};
    scope.state(
        "evidence.scope",
        fmt::format("Evidence on vibration indicators from {}. It is arranged by subjects of EASA "
                    "AMC1 29.1465 (vibration health monitoring) and of MIL-HDBK-1823A "
                    "(reliability assessment of inspection systems). The table names subjects, "
                    "not clauses: those texts and the authority decide what has to be shown. This "
                    "document is no statement of compliance.",
                    evidence_rows(source.kind)));
    Table map{"evidence.map",
              "Subjects",
              {"subject", "in AMC1 29.1465", "in MIL-HDBK-1823A", "in this document"},
              {}};
    for (std::size_t i = 0; i + 1 < sections.size(); ++i) {
        const EvidenceSubject& subject = evidence_subjects()[i];
        map.rows.push_back(
            {subject.title, subject.monitoring, subject.inspection, held_text(sections[i])});
    }
    scope.add(std::move(map));
    scope.state(
        "evidence.outside",
        "Not provided by any result of gearpod: the airborne and ground installation and its "
        "qualification (sensors, wiring, acquisition, storage, transfer, display), the "
        "instructions for its operation and for the action on an alarm, and experience in "
        "service.");
    return scope;
}

}  // namespace

Table healthy_alarms_table(const std::vector<FeatureDetection>& detection,
                           const DetectionRequest& request, const std::string& rows) {
    Table table{"evidence.healthy",
                fmt::format("Alarms of healthy {}, by part of the sample", rows),
                {"indicator", "noise", "of those that set the threshold",
                 "smallest rate that they can set", "of others, not used for the threshold",
                 fmt::format("false-alarm rate of the others at {} (Clopper-Pearson)",
                             percent_text(request.confidence))},
                {}};
    table.labels = 2;
    for (const FeatureDetection& feature : detection) {
        for (const LevelDetection& level : feature.levels) {
            if (level.threshold_sample == 0) {
                continue;
            }
            const auto healthy = std::find_if(
                level.cells.begin(), level.cells.end(),
                [](const DetectionCell& cell) { return cell.size.high == 0.0 && cell.tested > 0; });
            const bool counted = healthy != level.cells.end();
            table.rows.push_back(
                {feature.feature, "x " + number_text(level.noise_level),
                 fmt::format("{} of {}", level.threshold_alarms, level.threshold_sample),
                 fmt::format("1 in {}", level.threshold_sample + 1),
                 counted ? fmt::format("{} of {}", healthy->detected, healthy->tested) : "-",
                 counted ? rate_interval_text(healthy->exact) : "-"});
        }
    }
    return table;
}

Report evidence_report(const EvidenceSource& source) {
    const auto& subjects = evidence_subjects();
    Report sorted;
    for (const EvidenceSubject& subject : subjects) {
        sorted.sections.push_back({subject.key, subject.title, {}});
    }
    const auto section_of = [&](std::string_view key) -> Section& {
        return *std::find_if(sorted.sections.begin(), sorted.sections.end(),
                             [&](const Section& section) { return section.key == key; });
    };
    if (source.kind != EvidenceKind::inspections) {
        section_of("definition").add(indicator_table(source.indicators));
    }
    std::set<std::string> stated;
    for (const Section& section : source.findings.sections) {
        for (const Block& block : section.blocks) {
            const auto* statement = std::get_if<Statement>(&block);
            if (statement == nullptr || stated.insert(statement->text).second) {
                sorted.sections[subject_of_finding(key_of(block))].blocks.push_back(block);
            }
        }
    }
    section_of("threshold").state("evidence.rule", threshold_rule(source, sorted));
    for (const auto& [subject, block] : source.added) {
        section_of(subject).blocks.push_back(block);
    }
    const auto absent = absent_evidence(source, sorted);
    Section scope = scope_section(source, sorted.sections);
    for (const auto& [key, texts] : absent) {
        section_of(key).state(
            "evidence.absent." + key,
            texts.empty() ? "" : "Not provided by this study: " + joined(texts) + ".");
    }
    Report report;
    report.add(std::move(scope));
    for (Section& section : sorted.sections) {
        report.add(std::move(section));
    }
    return report;
}

}  // namespace gearpod::analysis
