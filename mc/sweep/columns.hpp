// Columns of text.
#pragma once

#include <string>
#include <vector>

namespace gearpod::mc {

// Lines of cells, all to the right but for the last column.
std::string aligned(const std::vector<std::vector<std::string>>& lines);

}  // namespace gearpod::mc
