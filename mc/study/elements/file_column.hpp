// Lists of numbers read from a column of a text table, { file = "F.csv", column = "NAME" }, or of a
// frequency response in a universal file (uff_response.hpp).
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <string_view>

#include "mc/input/document.hpp"

namespace gearpod::mc {

struct FileColumn {
    std::string file, column;
};

// File and column named by a table; empty for any other value.
std::optional<FileColumn> file_column(const Value& value);

// The column's numbers as a list at `position`. Of more than `most` rows every n-th one is used.
// Universal files are read only for keys of a frequency response ("response_"). Throws SignalError
// (mc/files/signal_file.hpp) with the problem.
Value list_of(const FileColumn& source, std::string_view key, const Position& position,
              std::size_t most = std::numeric_limits<std::size_t>::max());

}  // namespace gearpod::mc
