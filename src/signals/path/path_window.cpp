#include "signals/path/path_window.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <stdexcept>
#include <string>

namespace gearpod::signals {
namespace {

constexpr std::array kWindows{
    // 8 % of the signal of the farthest planet remains. Liang (2016), Eq. 4.3.1.
    PathWindow{"hamming", [](double x_rad) { return 0.54 - 0.46 * std::cos(x_rad); },
               "0.54 - 0.46 cos x, Liang (2016), Eq. 4.3.1"},
    // Nothing of the signal of the farthest planet remains. Liang (2016), section 4.3, case 3 of
    // Fig. 4.10.
    PathWindow{"hann", [](double x_rad) { return 0.5 - 0.5 * std::cos(x_rad); }, "0.5 - 0.5 cos x"},
    // Every planet counts the same at every angle, as for a sensor that turns with the carrier.
    PathWindow{"rectangular", [](double /*x_rad*/) { return 1.0; }, "1: no loss with distance"},
};

}  // namespace

std::span<const PathWindow> path_windows() {
    return kWindows;
}

const PathWindow& path_window(std::string_view name) {
    std::string known;
    for (const PathWindow& window : kWindows) {
        if (window.name == name) {
            return window;
        }
        known += fmt::format("{}{}", known.empty() ? "" : ", ", window.name);
    }
    throw std::invalid_argument(fmt::format("no path window \"{}\"; there are {}", name, known));
}

}  // namespace gearpod::signals
