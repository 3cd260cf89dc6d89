// A report as statements and tables in sections, and its rendering as screen, text and JSON.
#pragma once

#include <cstddef>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <variant>
#include <vector>

#include "machine/fields.hpp"

namespace gearpod::analysis {

// Width of the reports in columns: 80, or that of a wider terminal. Must be set
// before anything is written, while the program has one thread.
std::size_t text_width();
void set_text_width(std::size_t columns);

// Adds the text and an end of line. Breaks at spaces before the width; further lines are indented.
void add_wrapped(std::string& out, const std::string& text, std::size_t indent,
                 std::size_t width = text_width());

// A report: every finding in its final words, as statements and tables in sections. Analysis fills
// it once; the terminal, the JSON, the page and the PDF render it and word nothing themselves.

// Shortest text that prints a block.
enum class Shown {
    screen,  // the first screen; longer texts print it, too
    full,    // the complete text
    page,    // JSON and pages only
};

// A finding as one or more sentences. Plain text: "noise x 1", "2e-06 m/s^2"; a page may set the
// signs in its own type.
struct Statement {
    std::string key;  // name in the JSON, unique in a report, for example "headline" or "ranking.1"
    std::string text;
    Shown shown = Shown::full;
};
GEARPOD_FIELDS(Statement, key, text, shown_)

// Cells hold the text shown; the JSON has the numbers under keys of their own.
struct Table {
    std::string key;  // as in Statement
    std::string title;
    std::vector<std::string> columns;
    std::vector<std::vector<std::string>> rows;
    Shown shown = Shown::full;
    std::size_t labels = 1;  // first columns, repeated if a wide table is broken
};
GEARPOD_FIELDS(Table, key, title, columns, rows, shown_, labels)

struct Section {
    std::string key;    // its name on the command line
    std::string title;  // "" for none
    std::vector<std::variant<Statement, Table>> blocks;

    // Adds a statement, unless its text is empty.
    void state(const std::string& statement_key, const std::string& text,
               Shown shown = Shown::full);
    // Adds a table, unless it has no rows.
    void add(Table table);
};
GEARPOD_FIELDS(Section, key, title, blocks)

struct Report {
    std::vector<Section> sections;

    // Adds a section, unless it is empty.
    void add(Section section);
};

// Text of a statement; "" if the report does not make it.
std::string statement_text(const Report& report, const std::string& key);

// Complete text for the terminal, at most `width` columns wide. Tables that are wider continue in
// further blocks. Ends with a newline.
std::string report_text(const Report& report, std::size_t width = text_width());

inline constexpr std::size_t kScreenLines = 40, kScreenColumns = 80;
// First screen: the blocks with Shown::screen and then the lines of `end`, in at most kScreenLines
// lines of kScreenColumns. Tables that do not fit are cut, which the line after them states.
std::string screen_text(const Report& report, const std::vector<std::string>& end);

// The sections with these names, in the order of the report.
Report sections_of(const Report& report, const std::vector<std::string>& names);

// JSON form:
// [{"key", "title", "blocks": [{"key", "text"} or {"key", "title", "columns", "rows"}]}]
nlohmann::json findings_json(const Report& report);

}  // namespace gearpod::analysis
