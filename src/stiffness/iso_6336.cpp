#include "stiffness/iso_6336.hpp"

#include <cmath>
#include <numbers>

namespace gearpod::stiffness {
namespace {

constexpr double kSteel_Pa = 2.06e11;
constexpr double kStandardAngle_deg = 20.0;
constexpr double kLeastShifts = -0.5, kMostShifts = 2.0, kLeastContactRatio = 1.2;

// Gear parameters of the formula: 1 / z of its virtual tooth number, and profile shift in normal
// modules.
struct CountedGear {
    double inverse_teeth = 0, shift = 0;
};

CountedGear counted(const gears::Gear& gear, double helix_cos, double base_helix_cos) {
    const double teeth = gear.teeth / (base_helix_cos * base_helix_cos * helix_cos);
    return {gear.internal ? 0.0 : 1.0 / teeth, gear.profile_shift / helix_cos};
}

// Theoretical compliance q', mm um/N.
double theoretical_compliance(const CountedGear& one, const CountedGear& two) {
    const double x_1 = one.shift, x_2 = two.shift;
    return 0.04723 + 0.15551 * one.inverse_teeth + 0.25791 * two.inverse_teeth - 0.00635 * x_1 -
           0.11654 * x_1 * one.inverse_teeth - 0.00193 * x_2 - 0.24188 * x_2 * two.inverse_teeth +
           0.00529 * x_1 * x_1 + 0.00182 * x_2 * x_2;
}

double basic_rack_factor(double dedendum, double normal_angle_rad) {
    const double angle_deg = normal_angle_rad * 180.0 / std::numbers::pi;
    return (1.0 + 0.5 * (1.2 - dedendum)) * (1.0 - 0.02 * (kStandardAngle_deg - angle_deg));
}

}  // namespace

std::optional<Iso6336Stiffness> iso_6336_stiffness(const gears::MeshGeometry& mesh,
                                                   double helix_angle_rad,
                                                   const Material& material) {
    const bool swapped = !mesh.internal() && mesh.gear(2).teeth < mesh.gear(1).teeth;
    const gears::Gear &pinion = mesh.gear(swapped ? 2 : 1), &wheel = mesh.gear(swapped ? 1 : 2);
    const double helix_cos = std::cos(helix_angle_rad);
    const double normal_angle = std::atan(std::tan(pinion.pressure_angle_rad) * helix_cos);
    const double base_helix_sin = std::sin(helix_angle_rad) * std::cos(normal_angle);
    const double base_helix_cos = std::sqrt(1.0 - base_helix_sin * base_helix_sin);
    const CountedGear one = counted(pinion, helix_cos, base_helix_cos),
                      two = counted(wheel, helix_cos, base_helix_cos);
    const double shifts = one.shift + two.shift;
    if (shifts < kLeastShifts || shifts > kMostShifts ||
        mesh.contact_ratio() < kLeastContactRatio) {
        return {};
    }
    constexpr double kPerMicrometreAndMillimetre = 1e9;  // N/(mm um) in N/m^2
    const double factors =
        kIso6336MeasuredOverTheory *
        basic_rack_factor(pinion.dedendum_coefficient / helix_cos, normal_angle) * helix_cos *
        (material.youngs_modulus_Pa / kSteel_Pa);
    const double single = factors / theoretical_compliance(one, two) * kPerMicrometreAndMillimetre *
                          material.face_width_m;
    return Iso6336Stiffness{single, single * (0.75 * mesh.contact_ratio() + 0.25)};
}

}  // namespace gearpod::stiffness
