// Reads CSV files of signals.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>

#include "machine/no_value.hpp"
#include "mc/files/signal_file.hpp"
#include "mc/files/text/text_fields.hpp"
#include "mc/files/text/text_table.hpp"

namespace gearpod::mc {
namespace {

// Numbers of a column, up to its first field that is neither a number nor missing.
struct NumberColumn {
    std::vector<double> values;  // NaN where a value is missing
    std::string problem;         // of that field, with its line
    std::string first_missing;   // line and text of the first missing value
    long missing = 0;
    CommaUse commas;
};

class SignalCsv : public SignalFile {
  public:
    explicit SignalCsv(const std::string& path) : path_(path), dialect_(text_dialect(path)) {
        numbers_.resize(dialect_.columns.size());
        TableRows rows(path, dialect_);
        for (std::string_view line; rows.next(line);) {
            read_row(line, rows.number());
        }
        for (const NumberColumn& column : numbers_) {
            points_ = points_ || column.commas.has_points();
        }
    }

    std::vector<std::string> names() const override {
        std::vector<std::string> names;
        for (std::size_t c = 0; c < dialect_.columns.size(); ++c) {
            if (!dialect_.columns[c].name.empty()) {
                names.push_back(listed_name(c));
            }
        }
        return names;
    }
    // The name in names() is that without the unit if no other column has it.
    std::string find(const ColumnChoice& choice) override {
        const auto found = find_column(dialect_.columns, choice.name, path_);
        return found ? listed_name(*found) : "";
    }
    std::vector<std::string> notes() override { return unused_remarks(dialect_, path_); }
    std::vector<double> read(const std::string& name) override {
        const NumberColumn& column = numbers_[index(name)];
        if (!column.problem.empty()) {
            throw SignalError(column.problem);
        }
        const std::string commas = column.commas.problem(dialect_.separator, points_);
        if (!commas.empty()) {
            throw SignalError(fmt::format("{}: column {}: {}", path_, name, commas));
        }
        if (column.missing > 0) {
            throw SignalError(
                fmt::format("{}; {} of {} samples have no value: cut them off or fill the gaps",
                            column.first_missing, column.missing, column.values.size()));
        }
        return column.values;
    }
    std::string unit(const std::string& name) override {
        return dialect_.columns[index(name)].unit;
    }

  private:
    std::string listed_name(std::size_t c) const {
        const TableColumn& column = dialect_.columns[c];
        const bool only =
            std::ranges::count(dialect_.columns, column.name, &TableColumn::name) == 1;
        return only ? column.name : column.header;
    }
    std::size_t index(const std::string& name) const {
        return find_column(dialect_.columns, name, path_).value();
    }

    void read_row(std::string_view line, long number) {
        const char separator = dialect_.separator;
        if (separator == kBlanks) {
            split_fields(line, separator, fields_);
            check_row(dialect_, fields_, path_, number);
            for (std::size_t c = 0; c < numbers_.size(); ++c) {
                read_field(c, fields_[c], number);
            }
            return;
        }
        const char *const begin = line.data(), *const end = begin + line.size(), *at = begin;
        std::size_t c = 0;
        for (bool more = true; more; ++c) {
            const char* after = c < numbers_.size() ? read_plain(c, at, end) : nullptr;
            if (after == nullptr) {
                const auto from = static_cast<std::size_t>(at - begin);
                const std::size_t length = field_end(line, from, separator) - from;
                if (c < numbers_.size()) {
                    read_field(c, line.substr(from, length), number);
                }
                after = at + length;
            }
            more = after != end;
            at = after + 1;
        }
        if (c != numbers_.size()) {
            split_fields(line, separator, fields_);
            check_row(dialect_, fields_, path_, number);
        }
    }

    // Reads a field that is a number with nothing around it. Returns its end, or null if it is
    // anything else.
    const char* read_plain(std::size_t c, const char* at, const char* end) {
        NumberColumn& column = numbers_[c];
        double value = 0.0;
        const auto [after, error] = column.problem.empty()
                                        ? std::from_chars(at, end, value)
                                        : std::from_chars_result{at, std::errc::invalid_argument};
        if (error == std::errc{} && after != end && *after == ',' && dialect_.separator != ',') {
            return read_decimal_comma(column, at, end);
        }
        if (error != std::errc{} || (after != end && *after != dialect_.separator)) {
            return nullptr;
        }
        column.values.push_back(value);
        column.commas.add_plain({at, static_cast<std::size_t>(after - at)});
        return after;
    }

    const char* read_decimal_comma(NumberColumn& column, const char* at, const char* end) {
        std::array<char, 40> number{};
        std::size_t length = 0, commas = 0;
        for (; length < number.size() && at + length != end && at[length] != dialect_.separator;
             ++length) {
            const bool comma = at[length] == ',';
            number[length] = comma ? '.' : at[length];
            commas += comma || at[length] == '.' ? 1 : 0;
        }
        double value = 0.0;
        const char* const last = number.data() + length;
        const auto [after, error] = std::from_chars(number.data(), last, value);
        if (length == number.size() || commas != 1 || error != std::errc{} || after != last) {
            return nullptr;
        }
        column.values.push_back(value);
        column.commas.add({at, length});
        return at + length;
    }

    void read_field(std::size_t c, std::string_view field, long number) {
        NumberColumn& column = numbers_[c];
        if (!column.problem.empty()) {
            return;
        }
        const std::string_view text = trimmed_field(field);
        if (const auto value = number_of(text, true)) {
            column.values.push_back(*value);
            column.commas.add(text);
        } else if (is_missing(text)) {
            column.values.push_back(kNan);
            if (column.missing++ == 0) {
                column.first_missing =
                    fmt::format("{}:{}: column {}: {}", path_, number, dialect_.columns[c].name,
                                text.empty() ? "is empty" : fmt::format("is \"{}\"", text));
            }
        } else {
            column.problem = fmt::format("{}:{}: column {}: {}", path_, number,
                                         dialect_.columns[c].name, not_a_number(text));
            column.values = {};
        }
    }

    std::string path_;
    TextDialect dialect_;
    std::vector<NumberColumn> numbers_;
    std::vector<std::string_view> fields_;
    bool points_ = false;
};

}  // namespace

std::unique_ptr<SignalFile> open_signal_csv(const std::string& path) {
    return std::make_unique<SignalCsv>(path);
}

}  // namespace gearpod::mc
