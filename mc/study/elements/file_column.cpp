#include "mc/study/elements/file_column.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <optional>
#include <vector>

#include "mc/files/formats/file_content.hpp"
#include "mc/files/formats/uff_file.hpp"
#include "mc/files/input/input_file.hpp"
#include "mc/files/signal_file.hpp"
#include "mc/files/signal_units.hpp"
#include "mc/files/text/text_table.hpp"
#include "mc/study/housing.hpp"

namespace gearpod::mc {
namespace {

constexpr int kResponseFunction = 4, kTransmissibility = 5;  // function types
constexpr int kAnyData = 1, kAcceleration = 12, kForce = 13,
              kFrequency = 18;  // data types; 0: unknown
constexpr const char* kFrequencyColumn = "frequency";
constexpr const char* kGainColumn = "gain";
constexpr const char* kPhaseColumn = "phase";

bool is_of_type(const UffAxis& axis, int type) {
    return axis.type == type || axis.type <= kAnyData;
}

std::string axis_text(const UffAxis& axis) {
    return axis.unit.empty() ? uff_quantity(axis.type)
                             : fmt::format("{} in {}", uff_quantity(axis.type), axis.unit);
}

// Factor that converts a force to N; empty for an unknown unit.
std::optional<double> force_factor(const std::string& unit) {
    const std::string plain = plain_unit(unit);
    return plain == "N" ? std::optional(1.0) : plain == "kN" ? std::optional(1e3) : std::nullopt;
}

// Factor of the gain by the units above and below the fraction line.
double unit_ratio(const std::string& path, const UffFunction& function, ResponseTo to) {
    const UffAxis &above = function.ordinate, &below = function.denominator;
    const auto refuse = [&] {
        throw SignalError(fmt::format(
            "{}: its response is {} over {}; {} needs acceleration over {}", path, axis_text(above),
            axis_text(below), to == ResponseTo::force ? "a bearing" : "the housing",
            to == ResponseTo::force ? "force in N or kN" : "acceleration"));
    };
    if (!is_of_type(above, kAcceleration) ||
        !is_of_type(below, to == ResponseTo::force ? kForce : kAcceleration)) {
        refuse();
    }
    if (above.unit.empty() && below.unit.empty()) {
        return 1.0;
    }
    const auto a = unit_factor(Quantity::acceleration, above.unit),
               b = to == ResponseTo::force ? force_factor(below.unit)
                                           : unit_factor(Quantity::acceleration, below.unit);
    if (!a || !b || above.unit.empty() || below.unit.empty()) {
        refuse();
    }
    return *a / *b;
}

std::vector<double> frequencies_of(const std::string& path, const UffFunction& function) {
    std::string unit = function.abscissa.unit;
    std::ranges::transform(unit, unit.begin(), [](unsigned char c) { return std::tolower(c); });
    if (!is_of_type(function.abscissa, kFrequency) || (!unit.empty() && unit != "hz")) {
        throw SignalError(fmt::format("{}: its abscissa is {}, but must be a frequency in Hz", path,
                                      axis_text(function.abscissa)));
    }
    if (!function.even) {
        return function.abscissae;
    }
    std::vector<double> all;
    for (std::size_t i = 0; i < function.values.size(); ++i) {
        all.push_back(function.first + function.step * static_cast<double>(i));
    }
    return all;
}

}  // namespace

std::vector<double> uff_response_column(const std::string& path, const std::string& column,
                                        ResponseTo to) {
    if (const std::string why = why_not_readable(path); !why.empty()) {
        throw SignalError(path + ": " + why);
    }
    std::vector<UffFunction> responses = read_uff(path);
    std::erase_if(responses, [](const UffFunction& function) {
        return function.function_type != kResponseFunction &&
               function.function_type != kTransmissibility;
    });
    if (responses.empty()) {
        throw SignalError(path + ": contains no frequency response");
    }
    for (std::size_t i = 0; i < responses.size(); ++i) {
        const UffFunction& response = responses[i];
        const std::string number = responses.size() == 1 ? "" : fmt::format(" {}", i + 1);
        const bool gain = column == kGainColumn + number, phase = column == kPhaseColumn + number;
        if (!gain && !phase && column != kFrequencyColumn + number) {
            continue;
        }
        if (!response.unreadable.empty()) {
            throw SignalError(fmt::format("{}: {}", path, response.unreadable));
        }
        if (!gain && !phase) {
            return frequencies_of(path, response);
        }
        const double factor = unit_ratio(path, response, to);
        std::vector<double> all;
        for (std::size_t k = 0; k < response.values.size(); ++k) {
            const std::complex<double> value(response.values[k],
                                             response.complex ? response.imaginary[k] : 0.0);
            all.push_back(gain ? factor * std::abs(value)
                               : std::arg(value) * 180.0 / std::numbers::pi);
        }
        return all;
    }
    throw SignalError(fmt::format("{}: no column {}; {}", path, column,
                                  responses.size() == 1
                                      ? "its columns are frequency, gain, phase"
                                      : fmt::format("its columns are frequency n, gain n, phase n "
                                                    "with n = 1 to {}",
                                                    responses.size())));
}

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
