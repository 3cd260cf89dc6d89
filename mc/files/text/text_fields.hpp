// Fields of a line of a text table, and the numbers in them.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace gearpod::mc {

// Separators besides the comma, the semicolon and the tab: one field per line, and runs of blanks.
inline constexpr char kOneField = '\0', kBlanks = ' ';

// Splits a line. Fields in double quotes may contain the separator; they are given with their
// quotation marks. Blanks around fields are removed. `fields` is overwritten.
void split_fields(std::string_view line, char separator, std::vector<std::string_view>& fields);

// End of the field that begins at `at`: position of its separator, or the length of the line.
std::size_t field_end(std::string_view line, std::size_t at, char separator);

// The field without surrounding blanks and quotes.
std::string_view trimmed_field(std::string_view text);

// Text of a field in UTF-8, without its quotation marks.
std::string field_text(std::string_view field);

// True for an empty field and for the usual words for a missing value: NA, NaN, null, -, ...
bool is_missing(std::string_view field);

// Value of a field that is a number as a whole; NaN and infinity are accepted. A decimal comma is
// accepted if `decimal_comma` is set.
std::optional<double> number_of(std::string_view field, bool decimal_comma);

// States that a field is not what it should be, and whether thousands separators are the reason.
std::string not_a_number(std::string_view field, std::string_view should_be = "a number");

// Commas and points in the numbers of a column. A comma before each group of three digits may be a
// thousands separator, which would change the value by a factor of 1000.
class CommaUse {
  public:
    // Takes the text of a number.
    void add(std::string_view number);
    // The same for a number without a comma.
    void add_plain(std::string_view number) {
        if (!points_) {
            (number.find('.') != std::string_view::npos ? points_ : plain_) = true;
        }
    }
    bool has_points() const { return points_; }
    // Returns "" if every comma is a decimal comma, else why it may be another sign. `points` is
    // true if any number of the table has a decimal point.
    std::string problem(char separator, bool points) const;

  private:
    bool points_ = false, plain_ = false, decimal_commas_ = false;
    std::string grouped_;  // first number that may have a thousands separator
};

// The text as a CSV field (RFC 4180): in double quotes if it contains a separator, a quote or an
// end of line. A text that begins like a formula (=, +, -, @) and is not a number gets an
// apostrophe in front, so that spreadsheets do not evaluate it.
std::string csv_field(const std::string& text, std::string_view separators = ",");

// Names and units in the header of a text table.

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
