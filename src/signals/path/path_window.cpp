#include "signals/path/path_window.hpp"

#include <fmt/format.h>

#include <array>
#include <stdexcept>
#include <string>

#include "signals/path/windows/hamming.hpp"
#include "signals/path/windows/hann.hpp"
#include "signals/path/windows/rectangular.hpp"

namespace gearpod::signals {
namespace {

constexpr std::array kWindows{
    PathWindow{"hamming", &hamming, "0.54 - 0.46 cos x, Liang (2016), Eq. 4.3.1"},
    PathWindow{"hann", &hann, "0.5 - 0.5 cos x"},
    PathWindow{"rectangular", &rectangular, "1: no loss with distance"},
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
