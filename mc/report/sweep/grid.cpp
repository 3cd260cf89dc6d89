#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstddef>
#include <map>
#include <nlohmann/json.hpp>
#include <regex>

#include "mc/files/input/document.hpp"
#include "mc/files/input/terminal_text.hpp"
#include "mc/report/sweep/summaries.hpp"
#include "mc/study/keys/key.hpp"
#include "mc/study/random/fnv.hpp"
#include "mc/study/schema/former_keys.hpp"

namespace gearpod::mc {
namespace {

std::string toml_string(const std::string& text) {
    static const std::regex special("[\"\\\\]");
    return "\"" + std::regex_replace(text, special, "\\$&") + "\"";
}

std::string toml_text(const Value& value) {
    std::vector<std::string> parts;
    switch (value.kind) {
        case Value::Kind::boolean:
            return value.boolean ? "true" : "false";
        case Value::Kind::integer:
            return fmt::format("{}", value.integer);
        case Value::Kind::number:
            return fmt::format("{}", value.number);
        case Value::Kind::text:
        case Value::Kind::date:
            return toml_string(value.text);
        case Value::Kind::array:
            for (const Value& element : value.elements) {
                parts.push_back(toml_text(element));
            }
            return fmt::format("[{}]", fmt::join(parts, ", "));
        case Value::Kind::table:
            for (const Entry& entry : value.entries) {
                parts.push_back(fmt::format("{} = {}", entry.name, toml_text(entry.value)));
            }
            return fmt::format("{{ {} }}", fmt::join(parts, ", "));
    }
    return "";
}

// Returns the value of the only key of a document made by an override.
const Value& nested_value(const Value& document, std::size_t depth) {
    return depth == 0 ? document : nested_value(document.entries.front().value, depth - 1);
}

// TOML text of a value without braces, quotation marks and the name of a distribution's kind.
std::string plain_text(const std::string& toml) {
    static const std::regex decoration("[{}\"]|distribution *= *"), equals(" *= *");
    const std::string text =
        std::regex_replace(std::regex_replace(toml, decoration, ""), equals, "=");
    const std::size_t first = text.find_first_not_of(' ');
    return first == std::string::npos
               ? ""
               : printable(text.substr(first, text.find_last_not_of(' ') + 1 - first));
}

// Replaces characters that are not portable in file names.
std::string file_name(const std::string& text) {
    static const std::regex left_out("[\" ]"), other("[^A-Za-z0-9_=.+-]");
    return std::regex_replace(std::regex_replace(text, left_out, ""), other, "-");
}

// Names a point. Inexact and long names end in a hash of the overrides.
void name_point(const std::vector<VariedKey>& keys, SweepPoint& point) {
    constexpr std::size_t kLongest = 100;
    std::string plain, whole;
    bool exact = true;
    for (std::size_t k = 0; k < keys.size(); ++k) {
        const std::string part = short_key(keys[k].key) + "=" + point.values[k];
        const std::string safe = file_name(part);
        exact = exact &&
                (safe == part || "\"" + safe.substr(safe.find('=') + 1) + "\"" == point.values[k]);
        plain += (plain.empty() ? "" : "_") + safe;
        whole += point.overrides[k] + "\n";
    }
    const auto same_short = [&](const VariedKey& a) {
        return std::ranges::count_if(keys, [&](const VariedKey& b) {
                   return short_key(a.key) == short_key(b.key);
               }) > 1;
    };
    if (!exact || plain.size() > kLongest || std::ranges::any_of(keys, same_short)) {
        plain = fmt::format("{}_{:08x}", plain.substr(0, kLongest),
                            static_cast<std::uint32_t>(fnv1a(whole)));
    }
    point.name = plain;
}

}  // namespace

std::string short_key(const std::string& key) {
    // A key of a member is named with the member.
    const std::string name = key.starts_with("gearbox.") ? flat_path(key) : key;
    const std::size_t dot = name.find_last_of('.');
    return dot == std::string::npos ? name : name.substr(dot + 1);
}

std::vector<std::string> value_labels(const std::vector<std::string>& toml) {
    constexpr std::size_t kLongest = 28;
    std::vector<std::string> labels;
    for (const std::string& value : toml) {
        const std::string text = plain_text(value);
        labels.push_back(text.size() <= kLongest ? text : text.substr(0, kLongest - 3) + "...");
    }
    std::map<std::string, int> count;
    for (const std::string& label : labels) {
        ++count[label];
    }
    for (std::size_t i = 0; i < labels.size(); ++i) {
        if (count[labels[i]] > 1) {
            labels[i] = fmt::format("{}: {}", i + 1, labels[i]);
        }
    }
    return labels;
}

std::string point_text(const std::vector<VariedKey>& keys, const SweepPoint& point) {
    std::string text;
    for (std::size_t k = 0; k < keys.size(); ++k) {
        text +=
            fmt::format("{}{} = {}", k > 0 ? ", " : "", short_key(keys[k].key), point.labels[k]);
    }
    return text;
}

nlohmann::json values_json(const std::vector<VariedKey>& keys, const SweepPoint& point) {
    nlohmann::json json = nlohmann::json::object();
    for (std::size_t k = 0; k < keys.size(); ++k) {
        json[keys[k].key] = point.values[k];
    }
    return json;
}

std::vector<std::string> key_columns(const std::vector<VariedKey>& keys) {
    std::vector<std::string> columns;
    for (const VariedKey& key : keys) {
        columns.push_back(short_key(key.key));
    }
    return columns;
}

std::string names_text(const std::vector<std::string>& points) {
    constexpr std::size_t kMostNamed = 5;
    const std::size_t named = std::min(points.size(), kMostNamed);
    return fmt::format(
        "{}{}",
        fmt::join(points.begin(), points.begin() + static_cast<std::ptrdiff_t>(named), "; "),
        named < points.size() ? fmt::format("; and {} more", points.size() - named) : "");
}

std::string within_scatter_text(const std::string& begin, const char* beyond, std::size_t count,
                                const std::vector<std::string>& within) {
    const std::size_t compared = count + within.size();
    if (within.empty()) {
        return fmt::format("{} It is {} beyond scatter at {}.", begin, beyond,
                           count == 1 ? "the other point" : fmt::format("all {} others", count));
    }
    return count == 0
               ? fmt::format(
                     "{} No point differs from it beyond scatter ({} compared), so the "
                     "points cannot be ranked.",
                     begin, compared)
               : fmt::format("{} It is {} beyond scatter at {} of {} others; within scatter: {}.",
                             begin, beyond, count, compared, names_text(within));
}

analysis::Section files_section(const std::vector<VariedKey>& keys,
                                const std::vector<PointResults>& points) {
    constexpr std::size_t kMostNamed = 50;
    analysis::Section section{"files", "", {}};
    section.state("common",
                  "Every study draws the same gearboxes (common random numbers), so the points are "
                  "correlated: their intervals may overlap although the points differ.",
                  analysis::Shown::page);
    std::vector<std::string> varied;
    for (const VariedKey& key : keys) {
        std::vector<std::string> values;
        const std::vector<std::string> labels = value_labels(key.values);
        for (std::size_t i = 0; i < std::min(kMostNamed, key.values.size()); ++i) {
            values.push_back(labels[i].ends_with("...")
                                 ? fmt::format("{} {}", i + 1, plain_text(key.values[i]))
                                 : labels[i]);
        }
        varied.push_back(fmt::format("{} = {}", key.key, fmt::join(values, ", ")));
    }
    section.state("varied", fmt::format("Varied: {}.", fmt::join(varied, "; ")),
                  analysis::Shown::page);
    analysis::Table table{"files", "Results files", key_columns(keys), {}, analysis::Shown::page};
    table.columns.emplace_back("file");
    for (const auto& [point, results] : points) {
        table.rows.push_back(point.labels);
        table.rows.back().push_back(results);
    }
    section.add(std::move(table));
    return section;
}

std::vector<VariedKey> read_varied(const std::vector<std::string>& texts, Problems& problems) {
    std::vector<VariedKey> keys;
    for (const std::string& text : texts) {
        const auto reject = [&](const std::string& what, const std::string& remedy) {
            problems.push_back({"--vary", 0, text.substr(0, text.find('=')), what, remedy});
        };
        const std::string key = current_path(text.substr(0, text.find('=')));
        Value document;
        Problems own;
        apply_override(document, FormerKeys().replace(text), own);
        if (!own.empty()) {
            reject(own.front().what, "write section.key=[a, b, c]");
            continue;
        }
        const Value& value = nested_value(document, split(key, '.').size());
        if (value.kind != Value::Kind::array || value.elements.empty()) {
            reject(fmt::format("must be a list of values, but is {}",
                               value.kind == Value::Kind::array ? "empty" : value.shown()),
                   "write section.key=[a, b, c]");
            continue;
        }
        VariedKey varied{key, {}};
        for (const Value& element : value.elements) {
            varied.values.push_back(toml_text(element));
        }
        for (const std::string& one : varied.values) {
            if (std::ranges::count(varied.values, one) > 1) {
                reject(fmt::format("contains {} twice", one), "give every value once");
                break;
            }
        }
        if (std::ranges::count(keys, key, &VariedKey::key) > 0) {
            reject("is varied twice", "give all its values in one --vary");
        }
        keys.push_back(std::move(varied));
    }
    return keys;
}

std::vector<SweepPoint> grid_of(const std::vector<VariedKey>& keys) {
    std::vector<SweepPoint> points(1);
    for (const VariedKey& key : keys) {
        if (points.size() * key.values.size() > kMostPoints) {
            return {};
        }
        std::vector<SweepPoint> more;
        const std::vector<std::string> labels = value_labels(key.values);
        for (const SweepPoint& point : points) {
            for (std::size_t i = 0; i < key.values.size(); ++i) {
                SweepPoint next = point;
                next.values.push_back(key.values[i]);
                next.labels.push_back(labels[i]);
                next.overrides.push_back(key.key + "=" + key.values[i]);
                more.push_back(std::move(next));
            }
        }
        points = std::move(more);
    }
    for (SweepPoint& point : points) {
        name_point(keys, point);
    }
    return points;
}

}  // namespace gearpod::mc
