#include <fmt/format.h>

#include <algorithm>

#include "mc/files/signal_file.hpp"
#include "mc/input/spelling.hpp"
#include "mc/study/distributions/magnitude.hpp"
#include "mc/study/elements/file_column.hpp"
#include "mc/study/reading/parts.hpp"
#include "mc/study/reading/unknown_keys.hpp"
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
    const Support support = distribution.support();
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
    const Position at = entry.position;
    Entry values{"values", {}, at}, rows{"rows", {}, at};
    try {
        values.value = list_of(*source, key.path(), at, kMostElements);
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
    std::erase_if(table.entries, [](const Entry& one) {
        return one.name == "file" || one.name == "column" || one.name == "rows";
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

void add_random(StudyDraft& draft, const Key& key, const Entry& entry) {
    const std::string path = key.path();
    if (!key.may_be_random()) {
        const bool numeric = std::holds_alternative<NumberAccess>(key.access) ||
                             std::holds_alternative<IntegerAccess>(key.access);
        const std::string why = numeric ? std::string(key.fixed_because) : "it is not a number";
        reject(draft, entry, path, "may not be random (" + why + ")",
               fmt::format("give one value in [{}]", key.section));
        return;
    }
    draft.given_random[path] = entry.position;
    const Value table = with_values(draft, key, entry);
    if (draft.bad.contains(path)) {
        draft.bad.insert("random." + path);
        return;
    }
    const auto distribution = Distribution::read(table, "random." + path, draft.problems);
    if (!distribution) {
        draft.bad.insert(path);
        draft.bad.insert("random." + path);
        return;
    }
    check_support(draft, key, entry, *distribution);
    check_record_law(draft, key, entry, *distribution);
    draft.study.random.push_back({path, std::string(key.unit.name), *distribution, key.unit.to_si});
    if (!draft.given.contains(path)) {
        std::get<NumberAccess>(key.access)
            .set(draft.study, distribution->median() * key.unit.to_si);
    }
}

void read_random_section(StudyDraft& draft, const Entry& section) {
    for (const Entry& entry : section.value.entries) {
        const Key* key = find_key(section.name, entry.name);
        if (key != nullptr) {
            add_random(draft, *key, entry);
        } else {
            reject_unknown_key(draft, "random.", section.name, entry);
        }
    }
}

}  // namespace

void read_random(StudyDraft& draft, const Value& section) {
    for (const Entry& entry : section.entries) {
        if (entry.name == kCorrelations) {
            continue;
        }
        const auto names = section_names();
        const bool known = std::find(names.begin(), names.end(), entry.name) != names.end() &&
                           entry.name != "random";
        if (!known) {
            reject(draft, entry, entry.name, "unknown section",
                   suggest(entry.name, {names.begin(), names.end()}) +
                       " (write section.key = { distribution = \"...\", ... })");
        } else if (entry.value.kind != Value::Kind::table) {
            reject(draft, entry, entry.name,
                   fmt::format("must be a table, but is {}", entry.value.shown()),
                   "write section.key = { distribution = \"...\", ... }");
        } else {
            read_random_section(draft, entry);
        }
    }
    // Sorted in the order of the schema, whatever their order in the file.
    const auto rank = [](const RandomInput& input) {
        const auto keys = schema();
        return std::find_if(keys.begin(), keys.end(),
                            [&](const Key& key) { return key.path() == input.key; }) -
               keys.begin();
    };
    std::sort(draft.study.random.begin(), draft.study.random.end(),
              [&](const auto& a, const auto& b) { return rank(a) < rank(b); });
    check_rows(draft);
    if (const Entry* correlations = section.find(kCorrelations)) {
        read_correlations(draft, *correlations);
    }
}

}  // namespace gearpod::mc
