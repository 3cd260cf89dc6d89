#include "mc/files/text_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <fstream>
#include <unordered_set>

#include "mc/files/signal_file.hpp"
#include "mc/input/input_file.hpp"

namespace gearpod::mc {
namespace {

constexpr std::size_t kMostTableRows = 1000000;
constexpr std::size_t kMostColumns = 10000;
constexpr std::size_t kLongestLine = 1 << 20;

// Splits a line. Quoted fields may contain the separator and doubled quotes.
std::vector<std::string> quoted_fields(std::string_view line, char separator) {
    std::vector<std::string> parts(1);
    bool quoted = false;
    for (std::size_t i = 0; i < line.size(); ++i) {
        const char c = line[i];
        if (c == '"' && quoted && i + 1 < line.size() && line[i + 1] == '"') {
            parts.back() += c;
            ++i;
        } else if (c == '"') {
            quoted = !quoted;
        } else if (c == separator && !quoted) {
            parts.emplace_back();
        } else {
            parts.back() += c;
        }
    }
    for (std::string& part : parts) {
        part = std::string(trimmed_field(part));
    }
    return parts;
}

void read_header(TextTable& table, std::string_view line, long number) {
    for (const char candidate : {';', '\t', ','}) {
        if (line.find(candidate) != std::string_view::npos) {
            table.separator = candidate;
            break;
        }
    }
    std::unordered_set<std::string> known;
    for (const std::string& field : quoted_fields(line, table.separator)) {
        table.columns.push_back(column_of(field));
        const std::string& name = table.columns.back().name;
        if (name.empty() || number_of(name, false)) {
            throw SignalError(
                fmt::format("{}:{}: column {} has no name; the first line must name the columns",
                            table.path, number, table.columns.size()));
        }
        if (!known.insert(name).second) {
            throw SignalError(
                fmt::format("{}:{}: two columns are named {}", table.path, number, name));
        }
    }
    if (table.columns.size() > kMostColumns) {
        throw SignalError(fmt::format("{}:{}: {} columns; at most {} are read", table.path, number,
                                      table.columns.size(), kMostColumns));
    }
}

void read_row(TextTable& table, std::string_view line, long number) {
    if (table.rows.size() == kMostTableRows) {
        throw SignalError(
            fmt::format("{}:{}: more than {} rows", table.path, number, kMostTableRows));
    }
    table.rows.push_back(quoted_fields(line, table.separator));
    table.lines.push_back(number);
    if (table.rows.back().size() != table.columns.size()) {
        throw SignalError(fmt::format("{}:{}: {} values, but the header names {} columns",
                                      table.path, number, table.rows.back().size(),
                                      table.columns.size()));
    }
}

}  // namespace

std::optional<std::size_t> TextTable::find(const std::string& name) const {
    for (std::size_t c = 0; c < columns.size(); ++c) {
        if (columns[c].name == name) {
            return c;
        }
    }
    return std::nullopt;
}

std::string TextTable::names() const {
    constexpr std::size_t kShown = 20;
    std::string text;
    for (std::size_t c = 0; c < std::min(columns.size(), kShown); ++c) {
        text += (c == 0 ? "" : ", ") + columns[c].name;
    }
    return columns.size() > kShown ? fmt::format("{} and {} more", text, columns.size() - kShown)
                                   : text;
}

TextTable read_text_table(const std::string& path) {
    TextTable table;
    table.path = path;
    if (const std::string why = why_not_readable(path); !why.empty()) {
        throw SignalError(path + ": " + why);
    }
    std::ifstream stream(path, std::ios::binary);
    std::string line;
    for (long number = 1; std::getline(stream, line); ++number) {
        std::string_view text = line;
        if (number == 1 && text.starts_with("\xEF\xBB\xBF")) {
            text.remove_prefix(3);
        }
        if (text.size() > kLongestLine || text.find('\0') != std::string_view::npos) {
            throw SignalError(fmt::format("{}:{}: is not a line of text", path, number));
        }
        const std::string_view seen = trimmed_field(text);
        if (seen.empty() || seen.front() == '#') {
            continue;
        }
        table.columns.empty() ? read_header(table, text, number) : read_row(table, text, number);
    }
    if (stream.bad()) {
        throw SignalError(path + ": cannot be read to its end");
    }
    if (table.columns.empty()) {
        throw SignalError(path + ": is empty; a header line of column names must come first");
    }
    return table;
}

std::string csv_field(const std::string& text, std::string_view separators) {
    if (text.find_first_of("\"\r\n") == std::string::npos &&
        text.find_first_of(separators) == std::string::npos) {
        return text;
    }
    std::string quoted = "\"";
    for (const char c : text) {
        quoted += c == '"' ? "\"\"" : std::string(1, c);
    }
    return quoted + '"';
}

std::string_view trimmed_field(std::string_view text) {
    constexpr std::string_view kBlank = " \t\r\"";
    const std::size_t first = text.find_first_not_of(kBlank);
    if (first == std::string_view::npos) {
        return {};
    }
    return text.substr(first, text.find_last_not_of(kBlank) - first + 1);
}

TableColumn column_of(std::string_view header) {
    const std::string_view text = trimmed_field(header);
    const std::size_t open = text.find_last_of("[(");
    if (open == std::string_view::npos || open == 0 ||
        text.back() != (text[open] == '[' ? ']' : ')')) {
        return {std::string(text.substr(0, text.find('['))), ""};
    }
    return {std::string(trimmed_field(text.substr(0, open))),
            std::string(trimmed_field(text.substr(open + 1, text.size() - open - 2)))};
}

std::optional<double> number_of(std::string_view field, bool decimal_comma) {
    std::string with_point;
    if (decimal_comma && field.find(',') != std::string_view::npos &&
        field.find('.') == std::string_view::npos) {
        with_point = field;
        std::replace(with_point.begin(), with_point.end(), ',', '.');
        field = with_point;
    }
    if (field.starts_with('+')) {
        field.remove_prefix(1);
    }
    double value = 0.0;
    const auto result = std::from_chars(field.data(), field.data() + field.size(), value);
    if (field.empty() || result.ec != std::errc{} || result.ptr != field.data() + field.size()) {
        return std::nullopt;
    }
    return value;
}

}  // namespace gearpod::mc
