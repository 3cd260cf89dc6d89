#include "mc/files/text/text_table.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "mc/files/foreign_file.hpp"
#include "mc/files/input/input_file.hpp"
#include "mc/files/input/number_text.hpp"
#include "mc/files/signal_file.hpp"
#include "mc/files/signal_units.hpp"

namespace gearpod::mc {
namespace {

constexpr std::size_t kStreamBuffer = std::size_t{1} << 18, kLongestLine = std::size_t{1} << 22;
constexpr std::size_t kMostColumns = 10000, kMostTableRows = 1000000;

// Reason why a file cannot be read as plain CSV.
struct NotPlain : SignalError {
    using SignalError::SignalError;
};

// True unless the line is blank, a comment or a row of empty fields.
bool is_row(std::string_view line) {
    // A digit begins most rows.
    if (!line.empty() && line.front() >= '0' && line.front() <= '9') {
        return true;
    }
    const std::string_view text = trimmed_field(line);
    return !text.empty() && text.front() != '#' &&
           text.find_first_not_of(",;\t ") != std::string_view::npos;
}

// True for the date that begins a time stamp: 2024-03-01.
bool is_date(std::string_view text) {
    constexpr std::string_view kForm = "0000-00-00";
    return text.size() > kForm.size() &&
           std::ranges::equal(text.substr(0, kForm.size()), kForm, [](char c, char form) {
               return form == '-' ? c == '-' : c >= '0' && c <= '9';
           });
}

// Column of a field of the header. Names that pandas makes up for row numbers are none.
TableColumn header_column(std::string_view field) {
    TableColumn column = column_of(field);
    return column.name.starts_with("Unnamed: ") ? TableColumn() : column;
}

}  // namespace

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

CsvRows::CsvRows(const std::string& file, const std::string& path, bool converted)
    : path_(path),
      converted_(converted),
      stream_buffer_(kStreamBuffer),
      line_buffer_(kLongestLine),
      number_(converted ? -1 : 0) {
    stream_.rdbuf()->pubsetbuf(stream_buffer_.data(), kStreamBuffer);
    stream_.open(file, std::ios::binary);
    std::string_view line;
    std::vector<std::string_view> names;
    if (!stream_) {
        throw SignalError(path + ": no such file, or it cannot be read");
    }
    if (!next(line)) {
        throw SignalError(path + ": is empty; a header line of column names must come first");
    }
    before_rows_ = true;
    split_fields(line, names);
    std::ranges::transform(names, std::back_inserter(columns_), header_column);
    if (columns_.size() > kMostColumns) {
        throw SignalError(fmt::format("{}:{}: {} columns; at most {} are supported", path, number_,
                                      columns_.size(), kMostColumns));
    }
    if (!converted) {
        check_names(line, names);
        check_first_rows();
    }
}

void CsvRows::refuse(const std::string& why) const {
    throw NotPlain(fmt::format("{}:{}: {}", path_, number_, why));
}

bool CsvRows::read_line(std::string_view& line) {
    stream_.getline(line_buffer_.data(), static_cast<std::streamsize>(kLongestLine));
    const auto got = static_cast<std::size_t>(stream_.gcount());
    if (stream_.bad()) {
        throw SignalError(path_ + ": cannot be read to its end");
    }
    if (got == 0) {
        return false;
    }
    ++number_;
    line = {line_buffer_.data(), stream_.good() ? got - 1 : got};
    if (stream_.fail()) {
        refuse(fmt::format("is not a line of text: longer than {} bytes", kLongestLine));
    }
    if (number_ == 1 && !converted_) {
        constexpr std::string_view kConverted[] = {"\xFF\xFE", "\xFE\xFF", "\x1F\x8B"};
        if (std::ranges::any_of(kConverted, [&](auto mark) { return line.starts_with(mark); })) {
            refuse("is UTF-16 or compressed");
        }
        if (line.starts_with('<') || line.starts_with("PK\x03\x04")) {
            throw SignalError(unknown_format_text(path_));
        }
        line.remove_prefix(line.starts_with("\xEF\xBB\xBF") ? 3 : 0);
    }
    if (line.find('\0') != std::string_view::npos) {
        throw SignalError(
            fmt::format("{}:{}: is not a line of text (UTF-16 needs a byte order mark)\n{}", path_,
                        number_, unknown_format_text(path_)));
    }
    line.remove_suffix(line.ends_with('\r') ? 1 : 0);
    return true;
}

bool CsvRows::next(std::string_view& line) {
    while (read_line(line)) {
        if (is_row(line)) {
            before_rows_ = false;
            if (line.find('"') != std::string_view::npos &&
                std::ranges::count(line, '"') % 2 != 0) {
                refuse("a quotation mark is not closed");
            }
            return true;
        }
        if (before_rows_) {
            add_note(line);
        }
    }
    return false;
}

void CsvRows::split(std::string_view line, std::vector<std::string_view>& fields) const {
    split_fields(line, fields);
    if (fields.size() != columns_.size()) {
        refuse(fmt::format("{} values, but the header names {} columns", fields.size(),
                           columns_.size()));
    }
}

void CsvRows::check_decimal_point(std::string_view field) const {
    const std::string_view text = trimmed_field(field);
    if (!converted_ && text.find(',') != std::string_view::npos &&
        text.find_first_not_of("0123456789+-,eE") == std::string_view::npos) {
        refuse(not_a_number(text));
    }
}

// Names are no numbers, and no other separator, end of line or "sep=" is among them.
void CsvRows::check_names(std::string_view line, const std::vector<std::string_view>& names) const {
    if (line.find_first_of(";\t\r") != std::string_view::npos ||
        trimmed_field(line).starts_with("sep=") || std::ranges::any_of(names, [](auto name) {
            return number_of(trimmed_field(name)).has_value();
        })) {
        refuse("is not a line of names");
    }
}

// Refuses text above numbers, such as a line of units, rows separated by blanks and time stamps.
void CsvRows::check_first_rows() {
    constexpr int kRows = 200;
    if (stream_.eof()) {
        return;
    }
    const auto begin = stream_.tellg();
    const long number = number_;
    std::string first, last;
    std::string_view line;
    for (int i = 0; i < kRows && next(line); ++i) {
        (i == 0 ? first : last) = line;
    }
    std::vector<std::string_view> above, below;
    split_fields(first, above);
    split_fields(last, below);
    for (std::size_t c = 0; c < std::min(above.size(), columns_.size()); ++c) {
        const std::string_view text = trimmed_field(above[c]);
        const bool number_below = c < below.size() && number_of(trimmed_field(below[c]));
        const bool blanks = columns_.size() == 1 && text.find_first_of(" \t") != text.npos;
        if (!is_missing(text) && !number_of(text) && (number_below || blanks || is_date(text))) {
            refuse(not_a_number(text));
        }
    }
    stream_.clear();
    stream_.seekg(begin);
    number_ = number;
}

void CsvRows::add_note(std::string_view comment) {
    constexpr std::string_view kStatements[] = {
        "unit", "scal", "factor", "gain", "sensitivity", "offset", "calibr", "rate", "sampl", "hz"};
    constexpr std::size_t kShown = 5, kShownBytes = 80;
    const std::string text =
        field_text(comment.substr(std::min(comment.find('#') + 1, comment.size())));
    const std::string lower = lower_case(text);
    if (notes_.size() < kShown && std::ranges::any_of(kStatements, [&](std::string_view word) {
            return lower.find(word) != std::string::npos;
        })) {
        notes_.push_back(
            fmt::format("{}:{}: not used: \"{}\"", path_, number_, text.substr(0, kShownBytes)));
    }
}

void read_csv(const std::string& path, const std::function<void(CsvRows&)>& read) {
    try {
        CsvRows rows(path, path, false);
        return read(rows);
    } catch (const NotPlain&) {
        // Python reads it, or states why it cannot.
    }
    const PythonOutputFile converted(path, "text");
    CsvRows rows(converted.name(), path, true);
    read(rows);
}

std::optional<std::size_t> TextTable::find(const std::string& name) const {
    return find_column(columns, name, path);
}

std::optional<double> TextTable::number(std::size_t row, std::size_t column) const {
    return number_of(rows[row][column]);
}

std::string TextTable::no_number_text(std::size_t row, std::size_t column) const {
    return not_a_number(rows[row][column], "a finite number");
}

namespace {

TextTable table_of_rows(CsvRows& rows, const std::string& path) {
    TextTable table{path, rows.columns(), {}, {}};
    std::vector<std::string_view> fields;
    for (std::string_view line; rows.next(line);) {
        rows.split(line, fields);
        if (table.rows.size() == kMostTableRows) {
            throw SignalError(
                fmt::format("{}:{}: more than {} rows", path, rows.number(), kMostTableRows));
        }
        table.lines.push_back(rows.number());
        table.rows.emplace_back();
        for (const std::string_view field : fields) {
            rows.check_decimal_point(field);
            table.rows.back().push_back(field_text(field));
        }
    }
    return table;
}

}  // namespace

TextTable read_text_table(const std::string& path) {
    if (const std::string why = why_not_readable(path); !why.empty()) {
        throw SignalError(path + ": " + why);
    }
    TextTable table;
    read_csv(path, [&](CsvRows& rows) { table = table_of_rows(rows, path); });
    return table;
}

TextTable read_converted_table(const std::string& path, const std::string& reader) {
    const PythonOutputFile converted(path, reader);
    CsvRows rows(converted.name(), path, true);
    return table_of_rows(rows, path);
}

}  // namespace gearpod::mc
