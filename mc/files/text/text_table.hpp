// Reads tables of text in CSV files: a header line of names, then one line of fields per row.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "mc/files/text/text_fields.hpp"

namespace gearpod::mc {

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

// Reads a CSV file in any usual form (text_dialect.hpp), plain or compressed with gzip
// (text_lines.hpp). Throws SignalError (signal_file.hpp) at the first invalid line, or if there are
// more than a million rows.
TextTable read_text_table(const std::string& path);

}  // namespace gearpod::mc
