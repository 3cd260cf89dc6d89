// Alignment of text in columns.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace gearpod::mc {

// Aligns cells in columns; all are right-aligned except the last column. A table wider than the
// terminal is split into several, each of which begins with the first `repeated` columns.
std::string aligned_columns(const std::vector<std::vector<std::string>>& lines,
                            std::size_t repeated);

}  // namespace gearpod::mc
