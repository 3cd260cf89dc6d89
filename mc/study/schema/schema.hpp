// The keys of a study file as data: one line a key in *_keys.cpp, those of a fault in its kind's
// file. Reading, ranges, units, spelling, help and the resolved text all come from it.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "mc/study/keys/key.hpp"
#include "mc/study/study.hpp"

namespace gearpod::mc {

// All keys in the order in which they are shown.
std::span<const Key> schema();

// The sections in order; "random" among them.
std::span<const std::string_view> section_names();

// The key of that section and name, or nullptr.
const Key* find_key(std::string_view section, std::string_view name);

// The text of a choice, as a study file would say it.
std::string_view choice_text(const Study& study, std::string_view section, std::string_view name);

// A reference of all keys with unit, range, default and meaning, for help.
std::string schema_help();

}  // namespace gearpod::mc
