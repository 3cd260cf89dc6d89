// Tables of tests/peers/fem-gear-pairs; their contents are described in that folder's README.md.
#pragma once

#include <catch2/catch.hpp>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

namespace finite_elements {

// A line of a table with cells by column name; cells may be empty.
class Row {
  public:
    explicit Row(std::map<std::string, std::string> cells) : cells_(std::move(cells)) {}
    const std::string& text(const std::string& column) const { return cells_.at(column); }
    bool has(const std::string& column) const { return !text(column).empty(); }
    double number(const std::string& column) const { return std::stod(text(column)); }
    int count(const std::string& column) const { return std::stoi(text(column)); }

  private:
    std::map<std::string, std::string> cells_;
};

inline std::vector<std::string> split(const std::string& line) {
    std::vector<std::string> cells;
    std::istringstream text(line + ",");
    for (std::string cell; std::getline(text, cell, ',');)
        cells.push_back(cell);
    return cells;
}

inline std::vector<Row> table(const std::string& name) {
    std::ifstream file(GEARPOD_SOURCE_DIR "/tests/peers/fem-gear-pairs/" + name);
    std::string line;
    REQUIRE(std::getline(file, line));
    const std::vector<std::string> columns = split(line);
    std::vector<Row> rows;
    while (std::getline(file, line)) {
        const std::vector<std::string> cells = split(line);
        REQUIRE(cells.size() == columns.size());
        std::map<std::string, std::string> row;
        for (std::size_t i = 0; i < columns.size(); ++i)
            row[columns[i]] = cells[i];
        rows.emplace_back(std::move(row));
    }
    REQUIRE(!rows.empty());
    return rows;
}

}  // namespace finite_elements
