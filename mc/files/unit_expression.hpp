// Products, quotients and powers of unit symbols: the grammar of signal_units.hpp.
#pragma once

#include <cstdlib>
#include <optional>
#include <string>
#include <string_view>

namespace gearpod::mc {

// Exponents of a unit's dimensions. Angles in radians and in turns differ, so that factors such as
// 60 for Hz stay exact.
struct Dimensions {
    int length = 0, time = 0, radians = 0, turns = 0, voltage = 0, other = 0;

    bool operator==(const Dimensions&) const = default;
    void add(const Dimensions& more, int times) {
        length += times * more.length;
        time += times * more.time;
        radians += times * more.radians;
        turns += times * more.turns;
        voltage += times * more.voltage;
        other += times * more.other;
    }
};

inline constexpr Dimensions kNoUnit{}, kLengthUnit{.length = 1}, kTimeUnit{.time = 1},
    kRadianUnit{.radians = 1}, kTurnUnit{.turns = 1}, kVoltageUnit{.voltage = 1},
    kOtherUnit{.other = 1}, kRateUnit{.time = -1}, kTurnRateUnit{.time = -1, .turns = 1},
    kRadianRateUnit{.time = -1, .radians = 1}, kAccelerationUnit{.length = 1, .time = -2};

// Factor to m, s, rad, turns, V and their products, and the dimensions.
struct ParsedUnit {
    double factor = 1.0;
    Dimensions dimensions;

    void multiply(const ParsedUnit& other, int power) {
        for (int i = 0; i < std::abs(power); ++i) {
            factor = power > 0 ? factor * other.factor : factor / other.factor;
        }
        dimensions.add(other.dimensions, power);
    }
};

// The unit in ASCII, except for the degree sign, with one spelling of its operators and without
// brackets around all of it. Bytes that are not UTF-8 are taken as Latin-1.
std::string ascii_unit(std::string_view bytes);

// Parses an ascii_unit() from the left to the right, for example m/s^2, m s-2 or 1/min; empty if it
// is not a unit as a whole.
std::optional<ParsedUnit> parse_unit(std::string_view unit);

// Position of the bracket that the last character closes; npos if it closes none.
std::size_t opening_of_last(std::string_view text);

std::string_view without_blanks(std::string_view text);
// True if `word` is one of the words, which are separated by blanks.
bool is_among(std::string_view word, std::string_view words);

}  // namespace gearpod::mc
