// Recognizes the form of a text table: its separator, its header, and lines before and after that.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "mc/files/text/text_layout.hpp"
#include "mc/files/text/text_lines.hpp"

namespace gearpod::mc {

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

// Checks the number of fields of a row. Additional fields must be empty. Throws SignalError.
void check_row(const TextDialect& dialect, const std::vector<std::string_view>& fields,
               const std::string& path, long line);

}  // namespace gearpod::mc
