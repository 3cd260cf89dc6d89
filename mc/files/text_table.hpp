// Reads and writes tables of text in CSV files: a header line of names, then one line of fields per
// row.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace gearpod::mc {

struct TableColumn {
    std::string name;  // without the unit
    std::string unit;  // in brackets after the name, "[mm]" or "(mm)"; may be empty
};

struct TextTable {
    std::string path;
    char separator = ',';
    std::vector<TableColumn> columns;
    std::vector<std::vector<std::string>> rows;
    std::vector<long> lines;  // line number of each row, from 1

    // Index of the column with this name, if it exists.
    std::optional<std::size_t> find(const std::string& name) const;
    // List of the names, "a, b, c"; at most twenty.
    std::string names() const;
};

// Reads a CSV file. The separator is the comma, semicolon or tab that the header uses. Fields may
// be in double quotes, lines that begin with # are comments, and a byte order mark is skipped.
// Throws SignalError (signal_file.hpp) at the first invalid line, or if there are more than a
// million rows.
TextTable read_text_table(const std::string& path);

// The text as a CSV field (RFC 4180): in double quotes if it contains a separator, a quote or an
// end of line.
std::string csv_field(const std::string& text, std::string_view separators = ",");

// The field without surrounding blanks and quotes.
std::string_view trimmed_field(std::string_view text);
// Splits a header such as "sensor [m/s^2]" into name and unit.
TableColumn column_of(std::string_view header);
// Value of a field that is a number as a whole; NaN and infinity are accepted. A decimal comma is
// accepted if `decimal_comma` is set.
std::optional<double> number_of(std::string_view field, bool decimal_comma);

}  // namespace gearpod::mc
