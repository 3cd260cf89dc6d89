#include "mc/files/formats/common_sampling.hpp"

#include <fmt/format.h>

#include <cmath>

#include "mc/files/formats/signal_error.hpp"
#include "mc/files/input/terminal_text.hpp"

namespace gearpod::mc {

void CommonSampling::add(const std::string& path, const std::string& column,
                         std::optional<double> rate_Hz, std::optional<double> start_s) {
    constexpr double kSameRate = 1e-9;
    if (rate_Hz && rate_ && std::abs(*rate_Hz - *rate_) > kSameRate * *rate_) {
        throw SignalError(fmt::format(
            "{}: its columns {} and {} have different time steps, {:g} s and {:g} s", path,
            printable(rate_column_), printable(column), 1.0 / *rate_, 1.0 / *rate_Hz));
    }
    if (rate_Hz && !rate_) {
        rate_ = rate_Hz;
        rate_column_ = column;
    }
    if (start_s && start_s_ && rate_ && std::abs(*start_s - *start_s_) * *rate_ > 0.5) {
        throw SignalError(fmt::format(
            "{}: its columns {} and {} start at different times, {:g} s apart", path,
            printable(start_column_), printable(column), std::abs(*start_s - *start_s_)));
    }
    if (start_s && !start_s_) {
        start_s_ = start_s;
        start_column_ = column;
    }
}

}  // namespace gearpod::mc
