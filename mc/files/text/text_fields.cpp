#include "mc/files/text/text_fields.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "mc/files/input/file_text.hpp"
#include "mc/files/input/number_text.hpp"
#include "mc/files/signal_file.hpp"
#include "mc/files/signal_units.hpp"

namespace gearpod::mc {
namespace {

constexpr std::string_view kBlankBytes = " \t";

bool is_digit(char c) {
    return c >= '0' && c <= '9';
}

// Position after a quoted field that begins at `at`; npos if it is not closed.
std::size_t after_quotes(std::string_view line, std::size_t at) {
    for (std::size_t i = at + 1; i < line.size(); ++i) {
        if (line[i] == '"') {
            if (i + 1 == line.size() || line[i + 1] != '"') {
                return i + 1;
            }
            ++i;
        }
    }
    return std::string_view::npos;
}

std::size_t find_separator(std::string_view line, std::size_t at, char separator) {
    const std::size_t end = separator == kOneField ? std::string_view::npos
                            : separator == kBlanks ? line.find_first_of(kBlankBytes, at)
                                                   : line.find(separator, at);
    return std::min(end, line.size());
}

// True for digits in groups of three, such as 1,234 or -12,345,678, that do not begin with zero.
bool is_grouped(std::string_view number) {
    if (number.starts_with('+') || number.starts_with('-')) {
        number.remove_prefix(1);
    }
    const std::size_t first = std::min(number.find(','), number.size());
    if (first == 0 || first > 3 || first == number.size() || number.front() == '0') {
        return false;
    }
    for (std::size_t i = 0; i < number.size(); ++i) {
        const bool comma = i >= first && (i - first) % 4 == 0;
        if (comma ? number[i] != ',' : !is_digit(number[i])) {
            return false;
        }
    }
    return (number.size() - first) % 4 == 0;
}

}  // namespace

std::size_t field_end(std::string_view line, std::size_t at, char separator) {
    const std::size_t begin = line.find_first_not_of(' ', at);
    if (begin != std::string_view::npos && line[begin] == '"') {
        const std::size_t after = after_quotes(line, begin);
        if (after != std::string_view::npos) {
            return find_separator(line, after, separator);
        }
    }
    return find_separator(line, at, separator);
}

void split_fields(std::string_view line, char separator, std::vector<std::string_view>& fields) {
    fields.clear();
    if (separator == kBlanks) {
        line = without_outer_blanks(line);
    }
    for (std::size_t at = 0;;) {
        const std::size_t end = field_end(line, at, separator);
        fields.push_back(without_outer_blanks(line.substr(at, end - at)));
        if (end >= line.size()) {
            return;
        }
        at = end + 1;
        if (separator == kBlanks) {
            at = line.find_first_not_of(kBlankBytes, at);
        }
    }
}

std::string_view trimmed_field(std::string_view text) {
    constexpr std::string_view kBlank = " \t\r\n\"";
    const std::size_t first = text.find_first_not_of(kBlank);
    if (first == std::string_view::npos) {
        return {};
    }
    return text.substr(first, text.find_last_not_of(kBlank) - first + 1);
}

std::string field_text(std::string_view field) {
    field = without_outer_blanks(field);
    if (!field.starts_with('"') || after_quotes(field, 0) != field.size()) {
        return utf8_text(trimmed_field(field));
    }
    std::string text;
    for (std::size_t i = 1; i + 1 < field.size(); ++i) {
        text += field[i];
        i += field[i] == '"' ? 1 : 0;
    }
    return utf8_text(without_outer_blanks(text));
}

bool is_missing(std::string_view field) {
    constexpr std::string_view kWords[] = {"",    "-",   "NA",   "N/A",  "n/a",  "#N/A", "NaN",
                                           "nan", "NAN", "null", "NULL", "None", "--",   "<NA>"};
    return std::ranges::find(kWords, trimmed_field(field)) != std::end(kWords);
}

std::optional<double> number_of(std::string_view field, bool decimal_comma) {
    std::array<char, 64> with_point{};
    if (decimal_comma && field.size() <= with_point.size() &&
        field.find(',') != std::string_view::npos && field.find('.') == std::string_view::npos) {
        std::replace_copy(field.begin(), field.end(), with_point.begin(), ',', '.');
        field = std::string_view(with_point.data(), field.size());
    }
    if (field.starts_with('+')) {
        field.remove_prefix(1);
    }
    return parsed_number<double>(field);
}

std::string not_a_number(std::string_view field, std::string_view should_be) {
    const std::string_view text = trimmed_field(field);
    const auto groups = [](char c) { return c == ',' || c == '.' || c == '\'' || c == ' '; };
    const bool number = std::ranges::all_of(text, [&](char c) {
        return is_digit(c) || groups(c) || c == '+' || c == '-' || c == '\xC2' || c == '\xA0';
    });
    return fmt::format("\"{}\" is not {}{}", field_text(text.substr(0, 40)), should_be,
                       number && std::ranges::any_of(text, is_digit)
                           ? "; thousands separators are not supported"
                           : "");
}

void CommaUse::add(std::string_view number) {
    if (decimal_commas_ && points_) {
        return;
    }
    if (number.find(',') == std::string_view::npos) {
        add_plain(number);
    } else if (decimal_commas_ || !is_grouped(number)) {
        decimal_commas_ = true;
    } else if (grouped_.empty()) {
        grouped_ = number;
    }
}

std::string CommaUse::problem(char separator, bool points) const {
    if (points_ && (decimal_commas_ || !grouped_.empty())) {
        return "numbers with a comma and numbers with a point; write all with the same decimal "
               "sign "
               "and without thousands separators";
    }
    if (!decimal_commas_ && !grouped_.empty() && (points || plain_ || separator == ',')) {
        return fmt::format(
            "\"{}\" may have a thousands separator or a decimal comma; write it "
            "without thousands separators, and with a decimal point",
            grouped_);
    }
    return "";
}

std::string csv_field(const std::string& text, std::string_view separators) {
    const std::string_view seen = without_outer_blanks(text);
    const bool formula =
        seen.size() > 1 && seen.find_first_of("=+-@") == 0 && !number_of(seen, true);
    const std::string safe = (formula ? "'" : "") + text;
    if (safe.find_first_of("\"\r\n") == std::string::npos &&
        safe.find_first_of(separators) == std::string::npos) {
        return safe;
    }
    std::string quoted = "\"";
    for (const char c : safe) {
        quoted += c == '"' ? "\"\"" : std::string(1, c);
    }
    return quoted + '"';
}

namespace {

// The text without its characters from `first` to `last`, which are a unit.
std::string without_part(std::string_view text, std::size_t first, std::size_t last) {
    const std::string before(trimmed_field(text.substr(0, first)));
    const std::string after(trimmed_field(text.substr(last + 1)));
    return before.empty() || after.empty() ? before + after : before + " " + after;
}

TableColumn split_header(const std::string& text) {
    const std::size_t square = text.rfind(']');
    if (square != std::string::npos) {
        const std::size_t open = opening_of_last(std::string_view(text).substr(0, square + 1));
        const std::string name = open == std::string::npos ? "" : without_part(text, open, square);
        if (!name.empty()) {
            const auto inside = std::string_view(text).substr(open + 1, square - open - 1);
            return {name, std::string(trimmed_field(inside)), text};
        }
    }
    if (text.ends_with(')')) {
        const std::size_t open = opening_of_last(text);
        if (open != std::string::npos && open > 0) {
            const auto inside = std::string_view(text).substr(open + 1, text.size() - open - 2);
            const bool number = std::ranges::all_of(
                inside, [](char c) { return (c >= '0' && c <= '9') || c == ' '; });  // of a channel
            if (!number && is_unit(inside)) {
                return {without_part(text, open, text.size() - 1),
                        std::string(trimmed_field(inside)), text};
            }
        }
    }
    const std::size_t slash = text.rfind(" / ");
    if (slash != std::string::npos && slash > 0 && is_unit(text.substr(slash + 3))) {
        return {std::string(trimmed_field(text.substr(0, slash))),
                std::string(trimmed_field(text.substr(slash + 3))), text};
    }
    return {text, "", text};
}

// The name without a remark in parentheses at its end.
std::string_view without_remark(std::string_view name) {
    const std::size_t open = name.ends_with(')') ? opening_of_last(name) : 0;
    return open == 0 || open == std::string_view::npos ? name : trimmed_field(name.substr(0, open));
}

}  // namespace

TableColumn column_of(std::string_view header) {
    return split_header(field_text(header));
}

std::optional<std::size_t> find_column(const std::vector<TableColumn>& columns,
                                       std::string_view name, const std::string& path) {
    if (name.empty()) {
        return std::nullopt;
    }
    const auto only = [&](auto matches) {
        std::vector<std::size_t> found;
        for (std::size_t c = 0; c < columns.size(); ++c) {
            if (matches(columns[c])) {
                found.push_back(c);
            }
        }
        return found;
    };
    const auto named = only([&](const TableColumn& column) { return column.name == name; });
    if (named.size() == 1) {
        return named.front();
    }
    const auto written = only([&](const TableColumn& column) { return column.header == name; });
    if (written.size() == 1) {
        return written.front();
    }
    if (named.size() + written.size() > 0) {
        throw SignalError(fmt::format("{}: two columns are named {}", path, name));
    }
    const auto remarked =
        only([&](const TableColumn& column) { return without_remark(column.name) == name; });
    if (!remarked.empty()) {
        return remarked.size() == 1 ? std::optional(remarked.front()) : std::nullopt;
    }
    const auto spelled = only(
        [&](const TableColumn& column) { return lower_case(column.name) == lower_case(name); });
    return spelled.size() == 1 ? std::optional(spelled.front()) : std::nullopt;
}

std::string column_names(const std::vector<TableColumn>& columns) {
    std::vector<std::string> names;
    for (const TableColumn& column : columns) {
        if (!column.name.empty()) {
            names.push_back(column.name);
        }
    }
    return names.empty() ? "" : listed_text(names);
}

}  // namespace gearpod::mc
