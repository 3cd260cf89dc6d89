#include "mc/files/text/text_dialect.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "mc/files/signal_file.hpp"
#include "mc/files/text/text_fields.hpp"
#include "mc/input/utf8.hpp"

namespace gearpod::mc {
namespace {

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

void check_columns(const TextDialect& dialect, const std::string& path) {
    if (dialect.columns.size() > kMostColumns) {
        throw SignalError(fmt::format("{}:{}: {} columns; at most {} are supported", path,
                                      dialect.header_line, dialect.columns.size(), kMostColumns));
    }
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
    const char separator = stated.value_or('\0') != '\0' ? *stated : choose_separator(sample);
    const TextLayout layout(sample, separator);
    TextDialect dialect;
    if (layout.has_header()) {
        dialect = layout.dialect(path);
    } else if (const auto commented = layout.commented_header()) {
        dialect = *commented;
    } else {
        dialect = layout.dialect(path);
        for (std::size_t c = 0; c < dialect.columns.size(); ++c) {
            const std::string& name = dialect.columns[c].name;
            if (number_of(name, true)) {
                throw SignalError(fmt::format(
                    "{}:{}: column {} has no name; the first line must name the columns", path,
                    dialect.header_line, c + 1));
            }
        }
    }
    check_columns(dialect, path);
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

}  // namespace gearpod::mc
