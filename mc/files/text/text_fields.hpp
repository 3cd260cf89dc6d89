// Fields of a line of CSV, the numbers in them, and names of columns.
#pragma once

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

}  // namespace gearpod::mc
