#include "stiffness/iso_6336.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "machine/no_value.hpp"

namespace gearpod::stiffness {

double gear_blank_factor(double web_over_face, double rim_over_module) {
    const double web = std::clamp(web_over_face, 0.2, 1.2), rim = std::max(rim_over_module, 1.0);
    return 1 + std::log(web) / (5 * std::exp(rim / 5));
}

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
double theoretical_compliance(const CountedGear& first, const CountedGear& second) {
    const double x_1 = first.shift, x_2 = second.shift;
    return 0.04723 + 0.15551 * first.inverse_teeth + 0.25791 * second.inverse_teeth -
           0.00635 * x_1 - 0.11654 * x_1 * first.inverse_teeth - 0.00193 * x_2 -
           0.24188 * x_2 * second.inverse_teeth + 0.00529 * x_1 * x_1 + 0.00182 * x_2 * x_2;
}

double basic_rack_factor(double dedendum, double normal_angle_rad) {
    const double angle_deg = normal_angle_rad * 180.0 / std::numbers::pi;
    return (1.0 + 0.5 * (1.2 - dedendum)) * (1.0 - 0.02 * (kStandardAngle_deg - angle_deg));
}

using std::numbers::pi;

// Angles of a helical pair, rad, and its contact ratios.
struct Helix {
    Helix(const gears::MeshGeometry& mesh, double angle_rad, double face_width_m)
        : angle(angle_rad),
          transverse_angle(mesh.gear(1).pressure_angle_rad),
          normal_angle(std::atan(std::tan(transverse_angle) * std::cos(angle))),
          base_angle(std::asin(std::sin(angle) * std::cos(normal_angle))),
          normal_module_m(mesh.gear(1).module_m * std::cos(angle)),
          contact_ratio(mesh.contact_ratio()),
          overlap_ratio(std::min(1.0, face_width_m * std::sin(angle) / (pi * normal_module_m))) {}

    double angle, transverse_angle, normal_angle, base_angle;
    double normal_module_m;
    double contact_ratio;
    double overlap_ratio;  // at most 1, as in Z_eps and Y_beta
};

double contact_stress(const gears::MeshGeometry& mesh, const Helix& h, const Material& material,
                      double tangential_N) {
    const double ratio = mesh.gear(2).teeth / static_cast<double>(mesh.gear(1).teeth) *
                         (mesh.internal() ? -1.0 : 1.0);
    const double working = mesh.working_pressure_angle();
    const double cosine = std::cos(h.transverse_angle);
    const double zone = std::sqrt(2.0 * std::cos(h.base_angle) * std::cos(working) /
                                  (cosine * cosine * std::sin(working)));
    const double poisson = material.poisson_ratio;
    const double elasticity =
        std::sqrt(material.youngs_modulus_Pa / (2.0 * pi * (1.0 - poisson * poisson)));
    const double contact = std::sqrt((4.0 - h.contact_ratio) / 3.0 * (1.0 - h.overlap_ratio) +
                                     h.overlap_ratio / h.contact_ratio);
    const double helix = 1.0 / std::sqrt(std::cos(h.angle));
    return zone * elasticity * contact * helix *
           std::sqrt(tangential_N / (2.0 * mesh.gear(1).pitch_radius() * material.face_width_m) *
                     (ratio + 1.0) / ratio);
}

// Root section of the virtual spur gear in the normal plane, in normal modules (ISO 6336-3, section
// 6.2). z: number of teeth, negative for an internal gear.
struct RootSection {
    double chord = 0;          // s_Fn
    double fillet_radius = 0;  // rho_F
    double lever = 0;          // h_Fe
    double force_angle = 0;    // alpha_Fen, rad
};

RootSection root_section(const gears::Gear& gear, const Helix& h) {
    const double cosine = std::cos(h.angle), normal_tan = std::tan(h.normal_angle),
                 normal_cos = std::cos(h.normal_angle), normal_sin = std::sin(h.normal_angle);
    const double sign = gear.internal ? -1.0 : 1.0;
    const double base_cos_2 = std::cos(h.base_angle) * std::cos(h.base_angle);
    const double z = sign * gear.teeth / (base_cos_2 * cosine);
    const double shift = gear.profile_shift / cosine;
    const double dedendum = gear.dedendum_coefficient / cosine;
    const double clearance = dedendum - gear.addendum_coefficient / cosine;
    const double full_radius = (pi / 4.0 - dedendum * normal_tan) * normal_cos / (1.0 - normal_sin);
    const double rack_radius =
        std::clamp(clearance / (1.0 - normal_sin), 0.0, std::max(0.0, full_radius));
    const double tangent = gear.internal ? pi / 6.0 : pi / 3.0;

    const double e =
        pi / 4.0 - dedendum * normal_tan - (1.0 - normal_sin) * rack_radius / normal_cos;
    const double g = rack_radius - dedendum + shift;
    const double k = 2.0 / z * (pi / 2.0 - e) - tangent;
    double theta = pi / 6.0;
    constexpr int kIterations = 50;
    for (int i = 0; i < kIterations; ++i) {
        theta = 2.0 * g / z * std::tan(theta) - k;
    }
    const double below = g / std::cos(theta) - rack_radius;
    constexpr double kRoot3 = std::numbers::sqrt3;

    RootSection section;
    section.chord = z * std::sin(tangent - theta) + (gear.internal ? 1.0 : kRoot3) * below;
    const double theta_cos = std::cos(theta);
    section.fillet_radius =
        rack_radius + 2.0 * g * g / (theta_cos * (z * theta_cos * theta_cos - 2.0 * g));

    // Outer point of single tooth contact.
    const double reference = gear.teeth / (cosine * base_cos_2);
    const double base = reference * normal_cos;
    const double tip =
        reference + 2.0 * (gear.tip_radius() - gear.pitch_radius()) / h.normal_module_m;
    const double normal_contact_ratio = h.contact_ratio / base_cos_2;
    const double roll = std::sqrt(std::max(0.0, 0.25 * (tip * tip - base * base))) -
                        sign * pi * normal_cos * (normal_contact_ratio - 1.0);
    const double load = 2.0 * std::hypot(roll, 0.5 * base);
    const double angle = std::acos(base / load);
    const double half = (0.5 * pi + 2.0 * shift * normal_tan) / z +
                        gears::involute(h.normal_angle) - gears::involute(angle);
    section.force_angle = angle - half;
    section.lever =
        0.5 * ((std::cos(half) - std::sin(half) * std::tan(section.force_angle)) * sign * load -
               z * std::cos(tangent - theta) - (gear.internal ? kRoot3 : 1.0) * below);
    return section;
}

double root_stress(const gears::Gear& gear, const Helix& h, double force_per_width_module_Pa) {
    const RootSection s = root_section(gear, h);
    if (!(s.chord > 0.0 && s.lever > 0.0 && s.fillet_radius > 0.0)) {
        return kNan;
    }
    const double form =
        6.0 * s.lever * std::cos(s.force_angle) / (s.chord * s.chord * std::cos(h.normal_angle));
    // Range of the notch parameter for which ISO 6336-3 gives Y_S.
    constexpr double kLeastNotch = 1.0, kMostNotch = 8.0;
    const double slenderness = s.chord / s.lever;
    const double notch = std::clamp(0.5 * s.chord / s.fillet_radius, kLeastNotch, kMostNotch);
    const double correction =
        (1.2 + 0.13 * slenderness) * std::pow(notch, 1.0 / (1.21 + 2.3 / slenderness));
    constexpr double kMostHelix_deg = 30.0;
    const double helix_deg = std::min(kMostHelix_deg, h.angle * 180.0 / pi);
    return force_per_width_module_Pa * form * correction *
           (1.0 - h.overlap_ratio * helix_deg / 120.0);
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
    const CountedGear first = counted(pinion, helix_cos, base_helix_cos),
                      second = counted(wheel, helix_cos, base_helix_cos);
    const double shifts = first.shift + second.shift;
    if (shifts < kLeastShifts || shifts > kMostShifts ||
        mesh.contact_ratio() < kLeastContactRatio) {
        return {};
    }
    constexpr double kPerMicrometreAndMillimetre = 1e9;  // N/(mm um) in N/m^2
    const double factors =
        kIso6336MeasuredOverTheory *
        basic_rack_factor(pinion.dedendum_coefficient / helix_cos, normal_angle) * helix_cos *
        (material.youngs_modulus_Pa / kSteel_Pa);
    const double single = factors / theoretical_compliance(first, second) *
                          kPerMicrometreAndMillimetre * material.face_width_m;
    return Iso6336Stiffness{single, single * (0.75 * mesh.contact_ratio() + 0.25)};
}

ToothStress iso_6336_stress(const gears::MeshGeometry& mesh, double helix_angle_rad,
                            const Material& material, double force_N) {
    const Helix helix(mesh, helix_angle_rad, material.face_width_m);
    const double tangential_N = force_N * std::cos(helix.transverse_angle);
    const double load_Pa = tangential_N / (material.face_width_m * helix.normal_module_m);
    return {contact_stress(mesh, helix, material, tangential_N),
            root_stress(mesh.gear(1), helix, load_Pa), root_stress(mesh.gear(2), helix, load_Pa)};
}

}  // namespace gearpod::stiffness
