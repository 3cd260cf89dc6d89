// A TOML file as a plain tree that knows the line of every key, with overrides applied.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "mc/input/problems.hpp"

namespace gearpod::mc {

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
    // "a string", "an integer", ...
    std::string_view kind_name() const;
};

struct Entry {
    std::string name;
    Value value;
    Position position;  // of the name
};

// Parses TOML. On a syntax error `problems` gets it and the tree is empty.
Value parse_document(const std::string& text, const std::string& file, Problems& problems);

// Applies "section.key=value": sets the value at that path, creating tables on the way.
void apply_override(Value& document, const std::string& assignment, Problems& problems);

// Drops random.section.key wherever an override set section.key and none set anything of
// random.section.key, and the correlations that name it: the value given is meant for all
// gearboxes.
void drop_overridden_random(Value& document);

// The whole file; a problem if it cannot be read.
std::string read_file(const std::string& path, Problems& problems);

// "a.b.c" in its parts; of "" one, which is empty.
std::vector<std::string> split(const std::string& text, char separator);

}  // namespace gearpod::mc
