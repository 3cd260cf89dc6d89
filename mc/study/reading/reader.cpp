// read_study(): reads, completes and checks a study.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "features/feature.hpp"
#include "mc/files/input/document.hpp"
#include "mc/files/input/spelling.hpp"
#include "mc/files/input/terminal_text.hpp"
#include "mc/study/assumptions.hpp"
#include "mc/study/fluctuations.hpp"
#include "mc/study/reading/parts.hpp"
#include "mc/study/schema/former_keys.hpp"
#include "mc/study/schema/schema.hpp"

namespace gearpod::mc {

namespace {

// `prefix`: name of the table within the section and a dot, or empty.
void read_entries(StudyDraft& draft, const std::string& section, const std::string& prefix,
                  const std::vector<Entry>& entries) {
    for (Entry entry : entries) {
        entry.name = prefix + entry.name;
        if (const Key* key = find_key(section, entry.name)) {
            read_value(draft, *key, entry);
        } else if (!is_table(section + "." + entry.name)) {
            reject_unknown_key(draft, "", section, entry);
        } else if (entry.value.kind == Value::Kind::table) {
            draft.sections[section + "." + entry.name] = entry.value.position;
            read_entries(draft, section, entry.name + ".", entry.value.entries);
        } else {
            draft.reject(entry.position, section + "." + entry.name,
                         fmt::format("must be a table, but is {}", entry.value.shown()),
                         fmt::format("write {} = {{ key = value, ... }}", entry.name));
        }
    }
}

void read_section(StudyDraft& draft, const Entry& section) {
    read_entries(draft, section.name, "", section.value.entries);
}

void read_title(StudyDraft& draft, const Entry& entry) {
    if (entry.value.kind == Value::Kind::text && !is_printable(entry.value.text)) {
        draft.reject(entry.position, "title", "contains control characters",
                     "write one line of text");
    } else if (entry.value.kind == Value::Kind::text) {
        draft.study.title = entry.value.text;
    } else {
        draft.reject(entry.position, "title",
                     fmt::format("must be a string, but is {}", entry.value.shown()), "");
    }
}

// Rejects a top-level name that is no section: a key outside its section, or a misspelling.
void reject_unknown_section(StudyDraft& draft, const Entry& entry) {
    if (const std::string table = "gearbox." + entry.name; is_table(table)) {
        draft.reject(entry.position, entry.name, "unknown section",
                     fmt::format("write [{}]", table));
        return;
    }
    for (const Key& key : schema()) {
        if (key.label() == entry.name) {
            draft.reject(entry.position, entry.name, "unknown section",
                         fmt::format("the key belongs in [{}]", key.table()));
            return;
        }
    }
    const auto names = section_names();
    std::vector<std::string_view> candidates(names.begin(), names.end());
    candidates.push_back("title");
    const std::string words = suggest(entry.name, candidates);
    draft.reject(entry.position, entry.name, "unknown section",
                 words.empty() ? fmt::format("use one of {}", fmt::join(candidates, ", ")) : words);
    if (words.starts_with("did you mean")) {
        // The section that was meant is not reported as missing as well.
        draft.bad.insert(std::string(nearest(entry.name, candidates)));
    }
}

void read_sections(StudyDraft& draft, const Value& document) {
    const auto names = section_names();
    for (const Entry& entry : document.entries) {
        if (entry.name == "title") {
            read_title(draft, entry);
            continue;
        }
        if (std::find(names.begin(), names.end(), entry.name) == names.end()) {
            reject_unknown_section(draft, entry);
            continue;
        }
        draft.sections[entry.name] = entry.value.position;
        if (entry.value.kind != Value::Kind::table) {
            draft.reject(entry.position, entry.name,
                         fmt::format("must be a section, but is {}", entry.value.shown()),
                         fmt::format("write [{}]", entry.name));
        } else if (entry.name != "random") {
            read_section(draft, entry);
        }
    }
    // Read after all nominal values, because it sets those that are absent.
    const Entry* random = document.find("random");
    if (random != nullptr && random->value.kind == Value::Kind::table) {
        read_random(draft, random->value);
    }
}

// Rates of a record between which thresholds make sense.
constexpr double kLeastRate = 1e-9, kMostRate = 0.5;

// By default the basic features for which the type of motion has signals; then those in Python.
void fill_features(Study& study, bool runs_python) {
    if (study.features.use.empty()) {
        for (const features::Feature& feature : features::all_features()) {
            if (feature.basic() && (!feature.from_sensor || !study.effects.quasi_static())) {
                study.features.use.emplace_back(feature.name);
            }
        }
    }
    for (PythonFeature& one : study.features.python) {
        if (study.effects.quasi_static()) {  // no accelerations
            features::Feature of_te = *one.feature;
            of_te.needs = features::SignalSet::of<features::TeTurn>();
            of_te.from_sensor = false;
            one.feature = &features::declare_feature(of_te);
        }
        const std::string name(one.feature->name);
        // A stored study names all of them.
        if (runs_python &&
            std::ranges::find(study.features.use, name) == study.features.use.end()) {
            study.features.use.push_back(name);
        }
    }
}

void fill_detectors(Study& study) {
    if (study.monitoring.detectors.empty()) {
        study.monitoring.detectors = {"single", "2 of 3", "ewma 0.2", "cusum 0.5", "trend 100"};
    }
}

// By default the sun is the input and has the given torque, or the ring if the sun is fixed.
void fill_operation(StudyDraft& draft) {
    Operation& o = draft.study.operation;
    const Member usual = o.fixed == Member::sun ? Member::ring : Member::sun;
    if (!draft.is_given("operation.input")) {
        o.input = usual;
    }
    if (!draft.is_given("operation.torque_on")) {
        o.torque_on = usual;
    }
}

// No transmission path by default if the sensor is on a bearing or has nothing to measure.
void fill_path(StudyDraft& draft) {
    Study& study = draft.study;
    if (!draft.is_given("effects.path") &&
        (study.gearbox.kind == GearboxKind::fixed_shaft || study.effects.quasi_static())) {
        study.effects.path = nullptr;
    }
}

void fill_lanes(StudyDraft& draft) {
    Numerics& n = draft.study.numerics;
    if (!draft.is_given("numerics.lanes")) {
        n.lanes = full_lanes(n.precision);
    }
}

// Converts the target of false alarms into the rate of one record.
void fill_false_alarm_rate(StudyDraft& draft) {
    Detection& d = draft.study.detection;
    const char* key = "detection.false_alarms_per_1000_h";
    const std::optional<double> interval_h = record_interval_h(draft.study);
    if (!has_alarm_target(draft.study) || !interval_h ||
        !draft.all_usable({key, "detection.machines", "detection.record_interval_h",
                           "life.interval_h", "detection.false_alarm_rate"})) {
        return;
    }
    const double rate = alarm_target_per_hour(draft.study) * *interval_h / d.machines;
    // A target of --set replaces the file's rate.
    const bool replaces_rate = draft.position(key).file == kOverrideFile &&
                               draft.position("detection.false_alarm_rate").file != kOverrideFile;
    if (!(rate > kLeastRate && rate < kMostRate)) {
        draft.reject(
            key,
            fmt::format("is {:.2g} false alarms in each record of a machine ({:g} machines, "
                        "a record every {:g} h)",
                        rate, static_cast<double>(d.machines), *interval_h),
            fmt::format("choose a target between {:g} and {:g} in a record", kLeastRate,
                        kMostRate));
    } else if (!draft.is_given("detection.false_alarm_rate") || replaces_rate) {
        d.false_alarm_rate = rate;
    } else if (std::abs(rate - d.false_alarm_rate) > 1e-9 * rate) {
        draft.reject("detection.false_alarm_rate",
                     fmt::format("conflicts with {}, which is a rate of {:.4g}", key, rate),
                     "remove one of them");
    }
}

// Without identical mesh periods, all of them are integrated.
void fill_horizon(StudyDraft& draft) {
    if (!draft.is_given("numerics.horizon") && !reason_not_periodic(draft.study).empty()) {
        draft.study.numerics.horizon = Horizon::full;
    }
}

// Notice of a distribution that an override replaced by one value.
Problem lost_scatter(const std::string& key) {
    return {
        std::string(kOverrideFile), 0, key,
        "replaces its distribution in [random]: all gearboxes have this value",
        fmt::format("to keep a scatter, write '{}={{distribution=\"normal\", mean=..., sd=...}}'",
                    key)};
}

StudyReading read_document(const Value& document, bool runs_python, Problems problems,
                           Problems notices) {
    StudyDraft draft;
    draft.runs_python = runs_python;
    draft.problems = std::move(problems);
    draft.notices = std::move(notices);
    draft.sections[""] = document.position;
    read_sections(draft, document);
    fill_horizon(draft);
    check_faulty_member(draft);
    check_presence(draft);
    fill_features(draft.study, draft.runs_python);
    fill_detectors(draft.study);
    fill_operation(draft);
    fill_path(draft);
    fill_lanes(draft);
    fill_false_alarm_rate(draft);
    check_gears(draft);
    check_consistency(draft);
    check_numerics(draft);
    check_fault(draft);
    check_records(draft);
    check_life(draft);
    sort_problems(draft.problems);
    StudyReading reading;
    if (draft.problems.empty()) {
        reading.study = std::move(draft.study);
    }
    reading.problems = std::move(draft.problems);
    reading.notices = std::move(draft.notices);
    return reading;
}

}  // namespace

StudyReading read_study_text(const std::string& text, const std::string& name,
                             const std::vector<std::string>& overrides, PythonFiles python_files) {
    Problems problems;
    Value document = parse_document(text, name, problems);
    if (!problems.empty()) {
        return {std::nullopt, std::move(problems)};
    }
    FormerKeys former;
    former.replace(document, problems);
    for (const std::string& assignment : overrides) {
        apply_override(document, former.replace(assignment), problems);
    }
    former.replace(document, problems);
    Problems notices = former.notices();
    for (const std::string& key : drop_overridden_random(document)) {
        notices.push_back(lost_scatter(key));
    }
    return read_document(document, python_files == PythonFiles::run, std::move(problems),
                         std::move(notices));
}

StudyReading read_study(const std::string& path, const std::vector<std::string>& overrides) {
    Problems problems;
    const std::string text = read_file(path, problems);
    if (!problems.empty()) {
        return {std::nullopt, std::move(problems)};
    }
    return read_study_text(text, path, overrides, PythonFiles::run);
}

}  // namespace gearpod::mc
