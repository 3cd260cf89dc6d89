// Lists of numbers that stand in a file: { file = "F.csv", column = "NAME" }.
#pragma once

#include <limits>
#include <optional>
#include <string>

#include "mc/input/document.hpp"

namespace gearpod::mc {

struct FileColumn {
    std::string file, column;
};

// Empty unless the value is a table that names both.
std::optional<FileColumn> file_column(const Value& value);

// The column's numbers as a list at `position`; of more than `most` rows evenly chosen ones. Throws
// SignalError (mc/files/signal_file.hpp) with what is wrong.
Value list_of(const FileColumn& wanted, const Position& position,
              std::size_t most = std::numeric_limits<std::size_t>::max());

}  // namespace gearpod::mc
