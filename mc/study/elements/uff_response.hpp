// Frequency responses of universal files (dataset 58) as columns of numbers.
#pragma once

#include <string>
#include <vector>

namespace gearpod::mc {

// Column "frequency" (Hz), "gain" or "phase" (degrees) of the frequency response of acceleration
// over acceleration in a file. Of several, number n in the order of the file has the columns
// "frequency n" and so on. Throws SignalError (mc/files/signal_file.hpp) for another column and for
// a response that is no such ratio.
std::vector<double> uff_response_column(const std::string& path, const std::string& column);

}  // namespace gearpod::mc
