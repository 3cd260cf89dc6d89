// Sampling that the columns of a recording have in common, in files that state it per column.
#pragma once

#include <optional>
#include <string>

namespace gearpod::mc {

class CommonSampling {
  public:
    // Adds a column that is read. Absent: not stated. Throws SignalError (signal_error.hpp) if the
    // column has another rate, or starts more than half a step apart from an earlier one: its
    // samples could not be paired with theirs.
    void add(const std::string& path, const std::string& column, std::optional<double> rate_Hz,
             std::optional<double> start_s);

    // Sampling rate of the columns added so far, if stated.
    std::optional<double> rate_Hz() const { return rate_; }

  private:
    std::optional<double> rate_, start_s_;
    std::string rate_column_, start_column_;
};

}  // namespace gearpod::mc
