// Reads CSV files of signals.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "machine/no_value.hpp"
#include "mc/files/signal_file.hpp"
#include "mc/files/text/text_table.hpp"

namespace gearpod::mc {
namespace {

// Numbers of a column, up to its first field that is neither a number nor missing.
struct NumberColumn {
    std::vector<double> values;  // NaN where a value is missing
    std::string problem;         // of that field, with its line
    std::string first_missing;   // line and text of the first missing value
    long missing = 0;
};

class SignalCsv : public SignalFile {
  public:
    explicit SignalCsv(const std::string& path) : path_(path) {
        read_csv(path, [&](CsvRows& rows) {
            columns_ = rows.columns();
            numbers_.assign(columns_.size(), {});
            for (std::string_view line; rows.next(line);) {
                read_row(line, rows);
            }
            notes_ = rows.notes();
        });
    }

    std::vector<std::string> names() const override {
        std::vector<std::string> names;
        for (std::size_t c = 0; c < columns_.size(); ++c) {
            if (!columns_[c].name.empty()) {
                names.push_back(listed_name(c));
            }
        }
        return names;
    }
    // The name in names() is that without the unit if no other column has it.
    std::string find(const ColumnChoice& choice) override {
        const auto found = find_column(columns_, choice.name, path_);
        return found ? listed_name(*found) : "";
    }
    std::vector<std::string> notes() override { return notes_; }
    std::vector<double> read(const std::string& name) override {
        const NumberColumn& column = numbers_[index(name)];
        if (!column.problem.empty()) {
            throw SignalError(column.problem);
        }
        if (column.missing > 0) {
            throw SignalError(
                fmt::format("{}; {} of {} samples have no value: cut them off or fill the gaps",
                            column.first_missing, column.missing, column.values.size()));
        }
        return column.values;
    }
    std::string unit(const std::string& name) override { return columns_[index(name)].unit; }

  private:
    std::string listed_name(std::size_t c) const {
        const TableColumn& column = columns_[c];
        const bool only = std::ranges::count(columns_, column.name, &TableColumn::name) == 1;
        return only ? column.name : column.header;
    }
    std::size_t index(const std::string& name) const {
        return find_column(columns_, name, path_).value();
    }

    void read_row(std::string_view line, const CsvRows& rows) {
        const char *const begin = line.data(), *const end = begin + line.size(), *at = begin;
        std::size_t c = 0;
        for (; at <= end && c < numbers_.size(); ++c) {
            const char* after = read_plain(numbers_[c], at, end);
            if (after == nullptr) {
                const auto from = static_cast<std::size_t>(at - begin);
                after = begin + field_end(line, from);
                read_field(c, {at, static_cast<std::size_t>(after - at)}, rows);
            }
            at = after + 1;
        }
        if (at <= end || c < numbers_.size()) {
            rows.split(line, fields_);  // throws the message
        }
    }

    // Reads a field that is a number with nothing around it. Returns its end, or null if it is
    // anything else.
    static const char* read_plain(NumberColumn& column, const char* at, const char* end) {
        double value = 0.0;
        if (!column.problem.empty()) {
            return nullptr;
        }
        const auto [after, error] = std::from_chars(at, end, value);
        if (error != std::errc{} || (after != end && *after != ',')) {
            return nullptr;
        }
        column.values.push_back(value);
        return after;
    }

    void read_field(std::size_t c, std::string_view field, const CsvRows& rows) {
        NumberColumn& column = numbers_[c];
        rows.check_decimal_point(field);
        if (!column.problem.empty()) {
            return;
        }
        const std::string_view text = trimmed_field(field);
        const auto stated = [&](const std::string& what) {
            return fmt::format("{}:{}: column {}: {}", path_, rows.number(), columns_[c].name,
                               what);
        };
        if (const auto value = number_of(text)) {
            column.values.push_back(*value);
        } else if (is_missing(text)) {
            column.values.push_back(kNan);
            if (column.missing++ == 0) {
                column.first_missing =
                    stated(text.empty() ? "is empty" : fmt::format("is \"{}\"", text));
            }
        } else {
            column.problem = stated(not_a_number(text));
            column.values = {};
        }
    }

    std::string path_;
    std::vector<TableColumn> columns_;
    std::vector<NumberColumn> numbers_;
    std::vector<std::string> notes_;
    std::vector<std::string_view> fields_;
};

}  // namespace

std::unique_ptr<SignalFile> open_signal_csv(const std::string& path) {
    return std::make_unique<SignalCsv>(path);
}

}  // namespace gearpod::mc
