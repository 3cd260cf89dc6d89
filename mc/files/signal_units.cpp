#include "mc/files/signal_units.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numbers>

#include "mc/files/unit_expression.hpp"
#include "mc/input/printable.hpp"
#include "mc/input/utf8.hpp"

namespace gearpod::mc {
namespace {

// A unit, or "" if there is none, and the remark after it.
struct SplitUnit {
    std::string unit, remark;
    std::optional<ParsedUnit> parsed;
};

// Words after a unit that are a remark without parentheses.
constexpr std::string_view kPeakRemarks = "pk peak 0-pk 0-p 0-peak zero-peak zero-to-peak";
constexpr std::string_view kOtherValues =
    "rms pk-pk pkpk p-p pp p2p peak-peak peak-to-peak peak2peak db log ln log10";

SplitUnit split_unit(std::string_view text) {
    const std::string whole = ascii_unit(text);
    SplitUnit split{whole, "", parse_unit(whole)};
    if (split.parsed) {
        return split;
    }
    const auto try_at = [&](std::size_t end, std::string_view remark) {
        const std::string unit(without_blanks(std::string_view(whole).substr(0, end)));
        auto parsed = parse_unit(unit);
        if (!unit.empty() && parsed) {
            split = {unit, std::string(without_blanks(remark)), parsed};
        }
    };
    const std::size_t open = opening_of_last(whole);
    if (open != std::string::npos && open > 0) {
        try_at(open, std::string_view(whole).substr(open + 1, whole.size() - open - 2));
    }
    for (std::size_t at = whole.find_first_of(" _,"); !split.parsed && at != std::string::npos;
         at = whole.find_first_of(" _,", at + 1)) {
        const std::string rest = lower_case(without_blanks(std::string_view(whole).substr(at + 1)));
        if (is_among(rest, kPeakRemarks) || is_among(rest, kOtherValues) ||
            rest.starts_with("since ")) {
            try_at(at, rest);
        }
    }
    return split;
}

bool states_no_unit(const std::string& ascii) {
    const std::string lower = lower_case(ascii);
    return lower.empty() || lower == "none" || lower == "n/a" || lower == "null";
}

// True if a remark states values other than instantaneous ones, or a number.
bool states_other_values(const std::string& remark) {
    const std::string lower = lower_case(remark);
    if (is_among(lower, kPeakRemarks) || lower.starts_with("since ")) {
        return false;
    }
    std::string words = lower;
    std::ranges::replace_if(
        words, [](char c) { return c == ',' || c == ';' || c == '.'; }, ' ');
    for (std::size_t at = 0; at < words.size();) {
        const std::size_t end = std::min(words.find(' ', at), words.size());
        if (is_among(std::string_view(words).substr(at, end - at), kOtherValues)) {
            return true;
        }
        at = end + 1;
    }
    return lower.find("to peak") != std::string::npos ||
           lower.find("to-peak") != std::string::npos ||
           lower.find_first_of("0123456789*%") != std::string::npos;
}

std::optional<double> quantity_factor(Quantity quantity, const ParsedUnit& unit) {
    const Dimensions& has = unit.dimensions;
    switch (quantity) {
        case Quantity::acceleration:
            return has == kAccelerationUnit ? std::optional(unit.factor) : std::nullopt;
        case Quantity::angle:
            return has == kRadianUnit ? std::optional(unit.factor)
                   : has == kTurnUnit ? std::optional(2.0 * std::numbers::pi * unit.factor)
                                      : std::nullopt;
        case Quantity::time:
            return has == kTimeUnit ? std::optional(unit.factor) : std::nullopt;
        case Quantity::speed:
            // "1/min" counts turns. "1/s" may be turns or radians, and stays unknown.
            return has == kTurnRateUnit || (has == kRateUnit && unit.factor == 1.0 / 60.0)
                       ? std::optional(60.0 * unit.factor)
                   : has == kRadianRateUnit ? std::optional(30.0 / std::numbers::pi * unit.factor)
                                            : std::nullopt;
        case Quantity::voltage:
            return has == kVoltageUnit ? std::optional(unit.factor) : std::nullopt;
        case Quantity::phase:
            return has == kNoUnit ? std::optional(unit.factor) : std::nullopt;
        case Quantity::any:
            break;
    }
    return 1.0;
}

const char* quantity_name(Quantity quantity) {
    switch (quantity) {
        case Quantity::acceleration:
            return "an acceleration";
        case Quantity::angle:
            return "an angle";
        case Quantity::time:
            return "a time";
        case Quantity::speed:
            return "a speed of rotation";
        case Quantity::phase:
            return "a number of mesh periods";
        case Quantity::voltage:
            return "a voltage";
        case Quantity::any:
            break;
    }
    return "a quantity";
}

}  // namespace

UnitReading read_unit(Quantity quantity, std::string_view text) {
    const SplitUnit split = split_unit(text);
    if (quantity == Quantity::any || states_no_unit(split.unit) ||
        (quantity == Quantity::phase && is_among(lower_case(split.unit), "periods - meshes")) ||
        (quantity == Quantity::phase && lower_case(split.unit).starts_with("mesh period"))) {
        return {1.0, "", ""};
    }
    const std::string shown = printable(text);
    if (!split.parsed) {
        return {std::nullopt, "",
                fmt::format("unknown unit {}; known units are {}", shown, known_units(quantity))};
    }
    const auto factor = quantity_factor(quantity, *split.parsed);
    if (!factor) {
        return {std::nullopt, "",
                fmt::format("unit {} is not that of {}; known units are {}", shown,
                            quantity_name(quantity), known_units(quantity))};
    }
    if (states_other_values(split.remark)) {
        return {std::nullopt, "",
                fmt::format("unit {}: the values of a signal must be instantaneous, in {} without "
                            "\"{}\"",
                            shown, split.unit, printable(split.remark))};
    }
    return {factor, split.remark.starts_with("since ") ? "" : split.remark, ""};
}

std::optional<double> unit_factor(Quantity quantity, std::string_view unit) {
    return read_unit(quantity, unit).factor;
}

bool is_unit(std::string_view text) {
    return split_unit(text).parsed.has_value();
}

std::string plain_unit(std::string_view unit) {
    return split_unit(unit).unit;
}

std::string known_units(Quantity quantity) {
    switch (quantity) {
        case Quantity::acceleration:
            return "m/s^2, mm/s^2, g, mg";
        case Quantity::angle:
            return "rad, mrad, urad, deg, arcmin, arcsec, turns";
        case Quantity::time:
            return "s, ms, us, min";
        case Quantity::speed:
            return "rpm, Hz, rad/s";
        case Quantity::phase:
            return "mesh periods";
        case Quantity::voltage:
            return "V, mV, uV";
        case Quantity::any:
            break;
    }
    return "all";
}

std::optional<double> sensor_sensitivity(std::string_view text) {
    const std::string plain = ascii_unit(text);
    double value = 0.0;
    const auto number = std::from_chars(plain.data(), plain.data() + plain.size(), value);
    const auto unit = parse_unit(without_blanks(
        std::string_view(plain).substr(static_cast<std::size_t>(number.ptr - plain.data()))));
    constexpr Dimensions kPerAcceleration{.length = -1, .time = 2, .voltage = 1},
        kWithoutBrackets{.length = -1, .time = -2, .voltage = 1};  // "mV/m/s^2"
    if (number.ec != std::errc{} || !unit ||
        (unit->dimensions != kPerAcceleration && unit->dimensions != kWithoutBrackets)) {
        return std::nullopt;
    }
    const double sensitivity = value * unit->factor;
    return sensitivity > 0.0 && std::isfinite(sensitivity) && std::isfinite(1.0 / sensitivity)
               ? std::optional(sensitivity)
               : std::nullopt;
}

}  // namespace gearpod::mc
