#include "analysis/report/report.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "analysis/report/json_values.hpp"

namespace gearpod::analysis {
namespace {

std::size_t columns_of_text = 80;

constexpr std::size_t kGap = 2;         // columns between cells
constexpr std::size_t kWordyCell = 24;  // longer cells of a last column are wrapped
constexpr std::size_t kLeastWords = 30;

// Layout of a table on the terminal.
class TableLines {
  public:
    TableLines(const Table& table, std::size_t most_columns)
        : table_(table), text_width_(most_columns) {
        for (std::size_t c = 0; c < table.columns.size(); ++c) {
            std::size_t width = table.columns[c].size();
            for (const auto& row : table.rows) {
                width = std::max(width, row[c].size());
            }
            widths_.push_back(width);
        }
        wordy_ = widths_.size() > 1 && widths_.back() > kWordyCell;
    }

    void add_to(std::string& out) const {
        std::size_t next = std::min(table_.labels, widths_.size());
        do {
            out += next > table_.labels ? "\n" : "";
            next = add_block(out, next, table_.rows.size());
        } while (next < widths_.size());
    }

    // Adds the first rows with the columns that fit.
    void add_start(std::string& out, std::size_t rows) const {
        const std::size_t columns = add_block(out, std::min(table_.labels, widths_.size()), rows);
        std::vector<std::string> cut;
        if (rows < table_.rows.size()) {
            cut.push_back(fmt::format("{} of {} rows", rows, table_.rows.size()));
        }
        if (columns < widths_.size()) {
            cut.push_back(fmt::format("{} of {} columns", columns, widths_.size()));
        }
        if (!cut.empty()) {
            out += fmt::format("({}; the full report has all)\n", fmt::join(cut, ", "));
        }
    }

  private:
    // Adds the labels and the columns from `next` on that fit. Returns the first one left out.
    std::size_t add_block(std::string& out, std::size_t next, std::size_t rows) const {
        const std::vector<std::size_t> columns = block_from(next);
        add_row(out, table_.columns, columns);
        for (std::size_t row = 0; row < rows; ++row) {
            add_row(out, table_.rows[row], columns);
        }
        return columns.back() + 1;
    }

    bool is_wordy(std::size_t column) const { return wordy_ && column + 1 == widths_.size(); }

    std::size_t space(std::size_t column) const {
        return (column == 0 ? 0 : kGap) +
               (is_wordy(column) ? std::min(widths_[column], kLeastWords) : widths_[column]);
    }

    // The label columns and as many others from `next` on as fit, at least one.
    std::vector<std::size_t> block_from(std::size_t next) const {
        std::vector<std::size_t> columns;
        std::size_t width = 0;
        for (std::size_t c = 0; c < std::min(table_.labels, widths_.size()); ++c) {
            columns.push_back(c);
            width += space(c);
        }
        for (bool first = true;
             next < widths_.size() && (first || width + space(next) <= text_width_);
             first = false) {
            width += space(next);
            columns.push_back(next++);
        }
        return columns;
    }

    void add_row(std::string& out, const std::vector<std::string>& cells,
                 const std::vector<std::size_t>& columns) const {
        std::string line;
        std::size_t indent = 0;
        for (const std::size_t c : columns) {
            line += c == 0 ? "" : std::string(kGap, ' ');
            indent = line.size();
            line += c == 0        ? fmt::format("{:<{}}", cells[c], widths_[c])
                    : is_wordy(c) ? cells[c]
                                  : fmt::format("{:>{}}", cells[c], widths_[c]);
        }
        line.erase(line.find_last_not_of(' ') + 1);
        if (is_wordy(columns.back())) {
            add_wrapped(out, line, indent, text_width_);
        } else {
            out += line + '\n';
        }
    }

    const Table& table_;
    const std::size_t text_width_;
    std::vector<std::size_t> widths_;
    bool wordy_ = false;
};

// Text of the blocks up to `shown`. `rows`: number of rows of each table on the screen; null for
// all rows and columns.
std::string blocks_text(const Report& report, Shown shown, std::size_t width,
                        const std::vector<std::size_t>* rows) {
    std::string out;
    std::size_t tables = 0;
    for (const Section& section : report.sections) {
        std::string body;
        bool after_table = false;
        for (const auto& block : section.blocks) {
            if (std::visit([&](const auto& one) { return one.shown > shown; }, block)) {
                continue;
            }
            const auto* table = std::get_if<Table>(&block);
            body += table != nullptr || after_table ? "\n" : "";
            after_table = table != nullptr;
            if (table == nullptr) {
                add_wrapped(body, std::get<Statement>(block).text, 2, width);
                continue;
            }
            if (!table->title.empty()) {
                add_wrapped(body, table->title, 2, width);
            }
            const TableLines lines(*table, width);
            if (rows != nullptr) {
                lines.add_start(body, (*rows)[tables++]);
            } else {
                lines.add_to(body);
            }
        }
        if (!body.empty()) {
            out += out.empty() ? "" : "\n";
            out += section.title.empty() ? body : section.title + '\n' + body;
        }
    }
    return out;
}

std::size_t line_count(const std::string& text) {
    return static_cast<std::size_t>(std::ranges::count(text, '\n'));
}

std::string first_lines(const std::string& text, std::size_t lines) {
    std::size_t end = 0;
    for (; lines > 0; --lines) {
        end = text.find('\n', end) + 1;
    }
    return text.substr(0, end);
}

}  // namespace

std::size_t text_width() {
    return columns_of_text;
}

void set_text_width(std::size_t columns) {
    columns_of_text = std::max<std::size_t>(80, columns);
}

void add_wrapped(std::string& out, const std::string& text, std::size_t indent, std::size_t width) {
    std::string line;
    for (std::size_t begin = 0; begin < text.size();) {
        const std::size_t end = std::min(text.find(' ', begin), text.size());
        const std::string word = text.substr(begin, end - begin);
        if (!line.empty() && line.size() + 1 + word.size() > width) {
            out += line + '\n';
            line = std::string(indent, ' ') + word;
        } else {
            line += (line.empty() || begin == 0 ? "" : " ") + word;
        }
        begin = end + 1;
    }
    out += line + '\n';
}

void Section::state(const std::string& statement_key, const std::string& text, Shown shown) {
    if (!text.empty()) {
        blocks.emplace_back(Statement{statement_key, text, shown});
    }
}

void Section::add(Table table) {
    if (!table.rows.empty()) {
        blocks.emplace_back(std::move(table));
    }
}

void Report::add(Section section) {
    if (!section.blocks.empty()) {
        sections.push_back(std::move(section));
    }
}

std::string statement_text(const Report& report, const std::string& key) {
    for (const Section& section : report.sections) {
        for (const auto& block : section.blocks) {
            const auto* statement = std::get_if<Statement>(&block);
            if (statement != nullptr && statement->key == key) {
                return statement->text;
            }
        }
    }
    return "";
}

std::string report_text(const Report& report, std::size_t width) {
    return blocks_text(report, Shown::full, width, nullptr);
}

std::string screen_text(const Report& report, const std::vector<std::string>& end) {
    std::string last;
    for (const std::string& line : end) {
        add_wrapped(last, line, 2, kScreenColumns);
    }
    const std::size_t room = kScreenLines - std::min(kScreenLines - 1, line_count(last));
    std::vector<std::size_t> rows;
    for (const Section& section : report.sections) {
        for (const auto& block : section.blocks) {
            const auto* table = std::get_if<Table>(&block);
            if (table != nullptr && table->shown == Shown::screen) {
                rows.push_back(table->rows.size());
            }
        }
    }
    std::string text = blocks_text(report, Shown::screen, kScreenColumns, &rows);
    for (auto longest = std::ranges::max_element(rows);
         line_count(text) > room && longest != rows.end() && *longest > 1;
         longest = std::ranges::max_element(rows)) {
        --*longest;
        text = blocks_text(report, Shown::screen, kScreenColumns, &rows);
    }
    if (line_count(text) > room) {
        text = first_lines(text, room - 1) + "(The full report has the rest.)\n";
    }
    return text + last;
}

Report sections_of(const Report& report, const std::vector<std::string>& names) {
    Report chosen;
    for (const Section& section : report.sections) {
        if (std::ranges::count(names, section.key) > 0) {
            chosen.sections.push_back(section);
        }
    }
    return chosen;
}

nlohmann::json findings_json(const Report& report) {
    return json_of(report.sections);
}

}  // namespace gearpod::analysis
