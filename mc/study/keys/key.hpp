// Key of a study file: unit, range, meaning, accessor, and whether it must be given.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "mc/files/input/document.hpp"
#include "mc/study/distributions/range.hpp"
#include "mc/study/study.hpp"

namespace gearpod::mc {

// Unit of a key in the file and in the code. `suffix` is the end of the key's name, "" for pure
// numbers.
struct Unit {
    std::string_view suffix;     // "mm"
    std::string_view name;       // "mm", "N/m"; "1" for a pure number
    std::string_view si_suffix;  // "m"
    std::string_view si_name;    // "m"
    double to_si = 1.0;
};

struct ChoiceName {
    std::string_view text;
    int value;
};

// Accessors of a key's value in a Study; numbers in SI. get() is empty for a value that is not
// given.
template <class Type, class Stored = std::optional<Type>>
struct Access {
    Stored (*get)(const Study&);
    void (*set)(Study&, Type);
};
using NumberAccess = Access<double>;
using IntegerAccess = Access<std::int64_t>;
using BooleanAccess = Access<bool>;
struct ChoiceAccess {
    std::optional<int> (*get)(const Study&);
    void (*set)(Study&, int);
    std::span<const ChoiceName> names;
};
struct NumbersAccess {
    std::vector<double> (*get)(const Study&);
    void (*set)(Study&, std::vector<double>);
    bool ascending = false;  // true: each value must exceed the previous one
};
using TextsAccess = Access<std::vector<std::string>, std::vector<std::string>>;
// Called with the position of an element, a problem and a remedy.
using RejectElement = std::function<void(const Position& at, std::string what, std::string remedy)>;
// Field of a table such as { frequency_Hz = 50, amplitude_m_s2 = 0.1 }.
struct TableField {
    enum class Kind { number, integer, text, numbers, word };  // word: lower-case, as for names
    std::string_view name;
    Kind kind = Kind::number;
    bool required = false;
    std::span<const ChoiceName> choices = {};  // of a text; empty: any
};
// List of tables.
struct TablesAccess {
    std::string_view elements;  // "tones"
    std::span<const TableField> fields;
    // Stores the list. Problems name an element by its position.
    void (*read)(Study&, const Value& list, const RejectElement& reject);
    // The elements as tables that read back to the same values.
    std::vector<std::string> (*texts)(const Study&);
};
using PythonAccess = Access<std::vector<PythonFeature>, std::vector<PythonFeature>>;
using AnyAccess = std::variant<NumberAccess, IntegerAccess, BooleanAccess, ChoiceAccess,
                               NumbersAccess, TextsAccess, TablesAccess, PythonAccess>;

// Requirement of a key (required, optional or forbidden) and the reason. It depends on the keys
// `governors`; "" for none.
enum class Need { required, optional, forbidden };
struct Presence {
    Need need;
    std::string why;
    std::array<std::string_view, 5> governors{};
};
using PresenceRule = std::function<Presence(const Study&)>;

// Text of a key as a template argument.
template <std::size_t kLength>
struct KeyText {
    char text[kLength];
    constexpr KeyText(const char (&key)[kLength]) { std::copy_n(key, kLength, text); }
};

struct Key {
    std::string_view section;
    std::string name;  // with the table of the section that holds it: "sun.mass_kg"
    AnyAccess access;
    Unit unit;
    Range range;
    PresenceRule presence;
    std::string_view fixed_because;  // why the key may not be random; "" if it may
    std::string doc;

    std::string path() const;        // "gearbox.sun.mass_kg"
    std::string table() const;       // that holds it in a file: "gearbox.sun"
    std::string_view label() const;  // in that table: "mass_kg"
    std::string_view stem() const;   // of its name: "sun.mass"
    std::string column() const;      // of results, in SI: "sun_mass_kg"
    bool may_be_random() const {
        return std::holds_alternative<NumberAccess>(access) && fixed_because.empty();
    }
};

// Path without tables in a section: "gearbox.sun_mass_kg". The spelling of earlier versions, which
// still names random streams.
std::string flat_path(std::string_view path);

}  // namespace gearpod::mc
