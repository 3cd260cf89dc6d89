#include "mc/study/new/rules.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace gearpod::mc {

using std::numbers::pi;

double default_face_width_m(double normal_module_m) {
    return 4.0 * pi * normal_module_m;
}

double default_rim_m(double tooth_height_m) {
    return 1.2 * tooth_height_m;
}

double tooth_height_m(const gears::Gear& gear) {
    return std::abs(gear.tip_radius() - gear.root_radius());
}

double default_bore_radius_m(const gears::Gear& gear) {
    return std::max(gear.root_radius() - default_rim_m(tooth_height_m(gear)),
                    kMinBoreRatio * gear.root_radius());
}

double Annulus::mass_kg() const {
    return kSteelDensity_kg_m3 * pi * (outer_m * outer_m - inner_m * inner_m) * width_m;
}

double Annulus::inertia_kg_m2() const {
    return 0.5 * mass_kg() * (outer_m * outer_m + inner_m * inner_m);
}

double RollerBearing::stiffness_N_m(double load_N) const {
    return rows * 1e9 * std::pow(rollers, 0.9) * std::pow(roller_length_m, 0.8) *
           std::pow(load_N / rows, 0.1);
}

RollerBearing bearing_in_bore(double bore_m, double width_m) {
    constexpr double kPitchCircle = 0.77, kRoller = 0.14, kSpacing = 1.2, kInner = 0.55;
    constexpr int kRows = 2;
    return {static_cast<int>(pi * kPitchCircle / (kSpacing * kRoller)), kRows,
            0.7 * width_m / kRows, kInner * bore_m};
}

RollerBearing bearings_on_shaft(double shaft_diameter_m) {
    constexpr double kInner = 0.55, kWidth = 0.25;
    const double outer = shaft_diameter_m / kInner;
    return bearing_in_bore(outer, 2.0 * kWidth * outer);
}

double shaft_torsion_N_m_rad(double diameter_m) {
    constexpr double kShearModulus_Pa = 7.93e10, kLength = 10.0;
    return kShearModulus_Pa * pi * std::pow(diameter_m, 3) / (32.0 * kLength);
}

double bearing_damping_N_s_m(double stiffness_N_m) {
    return 1e-5 * stiffness_N_m;
}

double grade_7_tolerance_m(double size_m) {
    const double mm = 1e3 * size_m;
    const double factor_um = mm <= 500.0 ? 0.45 * std::cbrt(mm) + 0.001 * mm : 0.004 * mm + 2.1;
    return 16e-6 * factor_um;
}

}  // namespace gearpod::mc
