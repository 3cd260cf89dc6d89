// Reads tables of text in CSV files: a header line of names, then one line of fields per row.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "mc/files/text/text_fields.hpp"
#include "mc/files/text/text_lines.hpp"

namespace gearpod::mc {

// Form of a text table: its separator, its header, and lines before and after that.

// Statement that a file makes in a line before its header.
struct TableRemark {
    long line = 0;
    std::string text;
};

struct TextDialect {
    char separator = ',';  // or kOneField, kBlanks (text_fields.hpp)
    // Columns up to the last with a name. Columns without a name, such as the row numbers that
    // pandas and R write, cannot be selected.
    std::vector<TableColumn> columns;
    long header_line = 0, last_header_line = 0;  // the latter is the line of units, if there is one
    std::vector<TableRemark> remarks;
};

// Recognizes the form from the first lines:
//
//   separator    the semicolon, tab, comma or blank that splits most lines into equal numbers of
//                fields; or that of a line "sep=;"
//   header       the first line of names that rows of this number of fields follow
//   units        a line of units between the names and the first row
//   remarks      other lines before the header, comments too
//
// Lines that begin with # are comments, except one with the names if no other line has them. The
// columns of a table of numbers alone are called 1, 2, ....
// Throws SignalError (signal_file.hpp) if there is no header.
TextDialect text_dialect(const std::string& path);

// Notes about remarks that state a unit, a scale or a sampling rate: they are not used.
std::vector<std::string> unused_remarks(const TextDialect& dialect, const std::string& path);

// Gives the rows after the header, without comments, blank lines and rows of empty fields.
class TableRows {
  public:
    TableRows(const std::string& path, const TextDialect& dialect);
    bool next(std::string_view& line);
    long number() const { return lines_.number(); }

  private:
    TextLines lines_;
    long last_header_line_;
};

// Checks the number of fields of a row. Throws SignalError unless additional fields are empty.
void check_row(const TextDialect& dialect, const std::vector<std::string_view>& fields,
               const std::string& path, long line);

struct TextTable {
    std::string path;
    std::vector<TableColumn> columns;
    std::vector<std::vector<std::string>> rows;  // UTF-8
    std::vector<long> lines;                     // line number of each row, from 1
    std::vector<std::string> comma_problems;     // of each column (CommaUse::problem), or none

    // Index of the column with this name, if it exists. Throws SignalError if two have it.
    std::optional<std::size_t> find(const std::string& name) const;
    // List of the names, "a, b, c"; at most twenty.
    std::string names() const { return column_names(columns); }
    // Value of a field with a decimal point or comma; empty if it is not a number.
    std::optional<double> number(std::size_t row, std::size_t column) const;
    // States why a field is not a number.
    std::string no_number_text(std::size_t row, std::size_t column) const;
};

// Reads a CSV file in any usual form (TextDialect), plain or compressed with gzip
// (text_lines.hpp). Throws SignalError (signal_file.hpp) at the first invalid line, or if there are
// more than a million rows.
TextTable read_text_table(const std::string& path);

}  // namespace gearpod::mc
