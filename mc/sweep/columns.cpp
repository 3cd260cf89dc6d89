#include "mc/sweep/columns.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "analysis/report/text_lines.hpp"

namespace gearpod::mc {
namespace {

constexpr std::size_t kGap = 2;  // spaces between columns

std::string some_columns(const std::vector<std::vector<std::string>>& lines,
                         const std::vector<std::size_t>& width,
                         const std::vector<std::size_t>& columns) {
    std::string text;
    for (const auto& line : lines) {
        std::string row;
        for (const std::size_t c : columns) {
            const std::string cell = c < line.size() ? line[c] : "";
            row += c + 1 == width.size()
                       ? "  " + cell
                       : fmt::format("{}{:>{}}", row.empty() ? "" : "  ", cell, width[c]);
        }
        text += row.substr(0, row.find_last_not_of(' ') + 1) + "\n";
    }
    return text;
}

}  // namespace

std::string aligned_columns(const std::vector<std::vector<std::string>>& lines,
                            std::size_t repeated) {
    std::vector<std::size_t> width;
    for (const auto& line : lines) {
        width.resize(std::max(width.size(), line.size()));
        for (std::size_t c = 0; c < line.size(); ++c) {
            width[c] = std::max(width[c], line[c].size());
        }
    }
    std::vector<std::size_t> first(std::min(repeated, width.size()));
    std::iota(first.begin(), first.end(), 0);
    std::size_t begin = 0;  // of the first column that is not repeated
    for (const std::size_t c : first) {
        begin += width[c] + kGap;
    }
    std::string text;
    std::vector<std::size_t> columns = first;
    std::size_t place = begin;
    for (std::size_t c = first.size(); c < width.size(); ++c) {
        if (place + width[c] > analysis::text_width() && columns.size() > first.size()) {
            text += some_columns(lines, width, columns) + "\n";
            columns = first;
            place = begin;
        }
        columns.push_back(c);
        place += width[c] + kGap;
    }
    return text + some_columns(lines, width, columns);
}

}  // namespace gearpod::mc
