#include "mc/files/text/table_columns.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "mc/files/signal_file.hpp"
#include "mc/files/signal_units.hpp"
#include "mc/files/text/text_fields.hpp"

namespace gearpod::mc {
namespace {

// Position of the bracket that the one at `close` closes; npos if there is none.
std::size_t opening_of(std::string_view text, std::size_t close) {
    const char closing = text[close], opening = closing == ']' ? '[' : '(';
    int depth = 0;
    for (std::size_t i = close + 1; i-- > 0;) {
        depth += text[i] == closing ? 1 : text[i] == opening ? -1 : 0;
        if (depth == 0) {
            return i;
        }
    }
    return std::string_view::npos;
}

// The text without its characters from `first` to `last`, which are a unit.
std::string without_part(std::string_view text, std::size_t first, std::size_t last) {
    const std::string before(trimmed_field(text.substr(0, first)));
    const std::string after(trimmed_field(text.substr(last + 1)));
    return before.empty() || after.empty() ? before + after : before + " " + after;
}

TableColumn split_header(const std::string& text) {
    const std::size_t square = text.rfind(']');
    if (square != std::string::npos) {
        const std::size_t open = opening_of(text, square);
        const std::string name = open == std::string::npos ? "" : without_part(text, open, square);
        if (!name.empty()) {
            const auto inside = std::string_view(text).substr(open + 1, square - open - 1);
            return {name, std::string(trimmed_field(inside)), text};
        }
    }
    if (text.ends_with(')')) {
        const std::size_t open = opening_of(text, text.size() - 1);
        if (open != std::string::npos && open > 0) {
            const auto inside = std::string_view(text).substr(open + 1, text.size() - open - 2);
            const bool number = std::ranges::all_of(
                inside, [](char c) { return (c >= '0' && c <= '9') || c == ' '; });  // of a channel
            if (!number && is_unit(inside)) {
                return {without_part(text, open, text.size() - 1),
                        std::string(trimmed_field(inside)), text};
            }
        }
    }
    const std::size_t slash = text.rfind(" / ");
    if (slash != std::string::npos && slash > 0 && is_unit(text.substr(slash + 3))) {
        return {std::string(trimmed_field(text.substr(0, slash))),
                std::string(trimmed_field(text.substr(slash + 3))), text};
    }
    return {text, "", text};
}

// The name without a remark in parentheses at its end.
std::string_view without_remark(std::string_view name) {
    const std::size_t open = name.ends_with(')') ? opening_of(name, name.size() - 1) : 0;
    return open == 0 || open == std::string_view::npos ? name : trimmed_field(name.substr(0, open));
}

}  // namespace

TableColumn column_of(std::string_view header) {
    return split_header(field_text(header));
}

std::optional<std::size_t> find_column(const std::vector<TableColumn>& columns,
                                       std::string_view name, const std::string& path) {
    if (name.empty()) {
        return std::nullopt;
    }
    const auto only = [&](auto matches) {
        std::vector<std::size_t> found;
        for (std::size_t c = 0; c < columns.size(); ++c) {
            if (matches(columns[c])) {
                found.push_back(c);
            }
        }
        return found;
    };
    const auto named = only([&](const TableColumn& column) { return column.name == name; });
    if (named.size() == 1) {
        return named.front();
    }
    const auto written = only([&](const TableColumn& column) { return column.header == name; });
    if (written.size() == 1) {
        return written.front();
    }
    if (named.size() + written.size() > 0) {
        throw SignalError(fmt::format("{}: two columns are named {}", path, name));
    }
    const auto remarked =
        only([&](const TableColumn& column) { return without_remark(column.name) == name; });
    return remarked.size() == 1 ? std::optional(remarked.front()) : std::nullopt;
}

std::string column_names(const std::vector<TableColumn>& columns) {
    std::vector<std::string> names;
    for (const TableColumn& column : columns) {
        if (!column.name.empty()) {
            names.push_back(column.name);
        }
    }
    return names.empty() ? "" : listed_text(names);
}

}  // namespace gearpod::mc
