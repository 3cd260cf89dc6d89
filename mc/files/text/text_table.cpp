#include "mc/files/text/text_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>

#include "machine/contracts.hpp"
#include "mc/files/input/file_text.hpp"
#include "mc/files/input/input_file.hpp"
#include "mc/files/signal_file.hpp"
#include "mc/files/signal_units.hpp"
#include "mc/files/text/text_fields.hpp"

namespace gearpod::mc {

namespace {

bool is_numeric_field(std::string_view field) {
    return number_of(trimmed_field(field), true).has_value();
}

// Splits a line for one separator, without empty fields at its end.
std::vector<std::string_view> named_fields(std::string_view line, char separator) {
    std::vector<std::string_view> fields;
    split_fields(line, separator, fields);
    while (fields.size() > 1 && trimmed_field(fields.back()).empty()) {
        fields.pop_back();
    }
    if (separator != kBlanks) {
        return fields;
    }
    // A unit in brackets belongs to the name before it.
    std::vector<std::string_view> joined;
    for (const std::string_view field : fields) {
        if (!joined.empty() && (field.starts_with('[') || field.starts_with('('))) {
            joined.back() = std::string_view(
                joined.back().data(),
                static_cast<std::size_t>(field.data() + field.size() - joined.back().data()));
        } else {
            joined.push_back(field);
        }
    }
    return joined;
}

std::string unit_in(std::string_view field) {
    const std::string text = field_text(field);
    const bool brackets = text.size() > 1 && ((text.front() == '[' && text.back() == ']') ||
                                              (text.front() == '(' && text.back() == ')'));
    return brackets ? text.substr(1, text.size() - 2) : text;
}

// Column of a field of the header. Names that pandas makes up for row numbers are none.
TableColumn header_column(std::string_view field) {
    TableColumn column = column_of(field);
    return column.name.starts_with("Unnamed: ") ? TableColumn() : column;
}

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
    TextLayout(const std::vector<SampledLine>& sample, char separator)
        : sample_(sample), separator_(separator) {
        EXPECTS(std::ranges::any_of(sample, [](const SampledLine& line) { return !line.comment; }));
        for (std::size_t i = 0; i < sample.size(); ++i) {
            if (!sample[i].comment) {
                lines_.push_back(i);
                fields_.emplace_back();
                split_fields(sample[i].text, separator, fields_.back());
                named_.push_back(named_fields(sample[i].text, separator));
            }
        }
        count_fields();
        find_numeric_columns();
        find_header();
    }

    // Share of the lines from the header on that have the most common number of fields.
    double consistency() const {
        std::size_t good = 0;
        const std::size_t first = header();
        for (std::size_t i = first; i < named_.size(); ++i) {
            good += fits(i) ? 1 : 0;
        }
        return static_cast<double>(good) / static_cast<double>(named_.size() - first);
    }

    // True if a row has a decimal point or a quotation mark.
    bool any_point_or_quote() const {
        for (std::size_t i = header() + 1; i < fields_.size(); ++i) {
            for (const std::string_view field : fields_[i]) {
                if (field.find_first_of(".\"") != std::string_view::npos) {
                    return true;
                }
            }
        }
        return false;
    }

    // The form of the table. Without a header, the first line is taken for it. Throws SignalError
    // if two lines state different units.
    TextDialect dialect(const std::string& path) const {
        TextDialect dialect;
        dialect.separator = separator_;
        const std::size_t names = header();
        for (std::size_t i = 0; i < lines_[names]; ++i) {
            dialect.remarks.push_back({sample_[i].number, field_text(sample_[i].text)});
        }
        dialect.header_line = dialect.last_header_line = sample_[lines_[names]].number;
        if (row_names()) {
            dialect.columns.emplace_back();
        }
        for (const std::string_view field : named_[names]) {
            dialect.columns.push_back(header_column(field));
        }
        if (units_) {
            dialect.last_header_line = sample_[lines_[*units_]].number;
            add_units(dialect, path);
        }
        return dialect;
    }

    // The form of a table whose names are in a comment directly before the first row.
    std::optional<TextDialect> commented_header() const {
        if (lines_.empty() || lines_.front() == 0 || !sample_[lines_.front() - 1].comment) {
            return std::nullopt;
        }
        const SampledLine& line = sample_[lines_.front() - 1];
        std::string_view text = line.text;
        text.remove_prefix(text.find('#') + 1);
        const auto names = named_fields(text, separator_);
        if (names.size() != most_common_ || std::ranges::any_of(names, is_numeric_field)) {
            return std::nullopt;
        }
        TextDialect dialect;
        dialect.separator = separator_;
        dialect.header_line = dialect.last_header_line = line.number;
        for (const std::string_view name : names) {
            dialect.columns.push_back(header_column(name));
        }
        return dialect;
    }

    bool has_header() const { return header_.has_value(); }
    // Most common number of fields, and that of names in the header.
    std::size_t fields() const { return most_common_; }
    std::size_t header_fields() const { return named_[header()].size(); }
    const std::string& header_text() const { return sample_[lines_[header()]].text; }

  private:
    std::size_t header() const { return header_.value_or(0); }

    // The most common number of fields in the second half of the lines.
    void count_fields() {
        std::map<std::size_t, int> counts;
        for (std::size_t i = named_.size() / 2; i < named_.size(); ++i) {
            ++counts[fields_[i].size()];
        }
        int most = 0;
        for (const auto& [fields, count] : counts) {
            if (count >= most) {
                most = count;
                most_common_ = fields;
            }
        }
    }

    void find_numeric_columns() {
        std::vector<int> numbers(most_common_), all(most_common_);
        for (std::size_t i = named_.size() / 2; i < named_.size(); ++i) {
            for (std::size_t c = 0; c < std::min(most_common_, fields_[i].size()); ++c) {
                if (!is_missing(fields_[i][c])) {
                    ++all[c];
                    numbers[c] += is_numeric_field(fields_[i][c]) ? 1 : 0;
                }
            }
        }
        for (std::size_t c = 0; c < most_common_; ++c) {
            if (numbers[c] > 0 && 2 * numbers[c] >= all[c]) {
                numeric_.push_back(c);
            }
        }
    }

    // True if the line has the usual number of fields, apart from empty ones at its end.
    bool fits(std::size_t line) const {
        return fields_[line].size() == most_common_ ||
               (named_[line].size() <= most_common_ && fields_[line].size() > most_common_);
    }

    // True if at least half of the columns of numbers have one, or all if `strict` is set.
    bool is_row(std::size_t line, bool strict = false) const {
        if (line >= named_.size() || !fits(line)) {
            return false;
        }
        std::size_t good = 0, numbers = 0;
        for (const std::size_t c : numeric_) {
            const std::string_view field = c < fields_[line].size() ? fields_[line][c] : "";
            numbers += is_numeric_field(field) ? 1 : 0;
            good += is_numeric_field(field) || is_missing(field) ? 1 : 0;
        }
        return numeric_.empty() ||
               (numbers > 0 && (strict ? good == numeric_.size() : 2 * good >= numeric_.size()));
    }

    bool is_header(std::size_t line) const {
        const auto& names = named_[line];
        const bool fields =
            names.size() == most_common_ || names.size() + 1 == most_common_ || fits(line);
        return fields &&
               std::ranges::any_of(names, [](auto name) { return !trimmed_field(name).empty(); }) &&
               std::ranges::none_of(names, [](auto name) {
                   return is_numeric_field(name) || trimmed_field(name).ends_with(':');
               });
    }

    bool is_units(std::size_t line) const {
        bool any = false;
        for (const std::string_view field : named_[line]) {
            if (is_numeric_field(field)) {
                return false;
            }
            any = any || is_unit(unit_in(field));
        }
        return any;
    }

    // Finds the first line of names that is followed by rows; the first line is preferred.
    void find_header() {
        // Text does not show where a header ends: the first line is it.
        if (numeric_.empty() && is_header(0) && fits(0)) {
            header_ = 0;
        }
        for (const bool all : {true, false}) {
            for (std::size_t i = 0; i < named_.size() && !header_; ++i) {
                if (is_header(i)) {
                    const bool units = i + 1 < named_.size() && is_units(i + 1) &&
                                       !numeric_.empty() && !is_row(i + 1);
                    const std::size_t first = i + (units ? 2 : 1);
                    if (followed_by_rows(first, i == 0 && !all)) {
                        header_ = i;
                        units_ = units ? std::optional(i + 1) : std::nullopt;
                    }
                }
                if (!header_ && !numeric_.empty() && is_row(i, true)) {
                    break;  // rows before any names
                }
            }
        }
        if (!header_ && named_.size() == 1 && is_header(0)) {
            header_ = 0;
        }
    }

    bool followed_by_rows(std::size_t first, bool one_is_enough) const {
        const std::size_t rows = one_is_enough ? 1 : numeric_.empty() ? named_.size() : 4;
        const std::size_t end = std::min(first + rows, named_.size());
        bool good = first < named_.size() || first == 1;
        for (std::size_t i = first; i < end; ++i) {
            good = good && is_row(i);
        }
        return good;
    }

    // True if the rows begin with row names that the header does not name, as R writes them:
    // quoted, or counted from 1.
    bool row_names() const {
        const std::size_t first = header() + (units_ ? 2 : 1);
        if (named_[header()].size() + 1 != most_common_ ||
            fields_[header()].size() != most_common_ - 1 || first >= fields_.size()) {
            return false;
        }
        for (std::size_t i = first; i < fields_.size(); ++i) {
            const std::string_view name = fields_[i].front();
            if (!name.starts_with('"') && name != std::to_string(i - first + 1)) {
                return false;
            }
            if (trimmed_field(fields_[i].back()).empty()) {
                return false;
            }
        }
        return true;
    }

    void add_units(TextDialect& dialect, const std::string& path) const {
        const auto& units = fields_[*units_];
        const std::size_t shift = row_names() ? 1 : 0;
        for (std::size_t c = 0; c < dialect.columns.size(); ++c) {
            TableColumn& column = dialect.columns[c];
            const std::string unit =
                c >= shift && c - shift < units.size() ? unit_in(units[c - shift]) : "";
            if (unit.empty() || unit == "-" || column.name.empty()) {
                continue;
            }
            if (!column.unit.empty() && plain_unit(column.unit) != plain_unit(unit)) {
                throw SignalError(
                    fmt::format("{}:{}: column {}: unit {}, but the line before states "
                                "{}",
                                path, dialect.last_header_line, column.name, unit, column.unit));
            }
            column.unit = unit;
        }
    }

    const std::vector<SampledLine>& sample_;
    char separator_;
    std::vector<std::size_t> lines_;                     // indices of the others in the sample
    std::vector<std::vector<std::string_view>> fields_;  // of those that are not comments
    std::vector<std::vector<std::string_view>> named_;   // without empty fields at the end
    std::size_t most_common_ = 0;
    std::vector<std::size_t> numeric_;  // columns of numbers
    std::optional<std::size_t> header_, units_;
};

constexpr std::size_t kSampledLines = 200, kSampledBytes = std::size_t{1} << 19;
constexpr std::size_t kMostColumns = 10000;

std::vector<SampledLine> first_lines(const std::string& path) {
    TextLines lines(path);
    std::vector<SampledLine> sample;
    std::string_view line;
    for (std::size_t bytes = 0;
         sample.size() < kSampledLines && bytes < kSampledBytes && lines.next(line);) {
        const std::string_view seen = trimmed_field(line);
        if (!seen.empty()) {
            sample.push_back({lines.number(), std::string(line), seen.front() == '#'});
            bytes += line.size();
        }
    }
    return sample;
}

// Separator of a first line "sep=;".
std::optional<char> stated_separator(const std::vector<SampledLine>& sample) {
    const std::string_view text =
        sample.empty() ? std::string_view() : std::string_view(sample.front().text);
    const std::size_t at = text.find("sep=");
    const bool alone = at != std::string_view::npos && text.find_first_not_of(" \"") == at &&
                       text.size() > at + 4 &&
                       text.find_first_not_of(" \"", at + 5) == std::string_view::npos;
    return alone ? std::optional(text[at + 4]) : std::nullopt;
}

char choose_separator(const std::vector<SampledLine>& sample) {
    char best = kOneField;
    double most = -1.0;
    for (const char separator : {';', '\t', ','}) {
        const TextLayout layout(sample, separator);
        const bool splits =
            layout.fields() > 1 && (layout.has_header() || layout.commented_header());
        // One name above numbers with decimal commas: the comma separates nothing.
        const bool decimal =
            separator == ',' && layout.header_fields() == 1 && !layout.any_point_or_quote();
        if (splits && !decimal && layout.consistency() > most) {
            best = separator;
            most = layout.consistency();
        }
    }
    if (best == kOneField) {
        const TextLayout blanks(sample, kBlanks);
        if (blanks.fields() > 1 && blanks.header_fields() > 1 && blanks.consistency() == 1.0 &&
            (blanks.has_header() || blanks.commented_header())) {
            return kBlanks;
        }
        // Names that no row fits: the message about the first row states it.
        const std::string header = TextLayout(sample, kOneField).header_text();
        for (const char separator : {';', '\t', ','}) {
            if (field_end(header, 0, separator) < header.size()) {
                return separator;
            }
        }
    }
    return best;
}

// Form of a table of numbers without a line of names: columns 1, 2, ...; empty for others.
std::optional<TextDialect> unnamed_columns(const std::vector<SampledLine>& sample) {
    for (const char separator : {';', '\t', ',', kBlanks, kOneField}) {
        std::size_t count = 0;
        bool numbers = !TextLayout(sample, separator).commented_header();
        for (const SampledLine& line : sample) {
            std::vector<std::string_view> fields;
            if (line.comment) {
                continue;
            }
            split_fields(line.text, separator, fields);
            while (fields.size() > 1 && trimmed_field(fields.back()).empty()) {
                fields.pop_back();
            }
            count = count == 0 ? fields.size() : count;
            numbers = numbers && fields.size() == count &&
                      std::ranges::all_of(fields, [](std::string_view field) {
                          return number_of(trimmed_field(field), true).has_value();
                      });
        }
        if (numbers && count > (separator == kOneField ? 0U : 1U)) {
            TextDialect dialect;
            dialect.separator = separator;
            for (std::size_t c = 1; c <= count; ++c) {
                dialect.columns.push_back({std::to_string(c), "", std::to_string(c)});
            }
            return dialect;
        }
    }
    return std::nullopt;
}

}  // namespace

TextDialect text_dialect(const std::string& path) {
    std::vector<SampledLine> sample = first_lines(path);
    const auto stated = stated_separator(sample);
    if (stated) {
        sample.erase(sample.begin());
    }
    const auto text = std::ranges::find(sample, false, &SampledLine::comment);
    if (text == sample.end()) {
        throw SignalError(path + ": is empty; a header line of column names must come first");
    }
    if (const auto unnamed = unnamed_columns(sample)) {
        return *unnamed;
    }
    const char separator = stated.value_or('\0') != '\0' ? *stated : choose_separator(sample);
    const TextLayout layout(sample, separator);
    const auto commented = layout.has_header() ? std::nullopt : layout.commented_header();
    const TextDialect dialect = commented ? *commented : layout.dialect(path);
    if (dialect.columns.size() > kMostColumns) {
        throw SignalError(fmt::format("{}:{}: {} columns; at most {} are supported", path,
                                      dialect.header_line, dialect.columns.size(), kMostColumns));
    }
    return dialect;
}

std::vector<std::string> unused_remarks(const TextDialect& dialect, const std::string& path) {
    constexpr std::string_view kStatements[] = {
        "unit", "scal", "factor", "gain", "sensitivity", "offset", "calibr", "rate", "sampl", "hz"};
    constexpr std::size_t kShown = 5, kShownBytes = 80;
    std::vector<std::string> notes;
    for (const TableRemark& remark : dialect.remarks) {
        const std::string lower = lower_case(remark.text);
        const bool statement = std::ranges::any_of(
            kStatements, [&](auto word) { return lower.find(word) != std::string::npos; });
        if (statement && notes.size() < kShown) {
            notes.push_back(fmt::format("{}:{}: not used: \"{}\"", path, remark.line,
                                        remark.text.substr(0, kShownBytes)));
        }
    }
    return notes;
}

TableRows::TableRows(const std::string& path, const TextDialect& dialect)
    : lines_(path), last_header_line_(dialect.last_header_line) {}

bool TableRows::next(std::string_view& line) {
    while (lines_.next(line)) {
        if (lines_.number() > last_header_line_) {
            // A digit begins most rows.
            const char first = line.empty() ? ' ' : line.front();
            if (first >= '0' && first <= '9') {
                return true;
            }
            const std::string_view seen = trimmed_field(line);
            if (!seen.empty() && seen.front() != '#' &&
                seen.find_first_not_of(",;\t ") != std::string_view::npos) {
                return true;
            }
        }
    }
    return false;
}

void check_row(const TextDialect& dialect, const std::vector<std::string_view>& fields,
               const std::string& path, long line) {
    std::size_t used = fields.size();
    while (used > dialect.columns.size() && trimmed_field(fields[used - 1]).empty()) {
        --used;
    }
    if (used != dialect.columns.size()) {
        throw SignalError(fmt::format("{}:{}: {} values, but the header names {} columns", path,
                                      line, fields.size(), dialect.columns.size()));
    }
}

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
