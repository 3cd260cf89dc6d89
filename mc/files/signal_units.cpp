#include "mc/files/signal_units.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <iterator>
#include <numbers>
#include <span>
#include <sstream>
#include <utility>

#include "mc/files/input/input_file.hpp"
#include "mc/files/input/terminal_text.hpp"

namespace gearpod::mc {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;  // rad
constexpr double kGravity = 9.80665;                  // m/s^2, standard gravity (ISO 80000-3)

// Symbols, each followed by its other spellings. Those in lower case are read in any case, and so
// are symbols but those in kExact, which are another unit in other letter cases.
constexpr std::string_view kSymbols[] = {"m meter meters metre metres",
                                         "mm",
                                         "cm",
                                         "um micron microns",
                                         "in inch inches",
                                         "ft foot feet",
                                         "s sec secs second seconds",
                                         "ms msec msecs millisecond milliseconds",
                                         "us usec usecs microsecond microseconds",
                                         "min mins minute minutes",
                                         "h hr hrs hour hours",
                                         "rad rads radian radians",
                                         "urad",
                                         "deg degs degree degrees °",
                                         "arcmin arcminute arcminutes",
                                         "arcsec arcsecond arcseconds",
                                         "turns turn r tr rev revs revolution revolutions U",
                                         "rpm",
                                         "Hz hz hertz rps",
                                         "kHz khz",
                                         "g gn g_n g0",
                                         "mg mG",
                                         "V v volt volts",
                                         "mV millivolt millivolts",
                                         "uV microvolt microvolts"};
constexpr std::string_view kExact = "mrad mg mV uV";

struct KnownUnit {
    const char* name;
    double factor;  // to the unit of the quantity
};
constexpr KnownUnit kLengthUnits[] = {{"m", 1.0},   {"mm", 1e-3},   {"cm", 1e-2},
                                      {"um", 1e-6}, {"in", 0.0254}, {"ft", 0.3048}};
constexpr std::string_view kPerSecondSquared[] = {"/s2", " s-2", "/s/s", "/s s"};
constexpr KnownUnit kAccelerationUnits[] = {{"g", kGravity}, {"mg", 9.80665e-3}};
constexpr KnownUnit kAngleUnits[] = {{"rad", 1.0},
                                     {"mrad", 1e-3},
                                     {"urad", 1e-6},
                                     {"deg", kDegree},
                                     {"arcmin", kDegree / 60.0},
                                     {"arcsec", kDegree / 3600.0},
                                     {"turns", 2.0 * std::numbers::pi}};
constexpr KnownUnit kTimeUnits[] = {
    {"s", 1.0}, {"ms", 1e-3}, {"us", 1e-6}, {"min", 60.0}, {"h", 3600.0}};
// A number per minute counts turns.
constexpr KnownUnit kSpeedUnits[] = {{"rpm", 1.0},
                                     {"/min", 1.0},
                                     {"min-1", 1.0},
                                     {"turns/min", 1.0},
                                     {"turns min-1", 1.0},
                                     {"turns/s", 60.0},
                                     {"Hz", 60.0},
                                     {"kHz", 60e3},
                                     {"rad/s", 30.0 / std::numbers::pi},
                                     {"rad s-1", 30.0 / std::numbers::pi},
                                     {"deg/s", 30.0 / std::numbers::pi* kDegree},
                                     {"deg s-1", 30.0 / std::numbers::pi* kDegree}};
constexpr KnownUnit kVoltageUnits[] = {{"V", 1.0}, {"mV", 1e-3}, {"uV", 1e-6}};
constexpr KnownUnit kPhaseUnits[] = {{"1", 1.0}};
// Units that are only recognized. One per second may be turns or radians.
constexpr std::string_view kOtherUnits =
    ";/s;s-1;m/s;mm/s;cm/s;um/s;in/s;ft/s;m s-1;mm s-1;rad/s2;rad s-2;deg/s2;N;kN;MN;Nm;kNm;mNm;"
    "N m;kN m;Pa;kPa;MPa;GPa;bar;mbar;psi;W;kW;MW;J;kJ;kg;t;lb;lbf;K;°C;degC;°F;degF;A;mA;uA;Ohm;"
    "ohm;%;dB;ppm;pC;nm;km;kV;kph;mph;ug;Gal;";

// Characters with the same meaning and their ASCII spelling. "Â" precedes characters of UTF-8 text
// that was read as Latin-1 and saved again.
constexpr std::array<std::string_view, 2> kSpellings[] = {
    {"Â", ""},      {"⁻¹", "^-1"},   {"⁻²", "^-2"},   {"⁻³", "^-3"},    {"²", "^2"},
    {"³", "^3"},    {"·", "*"},      {"⋅", "*"},      {"∙", "*"},       {"•", "*"},
    {"×", "*"},     {"−", "-"},      {"–", "-"},      {"‐", "-"},       {"µ", "u"},
    {"μ", "u"},     {"º", "°"},      {"˚", "°"},      {" \u030a", "°"}, {"∕", "/"},
    {"⁄", "/"},     {"\u00a0", " "}, {"\u2009", " "}, {"\u202f", " "},  {"\u200b", ""},
    {"\ufeff", ""}, {"\t", " "},     {"**", "^"},     {" per ", "/"},   {" squared", "^2"},
    {"\\", ""},     {"{", "("},      {"}", ")"},      {"℃", "°C"},
};

void replace_all(std::string& text, std::string_view from, std::string_view to) {
    for (std::size_t at = text.find(from); at != std::string::npos;
         at = text.find(from, at + to.size())) {
        text.replace(at, from.size(), to);
    }
}

std::string symbol_of(const std::string& word) {
    const std::string lower = lower_case(word);
    for (const std::string_view words : kSymbols) {
        const std::string symbol(words.substr(0, words.find(' ')));
        const std::string_view others = words.substr(symbol.size());
        if (word == symbol || is_among(word, others) || is_among(lower, others) ||
            (lower == symbol && !is_among(lower, kExact))) {
            return symbol;
        }
    }
    return word;
}

bool is_letter(char c) {
    return std::isalpha(static_cast<unsigned char>(c)) != 0 || c == '_' ||
           static_cast<unsigned char>(c) >= 0x80;
}

// One spelling of a unit: symbols, "/", powers without a sign of their own and blanks for products,
// as "m/s2" and "m s-2". Empty if its parentheses do not match, or if an operator lacks a symbol.
std::string one_spelling(std::string_view ascii) {
    std::string text;
    int depth = 0;
    for (std::size_t at = 0; at < ascii.size();) {
        const std::size_t first = at;
        while (at < ascii.size() && is_letter(ascii[at])) {
            ++at;
        }
        if (at > first) {
            const bool zero = ascii.substr(first, at - first + 1) == "g0";
            at += zero ? 1 : 0;
            text += symbol_of(std::string(ascii.substr(first, at - first)));
            continue;
        }
        const char c = ascii[at++];
        depth += c == '(' ? 1 : c == ')' ? -1 : 0;
        if (depth < 0 || (c == '^' && at == ascii.size())) {
            return "";
        }
        if (c == '*' || c == '.') {
            text += ' ';
        } else if (c != '(' && c != ')') {
            text += c;
        }
    }
    for (const auto& [from, to] :
         {std::pair{"  ", " "}, {" ^", "^"}, {"^ ", "^"}, {" /", "/"}, {"/ ", "/"}}) {
        replace_all(text, from, to);
    }
    replace_all(text, "^", "");
    std::string_view plain = without_outer_blanks(text);
    if (plain.starts_with("1/")) {
        plain.remove_prefix(1);
    }
    return depth == 0 ? std::string(plain) : "";
}

std::optional<double> factor_in(std::span<const KnownUnit> known, std::string_view unit) {
    const auto found = std::ranges::find(known, unit, &KnownUnit::name);
    return found == known.end() ? std::nullopt : std::optional(found->factor);
}

std::optional<double> acceleration_factor(std::string_view unit) {
    for (const std::string_view ending : kPerSecondSquared) {
        if (unit.ends_with(ending)) {
            return factor_in(kLengthUnits, unit.substr(0, unit.size() - ending.size()));
        }
    }
    return factor_in(kAccelerationUnits, unit);
}

struct QuantityUnits {
    Quantity quantity;
    const char *name, *listed;
    std::span<const KnownUnit> units;
};
constexpr QuantityUnits kQuantities[] = {
    {Quantity::acceleration, "an acceleration",
     "m/s^2, mm/s^2, cm/s^2, um/s^2, ft/s^2, in/s^2, g, mg", kAccelerationUnits},
    {Quantity::angle, "an angle", "rad, mrad, urad, deg, arcmin, arcsec, turns", kAngleUnits},
    {Quantity::time, "a time", "s, ms, us, min, h", kTimeUnits},
    {Quantity::speed, "a speed of rotation", "rpm, 1/min, Hz, kHz, rad/s, deg/s", kSpeedUnits},
    {Quantity::phase, "a number of mesh periods", "mesh periods", kPhaseUnits},
    {Quantity::voltage, "a voltage", "V, mV, uV", kVoltageUnits}};

const QuantityUnits& units_of(Quantity quantity) {
    return *std::ranges::find(kQuantities, quantity, &QuantityUnits::quantity);
}

// Factor of a unit in one_spelling().
std::optional<double> quantity_factor(const QuantityUnits& known, std::string_view unit) {
    return known.quantity == Quantity::acceleration ? acceleration_factor(unit)
                                                    : factor_in(known.units, unit);
}

bool is_known(std::string_view unit) {
    return factor_in(kLengthUnits, unit) ||
           kOtherUnits.find(fmt::format(";{};", unit)) != kOtherUnits.npos ||
           std::ranges::any_of(kQuantities, [&](const QuantityUnits& known) {
               return quantity_factor(known, unit).has_value();
           });
}

}  // namespace

bool is_among(std::string_view word, std::string_view words) {
    return fmt::format(" {} ", words).find(fmt::format(" {} ", word)) != std::string::npos;
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
    std::string_view inner = without_outer_blanks(text);
    while (inner.size() > 1 && opening_of_last(inner) == 0) {
        inner = without_outer_blanks(inner.substr(1, inner.size() - 2));
    }
    return std::string(inner);
}

namespace {

// A unit, or "" if there is none, and the remark after it.
struct SplitUnit {
    std::string unit, remark;
    std::string spelling;  // one_spelling() of a known unit; "" if it is unknown
};

// Words after a unit that are a remark without parentheses.
constexpr std::string_view kPeakRemarks = "pk peak 0-pk 0-p 0-peak zero-peak zero-to-peak";
constexpr std::string_view kOtherValues =
    "rms pk-pk pkpk p-p pp p2p peak-peak peak-to-peak peak2peak db log ln log10";

std::string known_spelling(std::string_view ascii) {
    std::string spelling = one_spelling(ascii);
    return is_known(spelling) ? spelling : "";
}

SplitUnit split_unit(std::string_view text) {
    const std::string whole = ascii_unit(text);
    SplitUnit split{whole, "", known_spelling(whole)};
    if (!split.spelling.empty()) {
        return split;
    }
    const auto try_at = [&](std::size_t end, std::string_view remark) {
        const std::string unit(without_outer_blanks(std::string_view(whole).substr(0, end)));
        const std::string spelling = known_spelling(unit);
        if (!spelling.empty()) {
            split = {unit, std::string(without_outer_blanks(remark)), spelling};
        }
    };
    const std::size_t open = opening_of_last(whole);
    if (open != std::string::npos && open > 0) {
        try_at(open, std::string_view(whole).substr(open + 1, whole.size() - open - 2));
    }
    for (std::size_t at = whole.find_first_of(" _,");
         split.spelling.empty() && at != std::string::npos;
         at = whole.find_first_of(" _,", at + 1)) {
        const std::string rest =
            lower_case(without_outer_blanks(std::string_view(whole).substr(at + 1)));
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
    std::string separated = lower;
    std::ranges::replace_if(
        separated, [](char c) { return c == ',' || c == ';' || c == '.'; }, ' ');
    std::istringstream words(separated);
    for (std::string word; words >> word;) {
        if (is_among(word, kOtherValues)) {
            return true;
        }
    }
    return lower.find("to peak") != std::string::npos ||
           lower.find("to-peak") != std::string::npos ||
           lower.find_first_of("0123456789*%") != std::string::npos;
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
    if (split.spelling.empty()) {
        return {std::nullopt, "",
                fmt::format("unknown unit {}; known units are {}", shown, known_units(quantity))};
    }
    const auto factor = quantity_factor(units_of(quantity), split.spelling);
    if (!factor) {
        return {std::nullopt, "",
                fmt::format("unit {} is not that of {}; known units are {}", shown,
                            units_of(quantity).name, known_units(quantity))};
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
    return !split_unit(text).spelling.empty();
}

std::string plain_unit(std::string_view unit) {
    return split_unit(unit).unit;
}

std::string known_units(Quantity quantity) {
    return units_of(quantity).listed;
}

std::optional<double> sensor_sensitivity(std::string_view text) {
    const std::string plain = ascii_unit(text);
    double value = 0.0;
    const auto number = std::from_chars(plain.data(), plain.data() + plain.size(), value);
    const std::string unit = one_spelling(
        std::string_view(plain).substr(static_cast<std::size_t>(number.ptr - plain.data())));
    const std::size_t end = std::min(unit.find_first_of(" /"), unit.size());
    const auto volts = factor_in(kVoltageUnits, unit.substr(0, end));
    const std::string rest = unit.substr(end);  // "mV s2/m" is "mV/(m/s2)"
    const auto acceleration = rest.starts_with(" s2/")
                                  ? factor_in(kLengthUnits, std::string_view(rest).substr(4))
                                  : acceleration_factor(rest.empty() ? rest : rest.substr(1));
    if (number.ec != std::errc{} || !volts || !acceleration) {
        return std::nullopt;
    }
    const double sensitivity = value * (*volts / *acceleration);
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
