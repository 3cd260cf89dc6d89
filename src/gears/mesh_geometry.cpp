#include "gears/mesh_geometry.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <tuple>
#include <utility>

namespace gearpod::gears {
namespace {

double signed_teeth(const Gear& gear) {
    return gear.internal ? -gear.teeth : gear.teeth;
}

// True if the distance equals that of the reference circles up to rounding.
bool is_reference(const Gear& gear_1, const Gear& gear_2, double centre_distance_m) {
    const double reference = reference_centre_distance(gear_1, gear_2);
    return std::abs(centre_distance_m - reference) <= 1e-9 * reference;
}

Gear shifted(const Gear& gear, double shift) {
    Gear result = gear;
    result.profile_shift = shift;
    return result;
}

// Distance at which a planet of any shift fits between a sun and a ring with these shifts. The
// planet shift required by the sun mesh increases with the distance, that required by the ring mesh
// decreases.
double distance_between(const Gear& sun, const Gear& planet, const Gear& ring) {
    const auto excess = [&](double distance) {
        return tight_shift_sum(sun, planet, distance) - sun.profile_shift -
               (tight_shift_sum(planet, ring, distance) - ring.profile_shift);
    };
    const double reference = reference_centre_distance(sun, planet);
    if (is_reference(planet, ring, reference) && excess(reference) == 0) {
        return reference;
    }
    double low = std::max(base_centre_distance(sun, planet), base_centre_distance(planet, ring));
    double high = 2 * low;
    constexpr int kBisections = 100;  // to machine precision
    for (int i = 0; i < kBisections; ++i) {
        const double middle = 0.5 * (low + high);
        (excess(middle) < 0 ? low : high) = middle;
    }
    return 0.5 * (low + high);
}

// True if the shift of sun or planet follows from the ring's, which is specified without the
// distance.
bool follows_ring(const Gear* ring, const SpecifiedShifts& specified) {
    return ring != nullptr && specified.ring && !specified.centre_distance_m &&
           !(specified.first && specified.second);
}

// Distance determined by the specified shifts: those of sun and planet, of planet and ring, or of
// sun and ring.
double specified_distance(const Gear& gear_1, const Gear& gear_2, const Gear* ring,
                          const SpecifiedShifts& specified) {
    const Gear first = shifted(gear_1, specified.first.value_or(0));
    if (!follows_ring(ring, specified)) {
        return tight_centre_distance(first, shifted(gear_2, specified.second.value_or(0)));
    }
    const Gear outer = shifted(*ring, *specified.ring);
    return specified.second ? tight_centre_distance(shifted(gear_2, *specified.second), outer)
                            : distance_between(first, gear_2, outer);
}

// Shifts of the first two gears at a distance. Their sum is the one that fits, unless both are
// specified.
std::pair<double, double> shifts_at(const Gear& gear_1, const Gear& gear_2, const Gear* ring,
                                    const SpecifiedShifts& specified, double distance) {
    const double sum = tight_shift_sum(gear_1, gear_2, distance);
    if (specified.first) {
        return {*specified.first, specified.second.value_or(sum - *specified.first)};
    }
    if (specified.second) {
        return {sum - *specified.second, *specified.second};
    }
    if (ring != nullptr && specified.ring) {
        const double second = tight_shift_sum(gear_2, *ring, distance) - *specified.ring;
        return {sum - second, second};
    }
    return {0.5 * sum, 0.5 * sum};
}

// Signed distances along the line of action from its tangent point on gear 1's base circle, in
// metres.
struct LineOfAction {
    double start;  // start of contact: gear 2's tip circle
    double pitch;
    double end;  // end of contact: gear 1's tip circle
};

// Distance from the tangent point on the base circle to the point of the flank at the given radius.
double roll_length(const Gear& gear, double radius) {
    const double base = gear.base_radius();
    return std::sqrt(radius * radius - base * base);
}

double working_angle(const Gear& gear_1, const Gear& gear_2,
                     const std::optional<double>& centre_distance_m) {
    return centre_distance_m ? working_angle_at(gear_1, gear_2, *centre_distance_m)
                             : tight_working_angle(gear_1, gear_2);
}

LineOfAction line_of_action(const Gear& gear_1, const Gear& gear_2, double working_angle) {
    const double slope = std::tan(working_angle);
    const double pitch_1 = gear_1.base_radius() * slope;
    const double pitch_2 = gear_2.base_radius() * slope;
    const double tip_2 = roll_length(gear_2, gear_2.tip_radius());
    const double end = roll_length(gear_1, gear_1.tip_radius());
    // The tangent point of an internal gear lies before that of gear 1, that of an external gear
    // after the pitch point.
    const double start =
        gear_2.internal ? pitch_1 + (tip_2 - pitch_2) : pitch_1 - (tip_2 - pitch_2);
    return {start, pitch_1, end};
}

double working_radius(const Gear& gear, double working_angle) {
    return gear.base_radius() / std::cos(working_angle);
}

// Backlash along the working pitch circles, whose pitches are equal.
double backlash_between(const Gear& gear_1, const Gear& gear_2, double working_angle) {
    const double radius = working_radius(gear_1, working_angle);
    const double pitch = 2 * pi * radius / gear_1.teeth;
    return pitch - gear_1.thickness_at(radius) -
           gear_2.thickness_at(working_radius(gear_2, working_angle));
}

double distance_at(const Gear& gear_1, const Gear& gear_2, double working_angle) {
    return base_centre_distance(gear_1, gear_2) / std::cos(working_angle);
}

// Clearance between the tips of gear `which` and the other gear's root circle.
double clearance_of_tip(const Gear& gear_1, const Gear& gear_2, double distance, int which) {
    if (!gear_2.internal) {
        const Gear& tip = which == 1 ? gear_1 : gear_2;
        const Gear& root = which == 1 ? gear_2 : gear_1;
        return distance - tip.tip_radius() - root.root_radius();
    }
    return which == 1 ? gear_2.root_radius() - distance - gear_1.tip_radius()
                      : gear_2.tip_radius() - distance - gear_1.root_radius();
}

std::vector<std::string> pair_problems(const Gear& gear_1, const Gear& gear_2) {
    std::vector<std::string> problems;
    if (gear_1.internal) {
        problems.emplace_back("gear 1 of a mesh is internal (the internal gear is gear 2)");
    }
    if (gear_1.module_m != gear_2.module_m ||
        gear_1.pressure_angle_rad != gear_2.pressure_angle_rad) {
        problems.push_back(
            fmt::format("meshing gears differ in module ({} and {} m) or pressure angle ({} and {} "
                        "rad): use one",
                        gear_1.module_m, gear_2.module_m, gear_1.pressure_angle_rad,
                        gear_2.pressure_angle_rad));
    }
    if (gear_2.internal && gear_2.teeth <= gear_1.teeth) {
        problems.push_back(fmt::format("an internal gear of {} teeth cannot hold one of {}",
                                       gear_2.teeth, gear_1.teeth));
    }
    return problems;
}

// Checks that the teeth fit between each other at that distance. Overlaps caused by rounded shifts
// are harmless.
void fit_problems(const Gear& gear_1, const Gear& gear_2, double angle,
                  std::vector<std::string>& problems) {
    constexpr double kRounded = 2e-3;  // modules
    const double backlash = backlash_between(gear_1, gear_2, angle);
    const double distance = distance_at(gear_1, gear_2, angle);
    if (backlash < -kRounded * gear_1.module_m) {
        problems.push_back(fmt::format(
            "teeth of {} and {} are {:.4f} mm thicker than the pitch at a centre distance of "
            "{:.6g} mm leaves room for (their shifts sum up to {:.4f}, {:.4f} fits)",
            gear_1.teeth, gear_2.teeth, -1e3 * backlash, 1e3 * distance,
            gear_1.profile_shift + gear_2.profile_shift,
            tight_shift_sum(gear_1, gear_2, distance)));
    }
    for (const int which : {1, 2}) {
        const double clearance = clearance_of_tip(gear_1, gear_2, distance, which);
        const Gear& tip = which == 1 ? gear_1 : gear_2;
        if (clearance < -kRounded * gear_1.module_m) {
            problems.push_back(fmt::format(
                "the tips of {} teeth run {:.4f} mm into the root circle of {} teeth (let the tip "
                "diameter be {:.6g} mm)",
                tip.teeth, -1e3 * clearance, (which == 1 ? gear_2 : gear_1).teeth,
                2e3 * (tip.tip_radius() + (tip.internal ? -clearance : clearance))));
        }
    }
}

// Checks tip interference of an internal gear pair: the tips pass each other where the tip circles
// cross, outside the line of action, and the mate's tip must be ahead. Colbourne (1987), chapter 8;
// KHK's theta_1.
void crossing_problems(const Gear& gear_1, const Gear& gear_2, double angle,
                       std::vector<std::string>& problems) {
    const double a = distance_at(gear_1, gear_2, angle);
    const double r_1 = gear_1.tip_radius(), r_2 = gear_2.tip_radius();
    if (!gear_2.internal || r_2 >= a + r_1) {
        return;
    }
    const auto inv_at = [](const Gear& gear, double radius) {
        return involute(std::acos(std::min(1.0, gear.base_radius() / radius)));
    };
    const auto angle_of = [](double cosine) { return std::acos(std::clamp(cosine, -1.0, 1.0)); };
    const double turn_1 = angle_of((r_2 * r_2 - r_1 * r_1 - a * a) / (2 * a * r_1)) +
                          inv_at(gear_1, r_1) - involute(angle);
    const double turn_2 = angle_of((a * a + r_2 * r_2 - r_1 * r_1) / (2 * a * r_2));
    const double room =
        turn_1 * gear_1.teeth / gear_2.teeth + involute(angle) - inv_at(gear_2, r_2) - turn_2;
    if (room < 0) {
        problems.push_back(fmt::format(
            "the tips of {} teeth overlap those of the {} internal teeth by {:.3f} degrees where "
            "they pass (a larger difference of tooth numbers, or smaller addenda)",
            gear_1.teeth, gear_2.teeth, -room * 180 / pi));
    }
}

void contact_problems(const Gear& gear_1, const Gear& gear_2, double angle,
                      std::vector<std::string>& problems) {
    const LineOfAction line = line_of_action(gear_1, gear_2, angle);
    const double end_on_2 = gear_2.base_radius() * std::tan(angle) - (line.end - line.pitch);
    const auto interference = [&](const Gear& low, const Gear& high, double below) {
        problems.push_back(fmt::format(
            "the tips of {} teeth reach below the base circle of {} teeth, by {:.3g} mm on the "
            "line of action, where there is no involute (use more teeth, a larger pressure angle, "
            "a smaller addendum or tip circles given)",
            high.teeth, low.teeth, 1e3 * below));
    };
    if (line.start < 0) {
        interference(gear_1, gear_2, -line.start);
    }
    if (!gear_2.internal && end_on_2 < 0) {
        interference(gear_2, gear_1, -end_on_2);
    }
    const double base_pitch = pi * gear_1.module_m * std::cos(gear_1.pressure_angle_rad);
    const double contact_ratio = (line.end - line.start) / base_pitch;
    if (problems.empty() && contact_ratio < 1) {
        problems.push_back(
            fmt::format("the contact ratio of {} against {} teeth is {:.3f}: at times no "
                        "pair touches (use a larger addendum)",
                        gear_1.teeth, gear_2.teeth, contact_ratio));
    }
}

}  // namespace

double reference_centre_distance(const Gear& gear_1, const Gear& gear_2) {
    return gear_2.internal ? gear_2.pitch_radius() - gear_1.pitch_radius()
                           : gear_2.pitch_radius() + gear_1.pitch_radius();
}

double base_centre_distance(const Gear& gear_1, const Gear& gear_2) {
    return gear_2.internal ? gear_2.base_radius() - gear_1.base_radius()
                           : gear_2.base_radius() + gear_1.base_radius();
}

double working_angle_at(const Gear& gear_1, const Gear& gear_2, double centre_distance_m) {
    if (is_reference(gear_1, gear_2, centre_distance_m)) {
        return gear_1.pressure_angle_rad;
    }
    const double cosine = base_centre_distance(gear_1, gear_2) / centre_distance_m;
    return cosine < 1 ? std::acos(cosine) : 0;
}

double tight_working_angle(const Gear& gear_1, const Gear& gear_2) {
    const double sum = gear_1.profile_shift + gear_2.profile_shift;
    if (sum == 0) {
        return gear_1.pressure_angle_rad;
    }
    const double slope = 2 * std::tan(gear_1.pressure_angle_rad);
    const double teeth = signed_teeth(gear_1) + signed_teeth(gear_2);
    return inverse_involute(involute(gear_1.pressure_angle_rad) + slope * sum / teeth);
}

double tight_centre_distance(const Gear& gear_1, const Gear& gear_2) {
    if (gear_1.profile_shift + gear_2.profile_shift == 0) {
        return reference_centre_distance(gear_1, gear_2);
    }
    return base_centre_distance(gear_1, gear_2) / std::cos(tight_working_angle(gear_1, gear_2));
}

double tight_shift_sum(const Gear& gear_1, const Gear& gear_2, double centre_distance_m) {
    if (is_reference(gear_1, gear_2, centre_distance_m)) {
        return 0;
    }
    const double grown = involute(working_angle_at(gear_1, gear_2, centre_distance_m)) -
                         involute(gear_1.pressure_angle_rad);
    const double teeth = signed_teeth(gear_1) + signed_teeth(gear_2);
    return grown * teeth / (2 * std::tan(gear_1.pressure_angle_rad));
}

std::vector<std::string> undercut_problems(const Gear& gear) {
    constexpr double kHarmless = 0.2;
    const double least = gear.shift_without_undercut() - kHarmless * gear.addendum_coefficient;
    if (gear.internal || gear.profile_shift >= least) {
        return {};
    }
    return {
        fmt::format("{} teeth are undercut with a profile shift of {:g} (shift by {:.3f} or "
                    "more, or use a larger pressure angle)",
                    gear.teeth, gear.profile_shift, least)};
}

WorkingShifts working_shifts(const Gear& gear_1, const Gear& gear_2, const Gear* ring,
                             const SpecifiedShifts& as_specified) {
    WorkingShifts set;
    SpecifiedShifts specified = as_specified;
    const bool by_ring = follows_ring(ring, specified);
    if (!specified.centre_distance_m && !(by_ring && specified.second)) {
        specified.first = specified.first.value_or(0);
    }
    if (!specified.centre_distance_m && !by_ring) {
        specified.second = specified.second.value_or(0);
    }
    const double distance =
        specified.centre_distance_m.value_or(specified_distance(gear_1, gear_2, ring, specified));
    std::tie(set.first, set.second) = shifts_at(gear_1, gear_2, ring, specified, distance);
    if (ring != nullptr) {
        set.ring = specified.ring.value_or(tight_shift_sum(gear_2, *ring, distance) - set.second);
    }
    const bool standard = is_reference(gear_1, gear_2, distance) &&
                          (ring == nullptr || is_reference(gear_2, *ring, distance));
    if (!standard) {
        set.centre_distance_m = distance;
    }
    const double grown =
        is_reference(gear_1, gear_2, distance)
            ? 0
            : (distance - reference_centre_distance(gear_1, gear_2)) / gear_1.module_m;
    set.tip_shortening = std::max(0.0, set.first + set.second - grown);
    return set;
}

using std::numbers::pi;

std::vector<std::string> mesh_problems(const Gear& gear_1, const Gear& gear_2,
                                       std::optional<double> centre_distance_m) {
    std::vector<std::string> problems = gear_problems(gear_1);
    for (auto& problem : gear_problems(gear_2)) {
        problems.push_back(std::move(problem));
    }
    for (auto& problem : pair_problems(gear_1, gear_2)) {
        problems.push_back(std::move(problem));
    }
    if (!problems.empty()) {
        return problems;
    }
    const double angle = working_angle(gear_1, gear_2, centre_distance_m);
    if (!(angle > 0)) {
        const double base = 1e3 * base_centre_distance(gear_1, gear_2);
        return {centre_distance_m
                    ? fmt::format("a centre distance of {:.6g} mm is no more than that of the base "
                                  "circles, {:.6g} mm (move the axes apart)",
                                  1e3 * *centre_distance_m, base)
                    : fmt::format("with shifts of {:g} and {:g} they fit at no centre distance, "
                                  "that of the base circles being {:.6g} mm",
                                  gear_1.profile_shift, gear_2.profile_shift, base)};
    }
    fit_problems(gear_1, gear_2, angle, problems);
    crossing_problems(gear_1, gear_2, angle, problems);
    contact_problems(gear_1, gear_2, angle, problems);
    return problems;
}

MeshGeometry::MeshGeometry(const Gear& gear_1, const Gear& gear_2,
                           std::optional<double> centre_distance_m)
    : gear_1_(gear_1),
      gear_2_(gear_2),
      centre_distance_(centre_distance_m),
      working_angle_(working_angle(gear_1, gear_2, centre_distance_m)) {
    const auto problems = mesh_problems(gear_1, gear_2, centre_distance_m);
    if (!problems.empty()) {
        throw std::invalid_argument(fmt::format("{}", fmt::join(problems, "; ")));
    }
    const LineOfAction line = line_of_action(gear_1, gear_2, working_angle_);
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
    return centre_distance_.value_or(tight_centre_distance(gear_1_, gear_2_));
}

double MeshGeometry::base_pitch() const {
    return pi * gear_1_.module_m * std::cos(gear_1_.pressure_angle_rad);
}

double MeshGeometry::working_pitch_radius(int which) const {
    return working_radius(gear(which), working_angle_);
}

double MeshGeometry::backlash() const {
    return backlash_between(gear_1_, gear_2_, working_angle_);
}

double MeshGeometry::tip_clearance(int which_tip) const {
    return clearance_of_tip(gear_1_, gear_2_, centre_distance(), which_tip);
}

double MeshGeometry::roll_angle(int which, double tau) const {
    const Gear& member = gear(which);
    const double half = member.half_base_angle();
    return contact_angle(which, tau) + (member.internal ? -half : half);
}

double MeshGeometry::contact_radius(int which, double tau) const {
    return gear(which).base_radius() * std::hypot(1, roll_angle(which, tau));
}

}  // namespace gearpod::gears
