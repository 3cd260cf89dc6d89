#include "mc/files/text/text_table.hpp"

#include <fmt/format.h>

#include "mc/files/input/input_file.hpp"
#include "mc/files/signal_file.hpp"
#include "mc/files/text/text_dialect.hpp"

namespace gearpod::mc {
namespace {

constexpr std::size_t kMostTableRows = 1000000;

std::vector<std::string> comma_problems(const TextTable& table, char separator) {
    std::vector<CommaUse> uses(table.columns.size());
    bool points = false;
    for (const auto& row : table.rows) {
        for (std::size_t c = 0; c < uses.size(); ++c) {
            if (number_of(row[c], true)) {
                uses[c].add(row[c]);
                points = points || uses[c].has_points();
            }
        }
    }
    std::vector<std::string> problems;
    for (const CommaUse& use : uses) {
        problems.push_back(use.problem(separator, points));
    }
    return problems;
}

}  // namespace

std::optional<std::size_t> TextTable::find(const std::string& name) const {
    return find_column(columns, name, path);
}

std::optional<double> TextTable::number(std::size_t row, std::size_t column) const {
    const bool decimal_comma = comma_problems.empty() || comma_problems[column].empty();
    return number_of(rows[row][column], decimal_comma);
}

std::string TextTable::no_number_text(std::size_t row, std::size_t column) const {
    const std::string& field = rows[row][column];
    return field.find(',') != std::string::npos && !comma_problems.empty() &&
                   !comma_problems[column].empty()
               ? comma_problems[column]
               : not_a_number(field, "a finite number");
}

TextTable read_text_table(const std::string& path) {
    if (const std::string why = why_not_readable(path); !why.empty()) {
        throw SignalError(path + ": " + why);
    }
    const TextDialect dialect = text_dialect(path);
    TextTable table;
    table.path = path;
    table.columns = dialect.columns;
    TableRows rows(path, dialect);
    std::vector<std::string_view> fields;
    for (std::string_view line; rows.next(line);) {
        split_fields(line, dialect.separator, fields);
        check_row(dialect, fields, path, rows.number());
        if (table.rows.size() == kMostTableRows) {
            throw SignalError(
                fmt::format("{}:{}: more than {} rows", path, rows.number(), kMostTableRows));
        }
        table.rows.emplace_back();
        for (std::size_t c = 0; c < table.columns.size(); ++c) {
            table.rows.back().push_back(field_text(fields[c]));
        }
        table.lines.push_back(rows.number());
    }
    table.comma_problems = comma_problems(table, dialect.separator);
    return table;
}

}  // namespace gearpod::mc
