// Names and units in the header of a text table.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace gearpod::mc {

struct TableColumn {
    std::string name;         // without the unit; may be empty
    std::string unit;         // as written; may be empty
    std::string header = {};  // the whole field
};

// Splits a header into name and unit. Text in square brackets is the unit, whatever it is; text in
// parentheses at the end, or after " / ", only if it is a unit (is_unit). Otherwise it belongs to
// the name, like the place in "Accelerometer (rear)".
TableColumn column_of(std::string_view header);

// Index of the column with this name; else of that with this header; else of the only one whose
// name is this and a remark in parentheses. Throws SignalError (signal_file.hpp) if two columns
// have the name.
std::optional<std::size_t> find_column(const std::vector<TableColumn>& columns,
                                       std::string_view name, const std::string& path);

// List of the names, "a, b, c"; at most twenty.
std::string column_names(const std::vector<TableColumn>& columns);

}  // namespace gearpod::mc
