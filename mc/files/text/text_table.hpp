// Reads tables of text: plain CSV, and other forms that Python converts to it. Fields of a line of
// CSV, the numbers in them, and names of columns.
#pragma once

#include <fstream>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace gearpod::mc {

// Splits a line at its commas. Fields in double quotes may contain commas; they are given with
// their quotation marks. Blanks around fields are removed. `fields` is overwritten.
void split_fields(std::string_view line, std::vector<std::string_view>& fields);

// End of the field that begins at `at`: position of its comma, or the length of the line.
std::size_t field_end(std::string_view line, std::size_t at);

// The field without surrounding blanks and quotes.
std::string_view trimmed_field(std::string_view text);

// Text of a field in UTF-8, without its quotation marks.
std::string field_text(std::string_view field);

// True for an empty field and for the usual words for a missing value: NA, NaN, null, -, ...
bool is_missing(std::string_view field);

// Value of a field that is a number with a decimal point as a whole; NaN and infinity are accepted.
std::optional<double> number_of(std::string_view field);

// States that a field is not what it should be. A number may lack a decimal point.
std::string not_a_number(std::string_view field, std::string_view should_be = "a number");

// The text as a CSV field (RFC 4180): in double quotes if it contains a separator, a quote or an
// end of line. A text that begins like a formula (=, +, -, @) and is not a number gets an
// apostrophe in front, so that spreadsheets do not evaluate it.
std::string csv_field(const std::string& text, std::string_view separators = ",");

struct TableColumn {
    std::string name;         // without the unit; may be empty
    std::string unit;         // as written; may be empty
    std::string header = {};  // the whole field
};

// Splits a header into name and unit. Text in square brackets is the unit, whatever it is; text in
// parentheses at the end, or after " / ", only if it is a unit (is_unit). Otherwise it belongs to
// the name, like the place in "Accelerometer (rear)".
TableColumn column_of(std::string_view header);

// Index of the column with this name; else of that with this header; else of the only one whose
// name is this and a remark in parentheses; else of the only one that differs in case. Throws
// SignalError (signal_file.hpp) if two columns have the name.
std::optional<std::size_t> find_column(const std::vector<TableColumn>& columns,
                                       std::string_view name, const std::string& path);

// List of the names, "a, b, c"; at most twenty.
std::string column_names(const std::vector<TableColumn>& columns);

// Lines of a table in plain CSV: a line of names, then a line of as many fields per row, separated
// by commas. Blank lines, rows of empty fields and lines that begin with # are skipped.
class CsvRows {
  public:
    // Reads the names. `path` names the file in messages. A file that Python has converted has its
    // names in a line before the first one. All functions throw SignalError (signal_file.hpp), and
    // NotPlain if the file is not converted and has another form.
    CsvRows(const std::string& file, const std::string& path, bool converted);

    // Columns without a name, such as the row numbers that pandas and R write, cannot be selected.
    const std::vector<TableColumn>& columns() const { return columns_; }
    // Comments before the first row that state a unit, a scale or a sampling rate: not used.
    const std::vector<std::string>& notes() const { return notes_; }

    // Gives the next row, valid until the next call; false at the end of the file.
    bool next(std::string_view& line);
    // Number of its line, from 1.
    long number() const { return number_; }
    // Splits a row, whose number of fields must be that of the columns.
    void split(std::string_view line, std::vector<std::string_view>& fields) const;
    // Checks a field for a decimal comma.
    void check_decimal_point(std::string_view field) const;

  private:
    [[noreturn]] void refuse(const std::string& why) const;
    bool read_line(std::string_view& line);
    void check_names(std::string_view line, const std::vector<std::string_view>& names) const;
    void check_first_rows();
    void add_note(std::string_view comment);

    std::string path_;
    bool converted_;
    std::vector<char> stream_buffer_, line_buffer_;
    std::ifstream stream_;
    std::vector<TableColumn> columns_;
    std::vector<std::string> notes_;
    long number_ = 0;
    bool before_rows_ = true;
};

// Calls `read` with the rows of a table. If it is not plain CSV, Python converts it, which keeps
// the numbers of the lines (signal_files.py), and `read` is called with the rows from the first on.
void read_csv(const std::string& path, const std::function<void(CsvRows&)>& read);

struct TextTable {
    std::string path;
    std::vector<TableColumn> columns;
    std::vector<std::vector<std::string>> rows;  // UTF-8
    std::vector<long> lines;                     // line number of each row, from 1

    // Index of the column with this name, if it exists. Throws SignalError if two have it.
    std::optional<std::size_t> find(const std::string& name) const;
    // List of the names, "a, b, c"; at most twenty.
    std::string names() const { return column_names(columns); }
    // Value of a field; empty if it is not a number.
    std::optional<double> number(std::size_t row, std::size_t column) const;
    // States why a field is not a number.
    std::string no_number_text(std::size_t row, std::size_t column) const;
};

// Reads a table of at most a million rows. Throws SignalError (signal_file.hpp) at the first
// invalid line.
TextTable read_text_table(const std::string& path);

// The same for a table that Python makes of a file (`reader` of PythonOutputFile,
// foreign_file.hpp).
TextTable read_converted_table(const std::string& path, const std::string& reader);

}  // namespace gearpod::mc
