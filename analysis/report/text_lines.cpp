#include "analysis/report/text_lines.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace gearpod::analysis {
namespace {

std::size_t columns_of_text = 120;

}  // namespace

std::size_t text_width() {
    return columns_of_text;
}

void set_text_width(std::size_t columns) {
    columns_of_text = std::max<std::size_t>(80, columns);
}

void add_wrapped(std::string& out, const std::string& text, std::size_t indent, std::size_t width) {
    std::string line;
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t end = std::min(text.find(' ', at), text.size());
        const std::string word = text.substr(at, end - at);
        if (!line.empty() && line.size() + 1 + word.size() > width) {
            out += line + '\n';
            line = std::string(indent, ' ') + word;
        } else {
            line += (line.empty() || at == 0 ? "" : " ") + word;
        }
        at = end + 1;
    }
    out += line + '\n';
}

std::string with_unit(double size, const SizeUnit& unit) {
    const std::string shown = unit.shown_unit();
    return fmt::format("{:.3g}{}", size / unit.per_unit(), shown.empty() ? "" : " " + shown);
}

std::string range_text(const SizeGroup& range, const SizeUnit& unit) {
    return range.low == range.high
               ? with_unit(range.high, unit)
               : with_unit(range.low, unit) + " to " + with_unit(range.high, unit);
}

std::string size_estimate_text(const SizeEstimate& estimate, double smallest, double largest,
                               const SizeUnit& unit, int digits) {
    switch (estimate.where) {
        case SizeEstimate::Where::reached:
            return fmt::format("{:.{}g}", estimate.size / unit.per_unit(), digits);
        case SizeEstimate::Where::below_tested:
            return fmt::format("< {:.{}g}", smallest / unit.per_unit(), digits);
        case SizeEstimate::Where::not_reached:
            break;
    }
    return fmt::format("> {:.{}g}", largest / unit.per_unit(), digits);
}

}  // namespace gearpod::analysis
