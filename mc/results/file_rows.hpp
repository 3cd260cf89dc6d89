// Reads the rows of a results file in blocks.
#pragma once

#include <string>

#include "mc/results/row_source.hpp"

namespace gearpod::mc {

class FileRows final : public RowSource {
  public:
    // `frame` must come from read_frame(path). Throws std::runtime_error as read_results() does.
    FileRows(const std::string& path, const Results& frame);
    std::size_t rows() const override { return rows_; }
    void visit(const std::function<void(const RowBlock&)>& use) const override;

  private:
    std::string path_;
    const Results& frame_;
    std::size_t rows_ = 0;
};

}  // namespace gearpod::mc
