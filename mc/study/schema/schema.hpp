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

// A reference of the keys with unit, range, default and meaning, for help, 80 columns wide: those
// with `word` in section, name or meaning, whatever its case. "" if there is none.
std::string schema_help(std::string_view word = "");

}  // namespace gearpod::mc
