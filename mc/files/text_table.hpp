// Tables of text in CSV files: a header line of names, then a line of fields a row.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace gearpod::mc {

struct TableColumn {
    std::string name;  // without the unit
    std::string unit;  // in brackets behind the name, "[mm]" or "(mm)"; may be empty
};

struct TextTable {
    std::string path;
    char separator = ',';
    std::vector<TableColumn> columns;
    std::vector<std::vector<std::string>> rows;
    std::vector<long> lines;  // of each row, from 1

    // The column of that name, unless there is none.
    std::optional<std::size_t> find(const std::string& name) const;
    // "a, b, c", the first twenty.
    std::string names() const;
};

// Commas, semicolons or tabs between the fields, as the header has them; fields may stand in double
// quotes; lines that begin with # are comments; a byte order mark is left aside. Throws SignalError
// (signal_file.hpp) at the first line that does not fit, or with more than a million rows.
TextTable read_text_table(const std::string& path);

// The text as a field to write (RFC 4180): in double quotes where one of the separators, a quote or
// an end of line is inside.
std::string csv_field(const std::string& text, std::string_view separators = ",");

// Without blanks and quotes around it.
std::string_view trimmed_field(std::string_view text);
// "sensor [m/s^2]" in its parts.
TableColumn column_of(std::string_view header);
// The whole field as a number, with a decimal comma if that is allowed; NaN and infinity are
// numbers.
std::optional<double> number_of(std::string_view field, bool decimal_comma);

}  // namespace gearpod::mc
