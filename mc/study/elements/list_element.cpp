#include "mc/study/elements/list_element.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iterator>

#include "machine/no_value.hpp"
#include "mc/files/foreign_file.hpp"
#include "mc/files/input/input_file.hpp"
#include "mc/files/input/spelling.hpp"
#include "mc/files/signal_file.hpp"
#include "mc/files/text/text_table.hpp"
#include "mc/study/sensor_signal.hpp"

namespace gearpod::mc {

ListElement::ListElement(const Value& table, std::string which, std::span<const TableField> fields,
                         std::string example, const RejectElement& reject)
    : table_(table), which_(std::move(which)), example_(std::move(example)), reject_(reject) {
    if (table.kind != Value::Kind::table) {
        spelled_ = false;
        reject_(table.position, fmt::format("{} must be a table, but is {}", which_, table.shown()),
                example_);
    }
    std::vector<std::string_view> names;
    std::ranges::transform(fields, std::back_inserter(names), &TableField::name);
    for (const Entry& entry : table.entries) {
        if (std::ranges::find(names, entry.name) == names.end()) {
            spelled_ = false;
            reject_(entry.position, fmt::format("{}: unknown key {}", which_, entry.name),
                    suggest(entry.name, names));
        }
    }
}

void ListElement::reject(const std::string& what, const std::string& remedy) const {
    reject_(table_.position, fmt::format("{}: {}", which_, what), remedy);
}

const Value* ListElement::find(std::string_view name, bool required) const {
    const Entry* entry = table_.find(name);
    if (entry == nullptr && required && spelled_) {
        reject_(table_.position, fmt::format("{} has no {}", which_, name), example_);
    }
    return entry == nullptr ? nullptr : &entry->value;
}

double ListElement::number(std::string_view name, const Range& range,
                           std::optional<double> otherwise) const {
    const Value* value = find(name, !otherwise);
    if (value == nullptr) {
        return otherwise.value_or(0.0);
    }
    check_number(name, range, *value);
    return value->number;
}

void ListElement::check_number(std::string_view name, const Range& range,
                               const Value& value) const {
    if (value.kind != Value::Kind::number && value.kind != Value::Kind::integer) {
        reject(fmt::format("{} must be a number, but is {}", name, value.shown()), "");
    } else if (std::isfinite(value.number) && !computable(value.number)) {
        reject(fmt::format("{}: {} {}", name, value.number, kNotComputable), "");
    } else if (!std::isfinite(value.number) || !range.contains(value.number)) {
        reject(fmt::format("{} must be {} and finite, but is {}", name, range.text(), value.number),
               "");
    }
}

std::vector<double> ListElement::numbers(std::string_view name, const Range& range) const {
    const Value* value = find(name, false);
    if (value == nullptr) {
        return {};
    }
    Value column;
    if (const auto source = file_column(*value)) {
        try {
            column = list_of(*source, name, value->position);
        } catch (const SignalError& error) {
            reject(fmt::format("{}: {}", name, error.what()), "name a file and one of its columns");
            return {};
        }
        value = &column;
    }
    if (value->kind != Value::Kind::array || value->elements.empty()) {
        reject(fmt::format("{} must be a list of numbers, but is {}", name,
                           value->kind == Value::Kind::array ? "empty" : value->shown()),
               "write numbers in [brackets], or { file = \"F.csv\", column = \"NAME\" }");
        return {};
    }
    std::vector<double> all;
    for (const Value& element : value->elements) {
        check_number(name, range, element);
        all.push_back(element.number);
    }
    return all;
}

int ListElement::integer(std::string_view name, const Range& range) const {
    const Value* value = find(name, true);
    if (value == nullptr) {
        return 0;
    }
    if (value->kind != Value::Kind::integer || !range.contains(value->number)) {
        reject(fmt::format("{} must be an integer {}, but is {}", name, range.text(),
                           value->kind == Value::Kind::integer ? fmt::format("{}", value->integer)
                                                               : value->shown()),
               "");
        return 0;
    }
    return static_cast<int>(value->integer);
}

std::optional<int> ListElement::choice(std::string_view name, std::span<const ChoiceName> choices,
                                       bool required) const {
    const Value* value = find(name, required);
    if (value == nullptr) {
        return std::nullopt;
    }
    std::vector<std::string_view> texts;
    for (const ChoiceName& choice : choices) {
        if (value->kind == Value::Kind::text && value->text == choice.text) {
            return choice.value;
        }
        texts.push_back(choice.text);
    }
    if (value->kind != Value::Kind::text) {
        reject(fmt::format("{} must be a string, but is {}", name, value->shown()),
               fmt::format("use one of {}", fmt::join(texts, ", ")));
    } else {
        reject(fmt::format("{}: unknown value \"{}\"", name, value->text),
               suggest(value->text, texts));
    }
    return std::nullopt;
}

std::optional<std::string> ListElement::text(std::string_view name) const {
    const Value* value = find(name, false);
    if (value == nullptr) {
        return std::nullopt;
    }
    if (value->kind != Value::Kind::text) {
        reject(fmt::format("{} must be a string, but is {}", name, value->shown()), "");
        return std::nullopt;
    }
    return value->text;
}

std::string ListElement::word(std::string_view name) const {
    const Value* value = find(name, true);
    if (value == nullptr) {
        return "";
    }
    const auto plain = [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '-';
    };
    if (value->kind != Value::Kind::text || value->text.empty() ||
        !std::ranges::all_of(value->text, plain)) {
        reject(fmt::format("{} must have lower-case letters, digits and dashes only", name), "");
        return "";
    }
    return value->text;
}

std::optional<Member> ListElement::shaft(std::string_view name) const {
    const std::optional<int> found = choice(name, kShafts, true);
    return found ? std::optional(static_cast<Member>(*found)) : std::nullopt;
}

bool ListElement::first_of(std::string_view first, std::string_view second) const {
    if (has(first) == has(second) && spelled_) {
        reject(has(first) ? fmt::format("has both {} and {}", first, second)
                          : fmt::format("has neither {} nor {}", first, second),
               "give one of them: " + example_);
    }
    return has(first);
}

std::vector<double> uff_response_column(const std::string& path, const std::string& column,
                                        ResponseTo to) {
    // The columns of a response are read one after the other, from the same file.
    thread_local TextTable table;
    thread_local std::filesystem::file_time_type read_time;
    if (const std::string why = why_not_readable(path); !why.empty()) {
        throw SignalError(path + ": " + why);
    }
    const auto time = std::filesystem::last_write_time(path);
    if (table.path != path || read_time != time) {
        table = {};
        table = read_converted_table(path, "responses");
        read_time = time;
    }
    const auto found = table.find(column);
    if (!found) {
        throw SignalError(
            fmt::format("{}: no column {}; its columns are {}", path, column, table.names()));
    }
    // Python states the axes as units, after converting them to these if it can.
    const bool frequency = column.starts_with("frequency"), force = to == ResponseTo::force;
    const std::string& axes = table.columns[*found].unit;
    if (frequency && axes != "frequency in Hz") {
        throw SignalError(
            fmt::format("{}: its abscissa is {}, but must be a frequency in Hz", path, axes));
    }
    if (!frequency &&
        axes != fmt::format("acceleration in m/s^2 over {}",
                            force ? "excitation force in N" : "acceleration in m/s^2")) {
        throw SignalError(fmt::format("{}: its response is {}; {} needs acceleration over {}", path,
                                      axes, force ? "a bearing" : "the housing",
                                      force ? "force in N or kN" : "acceleration"));
    }
    std::vector<double> all;
    for (std::size_t row = 0; row < table.rows.size() && !table.rows[row][*found].empty(); ++row) {
        all.push_back(table.number(row, *found).value_or(kNan));
    }
    return all;
}

namespace {

const std::string* text_at(const Value& table, std::string_view name) {
    const Entry* entry = table.find(name);
    return entry != nullptr && entry->value.kind == Value::Kind::text ? &entry->value.text
                                                                      : nullptr;
}

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

std::optional<FileColumn> file_column(const Value& value) {
    if (value.kind != Value::Kind::table) {
        return std::nullopt;
    }
    const std::string *file = text_at(value, "file"), *column = text_at(value, "column");
    return file != nullptr && column != nullptr ? std::optional(FileColumn{*file, *column})
                                                : std::nullopt;
}

Value list_of(const FileColumn& source, std::string_view key, const Position& position,
              std::size_t most) {
    const bool uff = file_kind(source.file) == FileKind::uff;
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
