#include "mc/study/elements/file_column.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "mc/files/formats/file_content.hpp"
#include "mc/files/formats/uff_file.hpp"
#include "mc/files/signal_file.hpp"
#include "mc/files/text/text_table.hpp"
#include "mc/study/elements/uff_response.hpp"
#include "mc/study/housing_bearings.hpp"

namespace gearpod::mc {
namespace {

const std::string* text_at(const Value& table, std::string_view name) {
    const Entry* entry = table.find(name);
    return entry != nullptr && entry->value.kind == Value::Kind::text ? &entry->value.text
                                                                      : nullptr;
}

}  // namespace

std::optional<FileColumn> file_column(const Value& value) {
    if (value.kind != Value::Kind::table) {
        return std::nullopt;
    }
    const std::string *file = text_at(value, "file"), *column = text_at(value, "column");
    return file != nullptr && column != nullptr ? std::optional(FileColumn{*file, *column})
                                                : std::nullopt;
}

namespace {

// Numbers of a column of a text table.
std::vector<double> table_column(const FileColumn& source) {
    const TextTable table = read_text_table(source.file);
    const auto column = table.find(source.column);
    if (!column) {
        throw SignalError(fmt::format("{}: no column {}; its columns are {}", source.file,
                                      source.column, table.names()));
    }
    if (table.rows.empty()) {
        throw SignalError(source.file + ": has no row below its header");
    }
    std::vector<double> all;
    for (std::size_t row = 0; row < table.rows.size(); ++row) {
        const auto number = table.number(row, *column);
        if (!number) {
            throw SignalError(fmt::format("{}:{}: {}", source.file, table.lines[row],
                                          table.no_number_text(row, *column)));
        }
        all.push_back(*number);
    }
    return all;
}

}  // namespace

Value list_of(const FileColumn& source, std::string_view key, const Position& position,
              std::size_t most) {
    const bool uff = std::ranges::count(kUffEndings, lower_extension(source.file)) > 0;
    if (uff && key.find("response_") == std::string_view::npos) {
        throw SignalError(fmt::format(
            "{}: of universal files only frequency responses are read, but {} takes other values",
            source.file, key));
    }
    const bool of_bearing = std::ranges::any_of(kHousingBearings, [&](const auto& bearing) {
        return key.find(bearing.gain_name) != key.npos || key.find(bearing.phase_name) != key.npos;
    });
    const std::vector<double> numbers =
        uff ? uff_response_column(source.file, source.column,
                                  of_bearing ? ResponseTo::force : ResponseTo::acceleration)
            : table_column(source);
    Value list;
    list.kind = Value::Kind::array;
    list.position = position;
    const std::size_t rows = numbers.size();
    const std::size_t every = rows > most ? (rows + most - 1) / most : 1;
    for (std::size_t row = 0; row < rows; row += every) {
        Value element;
        element.kind = Value::Kind::number;
        element.number = numbers[row];
        element.position = position;
        list.elements.push_back(std::move(element));
    }
    return list;
}

}  // namespace gearpod::mc
