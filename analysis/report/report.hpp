// A report as statements and tables in sections, and its rendering as text and JSON.
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

// A finding as one or more sentences. Plain text: "noise x 1", "2e-06 m/s^2"; a page may set the
// signs in its own type.
struct Statement {
    std::string key;  // name in the JSON, unique in a report, for example "headline" or "ranking.1"
    std::string text;
    bool detail = false;  // not on the terminal
};
GEARPOD_FIELDS(Statement, key, text, detail_)

// Cells hold the text shown; the JSON has the numbers under keys of their own.
struct Table {
    std::string key;  // as in Statement
    std::string title;
    std::vector<std::string> columns;
    std::vector<std::vector<std::string>> rows;
    bool detail = false;     // not on the terminal
    std::size_t labels = 1;  // first columns, repeated if a wide table is broken
};
GEARPOD_FIELDS(Table, key, title, columns, rows, detail_, labels)

struct Section {
    std::string key;
    std::string title;  // "" for none
    std::vector<std::variant<Statement, Table>> blocks;

    // Adds a statement, unless its text is empty.
    void state(const std::string& statement_key, const std::string& text, bool detail = false);
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

// Text for the terminal, at most `width` columns wide. Tables that are wider continue in further
// blocks. Ends with a newline.
std::string report_text(const Report& report, std::size_t width = text_width());

// JSON form:
// [{"key", "title", "blocks": [{"key", "text"} or {"key", "title", "columns", "rows"}]}]
nlohmann::json findings_json(const Report& report);

}  // namespace gearpod::analysis
