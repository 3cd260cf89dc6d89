// Alignment of text in columns.
#pragma once

#include <string>
#include <vector>

namespace gearpod::mc {

// Aligns cells in columns; all are right-aligned except the last column.
std::string aligned_columns(const std::vector<std::vector<std::string>>& lines);

}  // namespace gearpod::mc
