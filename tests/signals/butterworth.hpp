// Low-pass of the sensors.
#pragma once

#include "tests/test.hpp"

namespace gearpod::test {

// Response of a Butterworth low-pass of order 4 at a frequency over its cut-off frequency, by its
// poles on the unit circle.
inline std::complex<double> butterworth(double r) {
    std::complex<double> product = 1.0;
    for (const double eighths : {5.0, 7.0, 9.0, 11.0}) {
        product *= std::complex<double>(0.0, r) - std::polar(1.0, eighths * std::numbers::pi / 8.0);
    }
    return 1.0 / product;
}

}  // namespace gearpod::test
