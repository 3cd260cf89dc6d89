#include "gears/mesh_geometry.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

namespace gearpod::gears {

using std::numbers::pi;

namespace {

// Signed distances along the line of action from the point where it touches gear 1's base circle,
// in metres.
struct LineOfAction {
    double start;  // contact begins: gear 2's tip circle
    double pitch;
    double end;  // contact ends: gear 1's tip circle
};

// From the tangent point on the base circle to a point of the flank at the given radius.
double roll_length(const Gear& gear, double radius) {
    const double base = gear.base_radius();
    return std::sqrt(radius * radius - base * base);
}

LineOfAction line_of_action(const Gear& gear_1, const Gear& gear_2) {
    const double slope = std::tan(gear_1.pressure_angle_rad);
    const double pitch_1 = gear_1.base_radius() * slope;
    const double pitch_2 = gear_2.base_radius() * slope;
    const double tip_2 = roll_length(gear_2, gear_2.tip_radius());
    const double end = roll_length(gear_1, gear_1.tip_radius());
    // An internal gear's tangent point lies behind gear 1's, an external one's ahead of the pitch
    // point.
    const double start =
        gear_2.internal ? pitch_1 + (tip_2 - pitch_2) : pitch_1 - (tip_2 - pitch_2);
    return {start, pitch_1, end};
}

std::vector<std::string> pair_problems(const Gear& gear_1, const Gear& gear_2) {
    std::vector<std::string> problems;
    if (gear_1.internal)
        problems.emplace_back("gear 1 of a mesh is internal (the internal gear is gear 2)");
    if (gear_1.module_m != gear_2.module_m ||
        gear_1.pressure_angle_rad != gear_2.pressure_angle_rad)
        problems.push_back(
            fmt::format("meshing gears differ in module ({} and {} m) or pressure angle ({} and {} "
                        "rad): use one",
                        gear_1.module_m, gear_2.module_m, gear_1.pressure_angle_rad,
                        gear_2.pressure_angle_rad));
    if (gear_2.internal && gear_2.teeth <= gear_1.teeth)
        problems.push_back(fmt::format("an internal gear of {} teeth cannot hold one of {}",
                                       gear_2.teeth, gear_1.teeth));
    return problems;
}

std::vector<std::string> contact_problems(const Gear& gear_1, const Gear& gear_2) {
    const LineOfAction line = line_of_action(gear_1, gear_2);
    const double end_on_2 =
        gear_2.base_radius() * std::tan(gear_2.pressure_angle_rad) - (line.end - line.pitch);
    std::vector<std::string> problems;
    const auto interference = [&](const Gear& low, const Gear& high) {
        problems.push_back(fmt::format(
            "the tips of {} teeth reach below the base circle of {} teeth, where there is no "
            "involute (use more teeth, a larger pressure angle or a smaller addendum)",
            high.teeth, low.teeth));
    };
    if (line.start < 0)
        interference(gear_1, gear_2);
    if (!gear_2.internal && end_on_2 < 0)
        interference(gear_2, gear_1);
    const double base_pitch = pi * gear_1.module_m * std::cos(gear_1.pressure_angle_rad);
    const double contact_ratio = (line.end - line.start) / base_pitch;
    if (problems.empty() && contact_ratio < 1)
        problems.push_back(
            fmt::format("the contact ratio of {} against {} teeth is {:.3f}: at times no "
                        "pair touches (use a larger addendum)",
                        gear_1.teeth, gear_2.teeth, contact_ratio));
    return problems;
}

}  // namespace

std::vector<std::string> mesh_problems(const Gear& gear_1, const Gear& gear_2) {
    std::vector<std::string> problems = gear_problems(gear_1);
    for (auto& problem : gear_problems(gear_2))
        problems.push_back(std::move(problem));
    for (auto& problem : pair_problems(gear_1, gear_2))
        problems.push_back(std::move(problem));
    return problems.empty() ? contact_problems(gear_1, gear_2) : problems;
}

MeshGeometry::MeshGeometry(const Gear& gear_1, const Gear& gear_2)
    : gear_1_(gear_1), gear_2_(gear_2) {
    const auto problems = mesh_problems(gear_1, gear_2);
    if (!problems.empty())
        throw std::invalid_argument(fmt::format("{}", fmt::join(problems, "; ")));
    const LineOfAction line = line_of_action(gear_1, gear_2);
    const double base_pitch = pi * gear_1.module_m * std::cos(gear_1.pressure_angle_rad);
    contact_ratio_ = (line.end - line.start) / base_pitch;
    pitch_position_ = (line.pitch - line.start) / base_pitch;

    start_[0] = line.start / gear_1.base_radius() - gear_1.half_base_angle();
    rate_[0] = 2 * pi / gear_1.teeth;
    const double tip_roll_2 = roll_length(gear_2, gear_2.tip_radius()) / gear_2.base_radius();
    const double turn_2 = 2 * pi / gear_2.teeth;
    start_[1] = gear_2.internal ? tip_roll_2 + gear_2.half_base_angle()
                                : tip_roll_2 - gear_2.half_base_angle();
    rate_[1] = gear_2.internal ? turn_2 : -turn_2;
}

double MeshGeometry::centre_distance() const {
    return internal() ? gear_2_.pitch_radius() - gear_1_.pitch_radius()
                      : gear_2_.pitch_radius() + gear_1_.pitch_radius();
}

double MeshGeometry::double_pair_span() const {
    return (contact_ratio_ - 1) * 2 * pi / gear_1_.teeth;
}

double MeshGeometry::single_pair_span() const {
    return 2 * pi / gear_1_.teeth - double_pair_span();
}

}  // namespace gearpod::gears
