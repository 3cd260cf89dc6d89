// Frequency responses of universal files (dataset 58) as columns of numbers.
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "mc/files/input/document.hpp"

namespace gearpod::mc {

// Denominator of a frequency response whose numerator is an acceleration.
enum class ResponseTo { acceleration, force };

// Column "frequency" (Hz), "gain" or "phase" (degrees) of such a frequency response in a file; a
// gain per force in (m/s^2)/N. Of several, number n in the order of the file has the columns
// "frequency n" and so on. Throws SignalError (mc/files/signal_file.hpp) for another column and for
// a response that is no such ratio.
std::vector<double> uff_response_column(const std::string& path, const std::string& column,
                                        ResponseTo to = ResponseTo::acceleration);

// Lists of numbers read from a column of a text table, { file = "F.csv", column = "NAME" }, or of a
// frequency response in a universal file.

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
