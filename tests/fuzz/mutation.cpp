#include "mutation.hpp"

#include <array>
#include <sstream>

namespace gearpod::test {
namespace {

constexpr std::array kValues{
    "0",
    "-0.0",
    "1",
    "-1",
    "2",
    "3",
    "7",
    "8",
    "0.5",
    "1.5",
    "100",
    "1e3",
    "1e6",
    "1e9",
    "1e12",
    "1e-3",
    "1e-6",
    "1e-12",
    "1e-300",
    "5e-324",
    "1e300",
    "1e18",
    "1e19",
    "-1e18",
    "1e-30",
    "1e-31",
    "1e5",
    "1e7",
    "1e-9",
    "0.999999999",
    "1000000000",
    "1.7976931348623157e308",
    "-1e300",
    "nan",
    "inf",
    "-inf",
    "2147483647",
    "2147483648",
    "-2147483648",
    "9223372036854775807",
    "-9223372036854775808",
    "9223372036854775808",
    "0x7fffffff",
    "1_000",
    "true",
    "false",
    "\"\"",
    "\"none\"",
    "\"sun\"",
    "\"ring\"",
    "\"planet\"",
    "\"carrier\"",
    "\"constant\"",
    "\"crack\"",
    "\"march\"",
    "\"\\u0000\"",
    "\"\xc3\xa9\"",
    "[]",
    "[0]",
    "[1, 0]",
    "[0, 1, 2]",
    "[nan]",
    "[[1], [2]]",
    "[\"te_rms\"]",
    "[1, \"a\"]",
    "{}",
    "{ distribution = \"uniform\" }",
    "{ distribution = \"uniform\", low = 0, high = 1 }",
    "{ distribution = \"uniform\", low = 1, high = 1 }",
    "{ distribution = \"uniform\", low = 1e-300, high = 1e300 }",
    "{ distribution = \"normal\", mean = 1, sd = 1e-9 }",
    "{ distribution = \"lognormal\", median = 1, cv = 100 }",
    "{ distribution = \"lognormal\", median = 1e8, cv = 0.2 }",
    "{ distribution = \"truncated-normal\", mean = 0, sd = 1, low = 30, high = 31 }",
    "{ distribution = \"triangular\", low = 1, mode = 1, high = 2 }",
    "{ distribution = \"weibull\", scale = 1, shape = 0.2 }",
    "{ distribution = \"beta\", low = 0, high = 1, alpha = 0.05, beta = 10000 }",
    "{ distribution = \"discrete\", values = [0, 1], weights = [1e-30, 1e18] }",
    "{ distribution = \"levels\", values = [0, 1, 2] }",
    "{ distribution = \"levels\", values = [1, 1] }",
    "{ distribution = \"grid\", low = 0, high = 4, count = 5 }",
    "{ distribution = \"grid\", low = 0, high = 4, count = 1000000000 }",
    "{ half_width = 0.1, feature = \"te_rms\", size = 0 }",
    "1979-05-27",
    "07:32:00",
    "'''x'''"};

constexpr std::array kKeys{"planets",       "sun_teeth",  "kind",          "member", "side",
                           "depth_mm",      "torque_N_m", "fixed",         "input",  "noise_levels",
                           "seed",          "instances",  "low_pass_Hz",   "use",    "sun",
                           "size_edges_mm", "lanes",      "tooth_profile", "motion", "horizon"};

class Mutator {
  public:
    Mutator(const std::string& text, std::mt19937_64& engine) : engine_(engine) {
        std::istringstream stream(text);
        for (std::string line; std::getline(stream, line);) {
            lines_.push_back(line);
        }
    }

    void mutate_line() {
        if (lines_.empty()) {
            return;
        }
        const std::size_t at = below(lines_.size());
        switch (below(11)) {
            case 0:
                lines_.erase(lines_.begin() + static_cast<std::ptrdiff_t>(at));
                break;
            case 1:
                lines_.insert(lines_.begin() + static_cast<std::ptrdiff_t>(at), lines_[at]);
                break;
            case 2:
                std::swap(lines_[at], lines_[below(lines_.size())]);
                break;
            case 3:
                set_value(at, value_of(lines_[below(lines_.size())]));
                break;
            case 4:
                misspell(at);
                break;
            case 6:
                set_value(at, long_list());
                break;
            case 7:
                lines_.insert(lines_.begin() + static_cast<std::ptrdiff_t>(at), nested());
                break;
            case 5:
                lines_.insert(lines_.begin() + static_cast<std::ptrdiff_t>(at),
                              std::string(kKeys[below(kKeys.size())]) + " = " +
                                  kValues[below(kValues.size())]);
                break;
            default:
                set_value(at, kValues[below(kValues.size())]);
        }
    }

    std::string text() const {
        std::string all;
        for (const std::string& line : lines_) {
            all += line + "\n";
        }
        return all;
    }

  private:
    std::size_t below(std::size_t count) { return engine_() % count; }

    static std::string value_of(const std::string& line) {
        const std::size_t equals = line.find('=');
        return equals == std::string::npos ? line : line.substr(equals + 1);
    }
    void set_value(std::size_t at, const std::string& value) {
        const std::size_t equals = lines_[at].find('=');
        if (equals != std::string::npos) {
            lines_[at] = lines_[at].substr(0, equals + 1) + " " + value;
        }
    }
    // Ascending numbers, from a few to more than allowed.
    std::string long_list() {
        const std::size_t count = std::size_t{1} << below(13);
        std::string list = "[0";
        for (std::size_t i = 1; i < count; ++i) {
            list += ", " + std::to_string(i);
        }
        return list + "]";
    }
    // A header or key of many parts, or a value with many brackets.
    std::string nested() {
        const std::size_t depth = std::size_t{1} << below(17);
        const std::size_t kind = below(4);
        const char* const part = kind == 3 ? "[" : ".a";
        std::string text = kind == 0 ? "[a" : kind == 3 ? "x = " : "a";
        for (std::size_t i = 0; i < depth; ++i) {
            text += part;
        }
        return text + (kind == 0 ? "]" : kind == 3 ? "" : " = 1");
    }
    void misspell(std::size_t at) {
        if (!lines_[at].empty()) {
            lines_[at][below(lines_[at].size())] = static_cast<char>('a' + below(26));
        }
    }

    std::mt19937_64& engine_;
    std::vector<std::string> lines_;
};

void mutate_bytes(std::string& text, std::mt19937_64& engine) {
    const auto below = [&](std::size_t count) { return count == 0 ? 0 : engine() % count; };
    const std::size_t at = below(text.size());
    switch (below(6)) {
        case 0:
            text.resize(at);
            break;
        case 1:
            text.insert(at, std::string(1 + below(3000), "[{(\"'="[below(6)]));
            break;
        case 2:
            text.insert(at, 1, static_cast<char>(below(256)));
            break;
        case 3:
            text.erase(at, below(20));
            break;
        default:
            if (!text.empty()) {
                text[at] = static_cast<char>(text[at] ^ (1 << below(8)));
            }
    }
}

}  // namespace

std::string mutated(const std::vector<std::string>& studies, std::uint64_t number) {
    std::mt19937_64 engine(number);
    Mutator mutator(studies[engine() % studies.size()], engine);
    const bool bytes = engine() % 5 == 0;
    const std::size_t lines = (bytes ? 0 : 1) + engine() % 3;
    for (std::size_t i = 0; i < lines; ++i) {
        mutator.mutate_line();
    }
    std::string text = mutator.text();
    if (bytes) {
        mutate_bytes(text, engine);
    }
    return text;
}

}  // namespace gearpod::test
