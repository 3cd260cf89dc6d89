#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "mc/files/input/spelling.hpp"
#include "mc/files/signal_file.hpp"
#include "mc/study/copula.hpp"
#include "mc/study/distributions/range.hpp"
#include "mc/study/elements/list_element.hpp"
#include "mc/study/reading/parts.hpp"
#include "mc/study/schema/schema.hpp"

namespace gearpod::mc {
namespace {

constexpr std::string_view kCorrelations = "correlations";

void reject(StudyDraft& draft, const Entry& entry, const std::string& path, std::string what,
            std::string remedy) {
    draft.reject(entry.position, "random." + path, std::move(what), std::move(remedy));
}

void check_support(StudyDraft& draft, const Key& key, const Entry& entry,
                   const Distribution& distribution) {
    const Support support = distribution.in_unit_of_file().support();
    if (key.range.contains(support)) {
        return;
    }
    const auto bound = [](double value) { return fmt::format("{:.6g}", value); };
    std::string what =
        fmt::format("{} has values from {} to {}, but {} must be {}", distribution.name(),
                    bound(support.low), bound(support.high), key.name, key.range.text());
    reject(draft, entry, key.path(), std::move(what),
           distribution.name() == "normal" ? "use lognormal or truncated-normal"
                                           : "narrow the distribution");
}

// Replaces `file` and `column` of an empirical distribution by its values. Columns of the same file
// are sampled by row, in a group number far above those that studies use.
Value with_values(StudyDraft& draft, const Key& key, const Entry& entry) {
    constexpr int kFileGroups = 900'000;
    Value table = entry.value;
    const auto source = file_column(table);
    if (!source || table.find("values") != nullptr) {
        return table;
    }
    const Position position = entry.position;
    Entry values{"values", {}, position}, rows{"rows", {}, position};
    try {
        values.value = list_of(*source, key.path(), position, kMostElements);
    } catch (const SignalError& error) {
        reject(draft, entry, key.path(), error.what(), "name a file and one of its columns");
        draft.bad.insert(key.path());
    }
    const auto known = std::ranges::find(draft.random_files, source->file);
    rows.value.kind = Value::Kind::integer;
    rows.value.integer = kFileGroups + (known - draft.random_files.begin());
    rows.value.number = static_cast<double>(rows.value.integer);
    if (known == draft.random_files.end()) {
        draft.random_files.push_back(source->file);
    }
    std::erase_if(table.entries, [](const Entry& source_entry) {
        const std::string& name = source_entry.name;
        return name == "file" || name == "column" || name == "rows";
    });
    table.entries.push_back(std::move(values));
    table.entries.push_back(std::move(rows));
    std::ranges::sort(table.entries, {}, &Entry::name);
    return table;
}

// Checks a distribution with per = "record" or "assembly". Such values are quantiles of a variate
// of the record or assembly, so the distribution needs a quantile function.
void check_record_law(StudyDraft& draft, const Key& key, const Entry& entry,
                      const Distribution& distribution) {
    const std::string per = key.path() + ".per";
    if (distribution.per() == DrawnPer::gearbox) {
        return;
    }
    if (key.section == "fault" || key.section == "life") {
        reject(draft, entry, per,
               fmt::format("{} is the same in all records of a gearbox", key.name), "remove per");
    } else if (distribution.rows().group > 0) {
        reject(draft, entry, per, "values that vary from record to record cannot be sampled by row",
               "remove rows, and give values");
    } else if (!distribution.has_quantile()) {
        reject(draft, entry, per,
               fmt::format("{} takes its values in turn, from gearbox to gearbox",
                           distribution.name()),
               "use discrete or another distribution");
    }
}

// Inputs that use the same rows must have the same number of values.
void check_rows(StudyDraft& draft) {
    for (const RandomInput& input : draft.study.random) {
        const Distribution::Rows rows = input.distribution.rows();
        const auto first = std::ranges::find_if(draft.study.random, [&](const RandomInput& other) {
            return other.distribution.rows().group == rows.group;
        });
        const std::size_t count = first->distribution.rows().count;
        if (rows.group > 0 && rows.count != count) {
            draft.reject(draft.given_random[input.key], "random." + input.key + ".values",
                         fmt::format("has {} values, but {} with the same rows has {}", rows.count,
                                     first->key, count),
                         "give the same number of values, or another value of rows");
        }
    }
}

// Record quantity that a key gives; empty for keys whose values belong to the gearbox.
std::optional<RecordQuantity> record_quantity(std::string_view key) {
    if (key == "operation.torque_N_m") {
        return RecordQuantity::torque;
    }
    if (key.starts_with("operation.") && key.ends_with("_speed_rpm")) {
        return RecordQuantity::speed;
    }
    if (key == "sensor.gain") {
        return RecordQuantity::gain;
    }
    if (key == "sensor.noise_m_s2") {
        return RecordQuantity::noise;
    }
    return std::nullopt;
}

InputKind kind_of(const Key& key) {
    return key.section == "sensor"  ? InputKind::sensor
           : key.section == "fault" ? InputKind::fault_size
                                    : InputKind::other;
}

void add_random(StudyDraft& draft, const Key& key, const Entry& entry) {
    const std::string path = key.path();
    if (!key.may_be_random()) {
        const bool numeric = std::holds_alternative<NumberAccess>(key.access) ||
                             std::holds_alternative<IntegerAccess>(key.access);
        const std::string why = numeric ? std::string(key.fixed_because) : "it is not a number";
        reject(draft, entry, path, "may not be random (" + why + ")",
               fmt::format("give one value in [{}]", key.table()));
        return;
    }
    draft.given_random[path] = entry.position;
    const Value table = with_values(draft, key, entry);
    if (draft.bad.contains(path)) {
        draft.bad.insert("random." + path);
        return;
    }
    const auto distribution =
        Distribution::read(table, "random." + path, draft.problems, key.unit.to_si);
    if (!distribution) {
        draft.bad.insert(path);
        draft.bad.insert("random." + path);
        return;
    }
    check_support(draft, key, entry, *distribution);
    check_record_law(draft, key, entry, *distribution);
    draft.study.random.push_back(
        {path, std::string(key.unit.name), *distribution, kind_of(key), record_quantity(path)});
    if (!draft.given.contains(path)) {
        std::get<NumberAccess>(key.access).set(draft.study, distribution->median());
    }
}

// `prefix`: name of the table within the section and a dot, or empty.
void read_random_section(StudyDraft& draft, const std::string& section, const std::string& prefix,
                         const std::vector<Entry>& entries) {
    for (Entry entry : entries) {
        entry.name = prefix + entry.name;
        if (const Key* key = find_key(section, entry.name)) {
            add_random(draft, *key, entry);
        } else if (entry.value.kind == Value::Kind::table && is_table(section + "." + entry.name)) {
            read_random_section(draft, section, entry.name + ".", entry.value.entries);
        } else {
            reject_unknown_key(draft, "random.", section, entry);
        }
    }
}

constexpr const char* kPair =
    "write { between = [\"section.key\", \"section.key\"], rank = 0.6 } for each pair";

class CorrelationReader {
  public:
    CorrelationReader(StudyDraft& draft, const Position& position, std::string which)
        : draft_(draft), position_(position), which_(std::move(which)) {}

    void read(const Value& table) {
        if (table.kind != Value::Kind::table) {
            return reject(fmt::format("must be a table, but is {}", table.shown()), kPair);
        }
        for (const Entry& entry : table.entries) {
            if (entry.name != "between" && entry.name != "rank") {
                reject("unknown key " + entry.name, suggest(entry.name, {"between", "rank"}));
            }
        }
        Correlation pair;
        read_inputs(table.find("between"), pair);
        read_rank(table.find("rank"), pair);
        if (good_) {
            add(pair);
        }
    }

    bool good() const { return good_; }

  private:
    void reject(const std::string& what, std::string remedy) {
        draft_.reject(position_, "random.correlations", which_ + ": " + what, std::move(remedy));
        good_ = false;
    }

    void read_inputs(const Entry* between, Correlation& pair) {
        const bool two = between != nullptr && between->value.elements.size() == 2 &&
                         std::ranges::all_of(between->value.elements, [](const Value& key) {
                             return key.kind == Value::Kind::text;
                         });
        if (!two) {
            return reject("between must list two keys of [random]", kPair);
        }
        pair.first = between->value.elements[0].text;
        pair.second = between->value.elements[1].text;
        check_input(pair.first);
        check_input(pair.second);
        if (good_ && pair.first == pair.second) {
            reject("both are " + pair.first, "name two inputs");
        }
    }

    void check_input(const std::string& key) {
        const RandomInput* input = draft_.study.find_random(key);
        if (input == nullptr) {
            std::vector<std::string_view> known;
            for (const RandomInput& other : draft_.study.random) {
                known.push_back(other.key);
            }
            good_ = false;  // a random input with a problem has its own message
            if (!draft_.bad.contains("random." + key)) {
                reject(key + " is not random", known.empty() ? "" : suggest(key, known));
            }
        } else if (input->kind == InputKind::fault_size) {
            reject(key + " is the fault size, which cannot be correlated with other inputs",
                   "correlate other inputs");
        } else if (input->distribution.per() != DrawnPer::gearbox) {
            reject(key +
                       " varies between the records of a gearbox (per), so it cannot be correlated "
                       "with "
                       "inputs of the gearbox",
                   "correlate other inputs");
        } else if (!input->distribution.has_quantile()) {
            reject(input->distribution.rows().group > 0
                       ? key + " is already sampled by row together with other inputs"
                       : fmt::format("{} takes its values in turn ({})", key,
                                     input->distribution.name()),
                   "correlate other inputs");
        }
    }

    void read_rank(const Entry* rank, Correlation& pair) {
        const bool number = rank != nullptr && (rank->value.kind == Value::Kind::number ||
                                                rank->value.kind == Value::Kind::integer);
        if (!number || !(std::abs(rank->value.number) < 1.0)) {
            return reject("rank must be a number > -1 and < 1, the rank correlation", kPair);
        }
        pair.rank = rank->value.number;
    }

    void add(const Correlation& pair) {
        const auto keys = [](const Correlation& known) {
            return std::minmax(known.first, known.second);
        };
        auto& all = draft_.study.correlations;
        const bool known = std::ranges::any_of(
            all, [&](const Correlation& other) { return keys(other) == keys(pair); });
        if (known) {
            return reject(fmt::format("{} and {} are correlated already", pair.first, pair.second),
                          "give a pair once");
        }
        all.push_back(pair);
    }

    StudyDraft& draft_;
    Position position_;
    std::string which_;
    bool good_ = true;
};

// Checks of the distributions in [random] that vary from record to record.

// Short form of a record distribution: its key and the scatter that it gives.
struct ShortForm {
    std::string key;
    double scatter;
};

ShortForm short_form(const Study& study, RecordQuantity quantity) {
    const Life& life = study.life;
    switch (quantity) {
        case RecordQuantity::torque:
            return life.interval_h ? ShortForm{"life.torque_scatter", life.torque_scatter}
                                   : ShortForm{"features.baseline_torque_scatter",
                                               study.features.baseline_torque_scatter};
        case RecordQuantity::speed:
            return {"life.speed_scatter", life.speed_scatter};
        case RecordQuantity::gain:
            return {"life.gain_scatter", life.gain_scatter};
        case RecordQuantity::noise:
            return {"life.noise_scatter", life.noise_scatter};
    }
    return {};
}

void check_input(StudyDraft& draft, const RandomInput& input) {
    const Study& study = draft.study;
    const auto quantity = input.quantity;
    const auto reject = [&](const std::string& what, const std::string& remedy) {
        draft.reject(draft.given_random[input.key], "random." + input.key + ".per", what, remedy);
    };
    const Key& key = *find_key(input.key);
    if (!quantity && study.life.interval_h) {
        reject(fmt::format("{} is the same in all records of a life", key.name),
               "remove per; only operation.torque_N_m, a speed, sensor.gain and sensor.noise_m_s2 "
               "can vary from record to record of a life");
    }
    if (quantity && std::get<NumberAccess>(key.access).get(study).value_or(0.0) <= 0.0) {
        reject("needs a nominal value above 0, about which the records scatter",
               fmt::format("give {} in [{}]", key.label(), key.table()));
    }
    const ShortForm same = quantity ? short_form(study, *quantity) : ShortForm{};
    if (same.scatter > 0.0) {
        reject("conflicts with " + same.key, "give the scatter of records only once");
    }
    if (study.ensemble.threshold_records > 1) {
        draft.reject("ensemble.threshold_records",
                     fmt::format("the {} records of a gearbox differ only in their noise, but {} "
                                 "varies from record to record",
                                 study.ensemble.threshold_records, input.key),
                     "remove threshold_records, or per in [random]");
    }
}

}  // namespace

void read_random(StudyDraft& draft, const Value& section) {
    for (const Entry& entry : section.entries) {
        if (entry.name == kCorrelations) {
            continue;
        }
        const auto names = section_names();
        const bool known =
            std::ranges::find(names, entry.name) != names.end() && entry.name != "random";
        if (!known) {
            reject(draft, entry, entry.name, "unknown section",
                   suggest(entry.name, {names.begin(), names.end()}) +
                       " (write section.key = { distribution = \"...\", ... })");
        } else if (entry.value.kind != Value::Kind::table) {
            reject(draft, entry, entry.name,
                   fmt::format("must be a table, but is {}", entry.value.shown()),
                   "write section.key = { distribution = \"...\", ... }");
        } else {
            read_random_section(draft, entry.name, "", entry.value.entries);
        }
    }
    // Sorted in the order of the schema, whatever their order in the file.
    const auto rank = [](const RandomInput& input) {
        const auto keys = schema();
        return std::ranges::find_if(keys, [&](const Key& key) { return key.path() == input.key; }) -
               keys.begin();
    };
    std::ranges::sort(draft.study.random,
                      [&](const auto& a, const auto& b) { return rank(a) < rank(b); });
    check_rows(draft);
    if (const Entry* correlations = section.find(kCorrelations)) {
        read_correlations(draft, *correlations);
    }
}

void read_correlations(StudyDraft& draft, const Entry& list) {
    if (list.value.kind != Value::Kind::array) {
        return draft.reject(list.position, "random.correlations",
                            fmt::format("must be a list of pairs, but is {}", list.value.shown()),
                            kPair);
    }
    bool good = true;
    for (std::size_t i = 0; i < list.value.elements.size(); ++i) {
        CorrelationReader reader(draft, list.position, fmt::format("pair {}", i + 1));
        reader.read(list.value.elements[i]);
        good = reader.good() && good;
    }
    if (good && !Copula(draft.study).exists()) {
        draft.reject(list.position, "random.correlations",
                     "no random inputs can have all these correlations (their matrix, with 0 for "
                     "pairs that are not listed, is not positive definite)",
                     "use smaller correlations, or list the missing pairs");
    }
}

// Runs only on a study without other problems.
void check_records(StudyDraft& draft) {
    if (!draft.problems.empty()) {
        return;
    }
    for (const RandomInput& input : draft.study.random) {
        if (input.distribution.per_record()) {
            check_input(draft, input);
        }
    }
}

}  // namespace gearpod::mc
