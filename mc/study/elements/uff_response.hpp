// Frequency responses of universal files (dataset 58) as columns of numbers.
#pragma once

#include <string>
#include <vector>

namespace gearpod::mc {

// Denominator of a frequency response whose numerator is an acceleration.
enum class ResponseTo { acceleration, force };

// Column "frequency" (Hz), "gain" or "phase" (degrees) of such a frequency response in a file; a
// gain per force in (m/s^2)/N. Of several, number n in the order of the file has the columns
// "frequency n" and so on. Throws SignalError (mc/files/signal_file.hpp) for another column and for
// a response that is no such ratio.
std::vector<double> uff_response_column(const std::string& path, const std::string& column,
                                        ResponseTo to = ResponseTo::acceleration);

}  // namespace gearpod::mc
