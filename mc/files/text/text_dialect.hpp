// Header and rows of a text table for one choice of the separator.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "mc/files/text/text_fields.hpp"
#include "mc/files/text/text_lines.hpp"

namespace gearpod::mc {

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

// One of the first lines of a file that are not blank.
struct SampledLine {
    long number = 0;
    std::string text;
    bool comment = false;
};

// Finds the header and the columns of numbers in the first lines of a file. `sample` outlives the
// layout.
class TextLayout {
  public:
    TextLayout(const std::vector<SampledLine>& sample, char separator);

    bool has_header() const { return header_.has_value(); }
    // Most common number of fields, and that of names in the header.
    std::size_t fields() const { return most_common_; }
    std::size_t header_fields() const { return named_[header()].size(); }
    const std::string& header_text() const { return sample_[lines_[header()]].text; }
    // Share of the lines from the header on that have the most common number of fields.
    double consistency() const;
    // True if a row has a decimal point or a quotation mark.
    bool any_point_or_quote() const;
    // The form of the table. Without a header, the first line is taken for it. Throws SignalError
    // (signal_file.hpp) if two lines state different units.
    TextDialect dialect(const std::string& path) const;
    // The form of a table whose names are in a comment directly before the first row.
    std::optional<TextDialect> commented_header() const;

  private:
    std::size_t header() const { return header_.value_or(0); }
    void count_fields();
    void find_numeric_columns();
    void find_header();
    bool fits(std::size_t line) const;
    bool is_row(std::size_t line, bool strict = false) const;
    bool is_header(std::size_t line) const;
    bool is_units(std::size_t line) const;
    bool followed_by_rows(std::size_t first, bool one_is_enough) const;
    bool row_names() const;
    void add_units(TextDialect& dialect, const std::string& path) const;

    const std::vector<SampledLine>& sample_;
    char separator_;
    std::vector<std::size_t> lines_;                     // places of the others in the sample
    std::vector<std::vector<std::string_view>> fields_;  // of those that are not comments
    std::vector<std::vector<std::string_view>> named_;   // without empty fields at the end
    std::size_t most_common_ = 0;
    std::vector<std::size_t> numeric_;  // columns of numbers
    std::optional<std::size_t> header_, units_;
};

// Recognizes the form of a text table: its separator, its header, and lines before and after that.

// Recognizes the form from the first lines:
//
//   separator    the semicolon, tab, comma or blank that splits most lines into equal numbers of
//                fields; or that of a line "sep=;"
//   header       the first line of names that rows of this number of fields follow
//   units        a line of units between the names and the first row
//   remarks      other lines before the header, comments too
//
// Lines that begin with # are comments, except one with the names if no other line has them.
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

}  // namespace gearpod::mc
