// Window functions of the transmission path, by planet position.
#pragma once

#include <span>
#include <string_view>

namespace gearpod::signals {

// How much of a planet's vibration reaches the sensor with the planet at angle x in [0, 2 pi) from
// the point opposite the sensor: the planet passes the sensor at x = pi.
struct PathWindow {
    std::string_view name;
    double (*weight)(double x_rad);
    std::string_view doc;
};

std::span<const PathWindow> path_windows();

// Throws std::invalid_argument, naming those that exist, if there is none of this name.
const PathWindow& path_window(std::string_view name);

}  // namespace gearpod::signals
