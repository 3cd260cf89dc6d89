#include "mc/sweep/columns.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace gearpod::mc {

std::string aligned_columns(const std::vector<std::vector<std::string>>& lines) {
    std::vector<std::size_t> width;
    for (const auto& line : lines) {
        width.resize(std::max(width.size(), line.size()));
        for (std::size_t c = 0; c < line.size(); ++c) {
            width[c] = std::max(width[c], line[c].size());
        }
    }
    std::string text;
    for (const auto& line : lines) {
        std::string row;
        for (std::size_t c = 0; c < line.size(); ++c) {
            row += c + 1 == line.size()
                       ? "  " + line[c]
                       : fmt::format("{}{:>{}}", c == 0 ? "" : "  ", line[c], width[c]);
        }
        text += row.substr(0, row.find_last_not_of(' ') + 1) + "\n";
    }
    return text;
}

}  // namespace gearpod::mc
