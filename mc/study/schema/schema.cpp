#include "mc/study/schema/schema.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>

#include "mc/files/input/terminal_text.hpp"
#include "mc/study/distributions/distribution.hpp"

namespace gearpod::mc {

std::span<const Key> schema() {
    static const std::vector<Key> keys = [] {
        std::vector<Key> all;
        for (const auto table : {gearbox_keys(), operation_keys(), fault_keys(), run_keys()}) {
            all.insert(all.end(), table.begin(), table.end());
        }
        return all;
    }();
    return keys;
}

const std::vector<KeyTable>& key_tables() {
    static const std::vector<KeyTable> tables = [] {
        std::vector<KeyTable> all;
        for (const std::string_view section : section_names()) {
            const auto first = static_cast<std::ptrdiff_t>(all.size());
            all.push_back({std::string(section), {}});
            for (const Key& key : schema()) {
                if (key.section == section) {
                    const auto found = std::ranges::find(all.begin() + first, all.end(),
                                                         key.table(), &KeyTable::name);
                    (found == all.end() ? all.emplace_back(key.table()) : *found)
                        .keys.push_back(&key);
                }
            }
        }
        return all;
    }();
    return tables;
}

bool is_table(std::string_view name) {
    return std::ranges::find(key_tables(), name, &KeyTable::name) != key_tables().end();
}

std::span<const std::string_view> section_names() {
    static constexpr std::array<std::string_view, 12> names{
        "gearbox",  "operation", "effects",    "fault", "sensor",   "random",
        "features", "detection", "monitoring", "life",  "numerics", "ensemble"};
    return names;
}

const Key* find_key(std::string_view section, std::string_view name) {
    const auto keys = schema();
    const auto found = std::ranges::find_if(
        keys, [&](const Key& key) { return key.section == section && key.name == name; });
    return found == keys.end() ? nullptr : &*found;
}

const Key* find_key(std::string_view path) {
    const std::size_t dot = path.find('.');
    return dot == std::string_view::npos ? nullptr
                                         : find_key(path.substr(0, dot), path.substr(dot + 1));
}

std::string_view choice_text(const Study& study, std::string_view section, std::string_view name) {
    const auto& access = std::get<ChoiceAccess>(find_key(section, name)->access);
    const auto value = access.get(study);
    for (const ChoiceName& choice : access.names) {
        if (value == choice.value) {
            return choice.text;
        }
    }
    return "";
}

namespace {

struct KindText {
    std::string operator()(const NumberAccess&) const { return "number"; }
    std::string operator()(const IntegerAccess&) const { return "integer"; }
    std::string operator()(const BooleanAccess&) const { return "true or false"; }
    std::string operator()(const NumbersAccess& list) const {
        return list.ascending ? "ascending list of numbers" : "list of numbers";
    }
    std::string operator()(const TextsAccess&) const { return "list of strings"; }
    std::string operator()(const TablesAccess& list) const {
        std::vector<std::string_view> names;
        for (const TableField& field : list.fields) {
            names.push_back(field.name);
        }
        return fmt::format("list of {{ {} }}", fmt::join(names, ", "));
    }
    std::string operator()(const PythonAccess&) const { return "list of Python files"; }
    std::string operator()(const ChoiceAccess& choice) const {
        std::vector<std::string> names;
        for (const ChoiceName& name : choice.names) {
            names.push_back(fmt::format("\"{}\"", name.text));
        }
        return fmt::format("{}", fmt::join(names, " | "));
    }
};

// Indented lines that fit kLineWidth.
std::string wrapped(const std::string& text, std::size_t indent) {
    return std::string(indent, ' ') + wrapped_text(text, indent) + '\n';
}

// True if a word of the text begins with `word`, ignoring case: "fault" is not in "default".
bool begins_word(std::string_view text, std::string_view word) {
    const auto same = [](char a, char b) {
        return std::tolower(static_cast<unsigned char>(a)) ==
               std::tolower(static_cast<unsigned char>(b));
    };
    auto from = text.begin();
    while ((from = std::search(from, text.end(), word.begin(), word.end(), same)) != text.end()) {
        if (from == text.begin() || std::isalnum(static_cast<unsigned char>(from[-1])) == 0) {
            return true;
        }
        ++from;
    }
    return word.empty();
}

// Further forms of [random]: word that finds them, text, and meaning.
struct RandomForm {
    const char *name, *form, *meaning;
};
constexpr RandomForm kRandomForms[] = {
    {"per", "SECTION.KEY = { ..., per = \"record\" }",
     "a new random value for every record of a gearbox, baseline records included; in lives for "
     "operation.torque_N_m, a speed, sensor.gain or sensor.noise_m_s2. per = \"assembly\" gives "
     "the "
     "baseline records another value than the test record. By default there is one value for each "
     "gearbox"},
    {"correlations",
     "correlations = [{ between = [\"SECTION.KEY\", \"SECTION.KEY\"], rank = R }, ...]",
     "rank correlation (Spearman's, between -1 and 1) of two random inputs, by a Gaussian copula, "
     "which keeps their distributions; 0 for pairs that are not given"}};

}  // namespace

std::string schema_help(std::string_view word) {
    std::string text;
    for (const KeyTable& table : key_tables()) {
        std::string body;
        for (const Key* key : table.keys) {
            if (!begins_word(key->path(), word) && !begins_word(key->doc, word)) {
                continue;
            }
            const std::string range = key->range.text();
            body += fmt::format("  {}\n", key->label()) +
                    wrapped(fmt::format("{}{}{}; {}", std::visit(KindText{}, key->access),
                                        range.empty() ? "" : " " + range,
                                        key->may_be_random() ? ", may be random" : "", key->doc),
                            6);
        }
        text += body.empty() ? "" : fmt::format("[{}]\n{}", table.name, body);
    }
    std::string random;
    for (const DistributionHelp& one : distribution_help()) {
        if (begins_word("random", word) || begins_word(one.name, word) ||
            begins_word(one.parameters, word)) {
            random += fmt::format("  SECTION.KEY = {{ distribution = \"{}\", ... }}\n", one.name) +
                      wrapped("with " + one.parameters, 6);
        }
    }
    for (const auto& [name, form, meaning] : kRandomForms) {
        if (begins_word("random", word) || begins_word(name, word)) {
            random += fmt::format("  {}\n", form) + wrapped(meaning, 6);
        }
    }
    return text + (random.empty() ? "" : "[random]\n" + random);
}

}  // namespace gearpod::mc
