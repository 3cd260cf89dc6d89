// Nesting depth of a TOML text, checked before a recursive parser reads it. TOML_MAX_NESTED_VALUES
// of toml++ limits lists and inline tables only, not dotted keys and headers, whose tables are
// destroyed recursively.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "mc/files/input/problems.hpp"

namespace gearpod::mc {

// Largest depth; valid studies nest at most four deep.
inline constexpr int kMostNesting = 32;

// First line (from 1) that is nested too deep; 0 if there is none. That is a dotted key or header
// with more than kMostNesting parts, or lists and tables nested deeper than kMostNesting. Strings
// and comments are ignored. Linear in the length of the text; after a syntax error the result may
// be wrong.
int line_nested_too_deep(std::string_view text);

// TOML file as a tree that records the line of every key, with overrides applied.

struct Entry;

struct Value {
    enum class Kind { boolean, integer, number, text, array, table, date };
    Kind kind = Kind::table;
    bool boolean = false;
    std::int64_t integer = 0;
    double number = 0.0;  // also set for integers
    std::string text;
    std::vector<Value> elements;  // of an array
    std::vector<Entry> entries;   // of a table, sorted by name
    Position position;

    const Entry* find(std::string_view name) const;
    // Kind and value for messages: `a string ("50 kHz")`, "an integer (3)", "a list".
    std::string shown() const;
};

struct Entry {
    std::string name;
    Value value;
    Position position;  // of the name
};

// Parses TOML. A syntax error is appended to `problems`, and the tree is then empty.
Value parse_document(const std::string& text, const std::string& file, Problems& problems);

// File name of values that an option gave.
inline constexpr std::string_view kOverrideFile = "--set";

// Applies "section.key=value": sets the value at that path and creates missing tables. A
// distribution, a table with the entry "distribution", is set at random.section.key.
void apply_override(Value& document, const std::string& assignment, Problems& problems);

// Removes random.section.key wherever an override set section.key and none set any part of
// random.section.key: the given value is meant for all gearboxes. Also removes the correlations
// that name this key. Returns the keys "section.key".
std::vector<std::string> drop_overridden_random(Value& document);

// Content of a file. A problem is appended if it cannot be read.
std::string read_file(const std::string& path, Problems& problems);

// Text as a TOML string.
std::string quoted_text(const std::string& text);

// Splits "a.b.c" into its parts; "" has one part, which is empty.
std::vector<std::string> split(const std::string& text, char separator);

}  // namespace gearpod::mc
