#include "gears/working_pair.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
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

namespace {

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

}  // namespace

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

}  // namespace gearpod::gears
