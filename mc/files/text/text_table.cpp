#include "mc/files/text/text_table.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "mc/files/foreign_file.hpp"
#include "mc/files/input/input_file.hpp"
#include "mc/files/signal_file.hpp"

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
