#include "stiffness/faults/crack_surface.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace gearpod::stiffness {

using std::numbers::pi;

bool CrackSurface::uniform() const {
    return depth_m == end_depth_m && height_m == end_height_m && angle_rad == end_angle_rad;
}

// q = q1 + (q2 - q1) t. q^2 is linear in z, so z / L_c = (q^2 - q1^2) / (q2^2 - q1^2).
double CrackSurface::place(double t) const {
    return length_m * t * (2 * depth_m + (end_depth_m - depth_m) * t) / (depth_m + end_depth_m);
}

double CrackSurface::stretching(double t) const {
    return length_m * 2 * (depth_m + (end_depth_m - depth_m) * t) / (depth_m + end_depth_m);
}

double CrackSurface::height(double z) const {
    const double x = z / face_width_m, rise = end_height_m - height_m;
    double l = height_m + rise * x * x;
    if (height_wave != 0)
        l += rise / height_wave * std::sin(height_waves * pi * x);
    return std::max(0.0, l);
}

Crack CrackSurface::crack(double t) const {
    const double z = place(t);
    return {depth_m + (end_depth_m - depth_m) * t,
            angle_rad + (end_angle_rad - angle_rad) * z / face_width_m, height(z)};
}

CrackSurface CrackGrowth::at(double stage, double face_width_m) const {
    const double place = std::clamp(stage, 0.0, static_cast<double>(stages()));
    const int to = std::max(1, static_cast<int>(std::ceil(place)));  // stage, entry to - 1
    const double share = place - (to - 1);
    const auto between = [&](const std::vector<double>& list, bool from_nothing) {
        const double target = list[to - 1];
        const double source = to > 1 ? list[to - 2] : from_nothing ? 0 : target;
        return share == 1 ? target : source + share * (target - source);
    };
    return {between(depth_m, true),
            between(end_depth_m, true),
            between(length_m, false),
            between(height_m, false),
            between(end_height_m, false),
            angle_rad,
            end_angle_rad,
            height_wave,
            height_waves,
            face_width_m};
}

std::vector<std::string> growth_problems(const CrackGrowth& growth, double face_width_m) {
    constexpr double kRounding = 1e-12;  // for lengths that were given in other units
    std::vector<std::string> problems;
    const std::size_t stages = growth.depth_m.size();
    const auto check = [&](const char* what, const std::vector<double>& list, double most) {
        if (list.size() != stages)
            problems.push_back(
                fmt::format("the crack's growth has {} depths and {} values of its {}", stages,
                            list.size(), what));
        for (const double value : list)
            if (!(value >= 0 && value <= most * (1 + kRounding)))
                problems.push_back(fmt::format(
                    "a stage of the crack's growth has the {} {:.4g} mm (must lie between 0 and "
                    "{:.4g})",
                    what, value * 1e3, most * 1e3));
    };
    constexpr double kAny = 1e3;
    if (stages == 0)
        problems.emplace_back("the crack's growth has no stage");
    check("depth", growth.depth_m, kAny);
    check("end depth", growth.end_depth_m, kAny);
    check("length", growth.length_m, face_width_m);
    check("height", growth.height_m, kAny);
    check("end height", growth.end_height_m, kAny);
    for (const double angle : {growth.angle_rad, growth.end_angle_rad})
        if (!(angle > 0 && angle <= pi / 2))
            problems.push_back(
                fmt::format("the crack's angle to the tooth's centre line is {:.4g} "
                            "degrees (must lie between 0 and 90)",
                            angle * 180 / pi));
    if (!(growth.height_wave >= 0 && growth.height_waves >= 0))
        problems.emplace_back("the wave of the crack's height is negative");
    if (growth.slices < 1)
        problems.emplace_back("the crack has no slice");
    return problems;
}

}  // namespace gearpod::stiffness
