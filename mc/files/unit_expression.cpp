#include "mc/files/unit_expression.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <iterator>
#include <numbers>

#include "mc/input/utf8.hpp"

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

}  // namespace gearpod::mc
