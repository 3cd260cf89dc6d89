#include "mc/files/text/text_fields.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "mc/files/input/input_file.hpp"
#include "mc/files/input/number_text.hpp"
#include "mc/files/signal_file.hpp"
#include "mc/files/signal_units.hpp"

namespace gearpod::mc {

std::size_t field_end(std::string_view line, std::size_t at) {
    const std::size_t begin = line.find_first_not_of(' ', at);
    if (begin == std::string_view::npos || line[begin] != '"') {
        return std::min(line.find(',', at), line.size());
    }
    std::size_t end = begin;
    for (bool quoted = false; end < line.size() && (quoted || line[end] != ','); ++end) {
        quoted = quoted != (line[end] == '"');
    }
    return end;
}

void split_fields(std::string_view line, std::vector<std::string_view>& fields) {
    fields.clear();
    for (std::size_t at = 0; at <= line.size();) {
        const std::size_t end = field_end(line, at);
        fields.push_back(without_outer_blanks(line.substr(at, end - at)));
        at = end + 1;
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
    if (field.size() < 2 || !field.starts_with('"') || !field.ends_with('"')) {
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

std::optional<double> number_of(std::string_view field) {
    if (field.starts_with('+')) {
        field.remove_prefix(1);
    }
    return parsed_number<double>(field);
}

std::string not_a_number(std::string_view field, std::string_view should_be) {
    const std::string_view text = trimmed_field(field);
    constexpr std::string_view kDigits = "0123456789", kGroups = "+-., '\xC2\xA0";
    const bool number = text.find_first_of(kDigits) != text.npos &&
                        text.find_first_not_of(std::string(kDigits).append(kGroups)) == text.npos;
    return fmt::format("\"{}\" is not {}{}", field_text(text.substr(0, 40)), should_be,
                       number ? "; write all numbers of the table with a decimal point and without "
                                "thousands separators"
                              : "");
}

std::string csv_field(const std::string& text, std::string_view separators) {
    const std::string_view seen = without_outer_blanks(text);
    const bool formula = seen.size() > 1 && seen.find_first_of("=+-@") == 0 && !number_of(seen);
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
    const auto matching = [&](auto matches) {
        std::vector<std::size_t> found;
        for (std::size_t c = 0; c < columns.size(); ++c) {
            if (matches(columns[c])) {
                found.push_back(c);
            }
        }
        return found;
    };
    const auto named = matching([&](const TableColumn& column) { return column.name == name; });
    const auto written = matching([&](const TableColumn& column) { return column.header == name; });
    if (named.size() == 1 || written.size() == 1) {
        return named.size() == 1 ? named.front() : written.front();
    }
    if (named.size() + written.size() > 0) {
        throw SignalError(fmt::format("{}: two columns are named {}", path, name));
    }
    auto found =
        matching([&](const TableColumn& column) { return without_remark(column.name) == name; });
    if (found.empty()) {
        found = matching(
            [&](const TableColumn& column) { return lower_case(column.name) == lower_case(name); });
    }
    return found.size() == 1 ? std::optional(found.front()) : std::nullopt;
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
