// Tables of tests/peers/fem-gear-pairs; their contents are described in that folder's README.md.
#pragma once

#include "tests/reference_tables.hpp"
#include "tests/test.hpp"

namespace finite_elements {

// A line of a table.
class Row {
  public:
    Row(std::shared_ptr<const gearpod::test::ReferenceTable> table, std::size_t row)
        : table_(std::move(table)), row_(row) {}
    const std::string& text(const std::string& column) const {
        return table_->texts.at(column).at(row_);
    }
    double number(const std::string& column) const { return table_->numbers.at(column).at(row_); }
    int count(const std::string& column) const {
        const double number = this->number(column);
        REQUIRE(number == std::round(number));
        return static_cast<int>(number);
    }

  private:
    std::shared_ptr<const gearpod::test::ReferenceTable> table_;
    std::size_t row_;
};

inline std::vector<Row> table(const std::string& name) {
    const auto all = std::make_shared<const gearpod::test::ReferenceTable>(
        gearpod::test::reference_table("peers/fem-gear-pairs/" + name + ".h5"));
    std::vector<Row> rows;
    for (std::size_t row = 0; row < all->numbers.begin()->second.size(); ++row)
        rows.emplace_back(all, row);
    REQUIRE(!rows.empty());
    return rows;
}

}  // namespace finite_elements
