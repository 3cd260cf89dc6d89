// Tables of keys that make up the schema.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "mc/study/keys/key.hpp"
#include "mc/study/study.hpp"

namespace gearpod::mc {

// Tables in the order in which their keys are shown.
std::span<const Key> gearbox_keys();
std::span<const Key> operation_keys();
std::span<const Key> fault_keys();
std::span<const Key> run_keys();

// Keys of a study file as data: one line per key in *_keys.cpp, those of a kind of fault in its own
// file. Reading, ranges, units, spelling suggestions, help and the resolved text are derived from
// it.

// All keys in the order in which they are shown.
std::span<const Key> schema();

// Tables of a study file in the order in which they are shown, each with its keys: "gearbox", then
// "gearbox.sun" and the like.
struct KeyTable {
    std::string name;
    std::vector<const Key*> keys;
};
const std::vector<KeyTable>& key_tables();
bool is_table(std::string_view name);

// Names of all sections in order, including "random".
std::span<const std::string_view> section_names();

// Key of that section and name, or nullptr.
const Key* find_key(std::string_view section, std::string_view name);
// Key of that path, "section.key", or nullptr.
const Key* find_key(std::string_view path);

// Name of the value of a choice key, as a study file spells it.
std::string_view choice_text(const Study& study, std::string_view section, std::string_view name);

// Reference of the keys for help, at most 80 columns wide: type, range and meaning. Lists the keys
// where a word of section, name or meaning begins with `word`, ignoring case; "" if there is none.
std::string schema_help(std::string_view word = "");

// JSON of a key, from which editors and the documentation take its description: section, name,
// unit, type, default, condition, range and meaning.
nlohmann::ordered_json key_json(const Key& key);

}  // namespace gearpod::mc
