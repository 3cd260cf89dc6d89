#include "mc/files/signal_units.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <iterator>
#include <numbers>

#include "mc/files/input/file_text.hpp"
#include "mc/files/input/terminal_text.hpp"

namespace gearpod::mc {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;  // rad
constexpr double kGravity = 9.80665;                  // m/s^2, standard gravity (ISO 80000-3)

struct Symbol {
    const char* names;  // separated by blanks
    double factor;      // to m, s, rad, turns, V and their products
    Dimensions dimensions;
    bool any_case = true;  // false if other letter cases are, or may be, another unit
};

constexpr Symbol kSymbols[] = {
    {"m meter meters metre metres", 1.0, kLengthUnit},
    {"mm", 1e-3, kLengthUnit},
    {"cm", 1e-2, kLengthUnit},
    {"um micron microns", 1e-6, kLengthUnit},
    {"nm", 1e-9, kLengthUnit, false},
    {"km", 1e3, kLengthUnit},
    {"in inch inches", 0.0254, kLengthUnit},
    {"ft foot feet", 0.3048, kLengthUnit},
    {"s sec secs second seconds", 1.0, kTimeUnit},
    {"ms msec msecs millisecond milliseconds", 1e-3, kTimeUnit},
    {"us usec usecs microsecond microseconds", 1e-6, kTimeUnit},
    {"ns nsec nanosecond nanoseconds", 1e-9, kTimeUnit},
    {"min mins minute minutes", 60.0, kTimeUnit},
    {"h hr hrs hour hours", 3600.0, kTimeUnit},
    {"d day days", 86400.0, kTimeUnit},
    {"rad rads radian radians", 1.0, kRadianUnit},
    {"mrad", 1e-3, kRadianUnit, false},
    {"urad", 1e-6, kRadianUnit},
    {"deg degs degree degrees °", kDegree, kRadianUnit},
    {"arcmin arcminute arcminutes", kDegree / 60.0, kRadianUnit},
    {"arcsec arcsecond arcseconds", kDegree / 3600.0, kRadianUnit},
    {"turn turns rev revs revolution revolutions cycle cycles r tr", 1.0, kTurnUnit},
    {"U", 1.0, kTurnUnit, false},  // German "U/min"
    {"rpm", 1.0 / 60.0, kTurnRateUnit},
    {"rps", 1.0, kTurnRateUnit},
    {"Hz hertz", 1.0, kTurnRateUnit},
    {"kHz", 1e3, kTurnRateUnit},
    {"g gn g_n gee gees", kGravity, kAccelerationUnit},  // "G" is common for accelerometers
    {"mg mG", 9.80665e-3, kAccelerationUnit, false},
    {"ug", 9.80665e-6, kAccelerationUnit, false},
    {"Gal", 1e-2, kAccelerationUnit, false},
    {"mGal", 1e-5, kAccelerationUnit, false},
    {"V volt volts", 1.0, kVoltageUnit},
    {"mV millivolt millivolts", 1e-3, kVoltageUnit, false},
    {"uV microvolt microvolts", 1e-6, kVoltageUnit, false},
    {"kV", 1e3, kVoltageUnit, false},
    // Units that are only recognized.
    {"N kN MN Nm kNm mNm Pa kPa MPa GPa bar mbar psi W kW MW J kJ kg t lb lbf K °C degC °F degF A "
     "mA uA Ohm ohm % dB ppm F pF C pC kph mph",
     1.0, kOtherUnit, false},
};

const Symbol* symbol_of(std::string_view word) {
    const auto exact = std::ranges::find_if(
        kSymbols, [&](const Symbol& symbol) { return is_among(word, symbol.names); });
    if (exact != std::end(kSymbols)) {
        return &*exact;
    }
    const std::string lower = lower_case(word);
    const auto found = std::ranges::find_if(kSymbols, [&](const Symbol& symbol) {
        return symbol.any_case && is_among(lower, lower_case(symbol.names));
    });
    return found == std::end(kSymbols) ? nullptr : &*found;
}

// Characters with the same meaning and their ASCII spelling. "Â" precedes characters of UTF-8 text
// that was read as Latin-1 and saved again.
constexpr std::array<std::string_view, 2> kSpellings[] = {
    {"Â", ""},      {"⁻¹", "^-1"},   {"⁻²", "^-2"},   {"⁻³", "^-3"},    {"²", "^2"},
    {"³", "^3"},    {"·", "*"},      {"⋅", "*"},      {"∙", "*"},       {"•", "*"},
    {"×", "*"},     {"−", "-"},      {"–", "-"},      {"‐", "-"},       {"µ", "u"},
    {"μ", "u"},     {"º", "°"},      {"˚", "°"},      {" \u030a", "°"}, {"∕", "/"},
    {"⁄", "/"},     {"\u00a0", " "}, {"\u2009", " "}, {"\u202f", " "},  {"\u200b", ""},
    {"\ufeff", ""}, {"\t", " "},     {"**", "^"},     {"\\", ""},       {"{", "("},
    {"}", ")"},     {"℃", "°C"},
};

void replace_all(std::string& text, std::string_view from, std::string_view to) {
    for (std::size_t at = text.find(from); at != std::string::npos;
         at = text.find(from, at + to.size())) {
        text.replace(at, from.size(), to);
    }
}

// Parses products, quotients and powers of symbols, from the left to the right: m/s^2, m s-2,
// 1/min.
class UnitParser {
  public:
    explicit UnitParser(std::string_view text) : text_(text) {}

    std::optional<ParsedUnit> parse() {
        const auto unit = product(0);
        return unit && text_.empty() ? unit : std::nullopt;
    }

  private:
    static constexpr int kDeepest = 8;

    bool take(char c) {
        const bool there = !text_.empty() && text_.front() == c;
        text_.remove_prefix(there ? 1 : 0);
        return there;
    }
    void skip_blanks() {
        while (take(' ')) {
        }
    }
    std::string_view word() {
        std::size_t end = 0;
        while (end < text_.size() &&
               (std::isalpha(static_cast<unsigned char>(text_[end])) != 0 || text_[end] == '_' ||
                text_[end] == '%' || static_cast<unsigned char>(text_[end]) >= 0x80)) {
            ++end;
        }
        const std::string_view found = text_.substr(0, end);
        text_.remove_prefix(end);
        return found;
    }
    // Power after a symbol: ^2, ^-2, ^(-2), 2, -2 or " squared"; 1 if there is none.
    std::optional<int> power() {
        const std::string_view before = text_;
        skip_blanks();
        if (lower_case(text_.substr(0, 7)) == "squared") {
            text_.remove_prefix(7);
            return 2;
        }
        const bool marked = take('^');
        text_ = marked ? text_ : before;
        if (marked) {
            skip_blanks();
        }
        const bool bracket = marked && take('(');
        int value = 0;
        const std::size_t sign = take('+') ? 1 : 0;
        const auto result = std::from_chars(text_.data(), text_.data() + text_.size(), value);
        if (result.ec != std::errc{}) {
            return marked || sign > 0 ? std::nullopt : std::optional(1);
        }
        text_.remove_prefix(static_cast<std::size_t>(result.ptr - text_.data()));
        const bool closed = !bracket || take(')');
        return closed && value != 0 && std::abs(value) < 10 ? std::optional(value) : std::nullopt;
    }
    std::optional<ParsedUnit> factor(int depth) {
        ParsedUnit base;
        if (take('(')) {
            const auto inner = depth < kDeepest ? product(depth + 1) : std::nullopt;
            if (!inner || !take(')')) {
                return std::nullopt;
            }
            base = *inner;
        } else if (take('1')) {
            return base;
        } else {
            const Symbol* const symbol = symbol_of(word());
            if (symbol == nullptr) {
                return std::nullopt;
            }
            base = {symbol->factor, symbol->dimensions};
        }
        const auto exponent = power();
        if (!exponent) {
            return std::nullopt;
        }
        ParsedUnit raised;
        raised.multiply(base, *exponent);
        return raised;
    }
    std::optional<ParsedUnit> product(int depth) {
        ParsedUnit all;
        for (bool first = true;; first = false) {
            skip_blanks();
            if (!first && (text_.empty() || text_.front() == ')')) {
                return all;
            }
            bool divided = take('/');
            if (!divided && !first) {
                divided = text_.starts_with("per ");
                text_.remove_prefix(divided ? 4 : 0);
            }
            const bool multiplied = !divided && (take('*') || take('.'));
            skip_blanks();
            if (multiplied && !first && text_.empty()) {
                return all;  // the dot of an abbreviation
            }
            // Parentheses after a blank are a remark.
            const bool remark = !first && !divided && !multiplied && text_.starts_with('(');
            const auto next = remark ? std::nullopt : factor(depth);
            if (!next) {
                return std::nullopt;
            }
            all.multiply(*next, divided ? -1 : 1);
        }
    }

    std::string_view text_;
};

}  // namespace

bool is_among(std::string_view word, std::string_view words) {
    while (!words.empty()) {
        const std::size_t end = std::min(words.find(' '), words.size());
        if (words.substr(0, end) == word) {
            return true;
        }
        words.remove_prefix(std::min(end + 1, words.size()));
    }
    return false;
}

std::string_view without_blanks(std::string_view text) {
    while (!text.empty() && text.front() == ' ') {
        text.remove_prefix(1);
    }
    while (!text.empty() && (text.back() == ' ' || text.back() == '\0')) {
        text.remove_suffix(1);
    }
    return text;
}

std::size_t opening_of_last(std::string_view text) {
    int depth = 0;
    for (std::size_t at = text.size(); at-- > 0;) {
        depth += text[at] == ')' || text[at] == ']' ? 1 : 0;
        depth -= text[at] == '(' || text[at] == '[' ? 1 : 0;
        if (depth == 0) {
            return at + 1 < text.size() ? at : std::string_view::npos;
        }
    }
    return std::string_view::npos;
}

std::string ascii_unit(std::string_view bytes) {
    std::string text = utf8_text(bytes);
    for (const auto& [from, to] : kSpellings) {
        replace_all(text, from, to);
    }
    std::string_view inner = without_blanks(text);
    while (inner.size() > 1 && opening_of_last(inner) == 0) {
        inner = without_blanks(inner.substr(1, inner.size() - 2));
    }
    return std::string(inner);
}

std::optional<ParsedUnit> parse_unit(std::string_view unit) {
    return UnitParser(unit == "g0" ? "gn" : unit).parse();
}

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

namespace {

constexpr const char* kSensitivityExample = "\"100 mV/g\" or \"10 mV/(m/s^2)\"";

// Factor and remark of a unit; a remark is reported.
ColumnFactor factor_of(const std::string& unit, Quantity quantity) {
    const UnitReading reading = read_unit(quantity, unit);
    return {reading.factor.value_or(1.0), reading.problem,
            reading.remark.empty() ? ""
                                   : fmt::format("unit {}: taken as {}, without its remark",
                                                 printable(unit), plain_unit(unit))};
}

ColumnFactor voltage_factor(const std::string& unit, const std::string& sensitivity) {
    const auto per_acceleration = sensor_sensitivity(sensitivity);
    if (!per_acceleration) {
        return {1.0,
                fmt::format("--sensor-sensitivity {}: is not a voltage per acceleration; give for "
                            "example {}",
                            printable(sensitivity), kSensitivityExample),
                ""};
    }
    if (plain_unit(unit).empty()) {
        return {1.0 / *per_acceleration, "",
                "no unit is stated; taken as V, because --sensor-sensitivity is given"};
    }
    ColumnFactor voltage = factor_of(unit, Quantity::voltage);
    if (!voltage.problem.empty()) {
        voltage.problem = fmt::format(
            "--sensor-sensitivity is for voltages, but the unit is {}; omit it, or "
            "give --sensor-unit V",
            printable(unit));
    }
    voltage.factor /= *per_acceleration;
    return voltage;
}

}  // namespace

ColumnFactor column_factor(const std::string& stated, Quantity quantity, const SensorUnit& sensor) {
    if (quantity != Quantity::acceleration) {
        return factor_of(stated, quantity);
    }
    const std::string& unit = sensor.unit.empty() ? stated : sensor.unit;
    ColumnFactor used = sensor.sensitivity.empty() ? factor_of(unit, quantity)
                                                   : voltage_factor(unit, sensor.sensitivity);
    if (sensor.unit.empty()) {
        const bool converted = used.problem.empty() || !sensor.sensitivity.empty();
        if (!converted && unit_factor(Quantity::voltage, unit)) {
            used.problem = fmt::format(
                "unit {} is that of a voltage; give --sensor-sensitivity, for example {}, or "
                "--sensor-unit if it is wrong",
                printable(unit), kSensitivityExample);
        } else if (!converted) {
            used.problem += "; --sensor-unit takes precedence over the file";
        }
        return used;
    }
    if (!used.problem.empty() && sensor.sensitivity.empty()) {
        used.problem = "--sensor-unit: " + used.problem;
    }
    const UnitReading in_file = read_unit(Quantity::acceleration, stated);
    if (!stated.empty() && (in_file.factor != used.factor || !in_file.remark.empty())) {
        used.note = fmt::format("the file states {}; taken as {} (--sensor-unit)",
                                printable(stated), printable(sensor.unit));
    }
    return used;
}

}  // namespace gearpod::mc
