// Window functions of the transmission path, by planet position.
#pragma once

#include <span>
#include <string_view>

namespace gearpod::signals {

// Fraction of a planet's vibration that reaches the sensor, as a function of the planet's angle x
// in [0, 2 pi). x is measured from the point opposite the sensor: the planet passes the sensor at x
// = pi.
struct PathWindow {
    std::string_view name;
    double (*weight)(double x_rad);
    std::string_view doc;
};

std::span<const PathWindow> path_windows();

// Window of the given name. Throws std::invalid_argument, which lists the known names, if there is
// none.
const PathWindow& path_window(std::string_view name);

}  // namespace gearpod::signals
