#include "mc/new_study/planetary_text.hpp"

#include <fmt/format.h>

#include <string>
#include <utility>

#include "mc/new_study/study_text.hpp"

namespace gearpod::mc {
namespace {

std::string masses(const DerivedGearbox& d) {
    std::string text;
    const auto body = [&](const char* name, const Annulus& annulus, const char* comment) {
        text += line(fmt::format("{}_mass_kg", name), annulus.mass_kg(), comment);
        text += line(fmt::format("{}_inertia_kg_m2", name), annulus.inertia_kg_m2());
    };
    body("sun", d.sun_body, "steel rings between bore and reference circle (7850 kg/m^3)");
    body("planet", d.planet_body, "");
    body("ring", d.ring_body, "between reference circle and outside");
    text += line("carrier_mass_kg", d.carrier_mass_kg,
                 "two plates of a quarter of the face width, one pin diameter beyond the pins");
    text += line("carrier_inertia_kg_m2", d.carrier_inertia_kg_m2,
                 "and pins of 1.5 face widths, chosen");
    return text;
}

std::string bodies(const DerivedGearbox& d) {
    return line("sun_bore_mm", 2e3 * d.sun_body.inner_m,
                "rims of 1.2 tooth heights: thinner ones weaken the root (AGMA 2001-D04, backup "
                "ratio)") +
           line("planet_bore_mm", 2e3 * d.planet_body.inner_m, "holds the bearing") +
           line("ring_outer_mm", 2e3 * d.ring_body.outer_m,
                "rim of three tooth heights, with room for bolts (chosen)");
}

// True if a datasheet gives that member's bearing stiffness.
bool bearing_given(const PlanetaryDatasheet& data, const std::string& name) {
    return name == "sun"       ? data.sun_bearing_N_m.has_value()
           : name == "planet"  ? data.planet_bearing_N_m.has_value()
           : name == "ring"    ? data.ring_bearing_N_m.has_value()
           : name == "carrier" ? data.carrier_bearing_N_m.has_value()
                               : false;
}

std::string bearings(const NominalGears& g, const DerivedGearbox& d) {
    const RollerBearing& b = d.bearing;
    std::string text = fmt::format(
        "# Planet bearings: 2 rows of {} rollers, {} mm long, loaded with {} kN:\n"
        "# 1e9 Z^0.9 l^0.8 F^0.1 (Kraemer, after Palmgren). Chosen: carrier bearings of the\n"
        "# same stiffness, a bolted ring of twice the stiffness, and a floating sun of a\n"
        "# fiftieth, so that the planets share the load. Damping: 1e-5 s times the\n"
        "# stiffness (Kraemer: 0.25e-5 to 2.5e-5 s).\n",
        b.rollers, rounded_text(1e3 * b.roller_length_m), rounded_text(1e-3 * d.pin_load_N));
    std::string damping;
    for (const char* name : {"sun", "planet", "ring", "carrier", "support"}) {
        const double stiffness = d.bearings_N_m.at(name);
        const bool support = name == std::string("support");
        const std::string prefix = support ? name : std::string(name) + "_bearing";
        text += bearing_given(g.data, name)
                    ? given_line(prefix + "_stiffness_N_m", stiffness, "given")
                    : line(prefix + "_stiffness_N_m", stiffness,
                           support ? "holds the ring's rotation" : "");
        damping += line(prefix + "_damping_N_s_m", bearing_damping_N_s_m(stiffness));
    }
    return text + damping;
}

// Standard deviation of the pin positions: a normal distribution with 95 % within the tolerance.
double pin_rms_um(const DerivedGearbox& d) {
    return 1e6 * grade_7_tolerance_m(d.centre_distance_m) / 4.0;
}

std::string accuracy(const NominalGears& g, const DerivedGearbox& d) {
    return line("tooth_quality", g.data.quality, "ISO 1328 grade of all gears") +
           line("pin_tangential_rms_um", pin_rms_um(d),
                "a quarter of ISO 286's tolerance of grade 7 on the centre distance") +
           line("pin_radial_rms_um", pin_rms_um(d)) +
           line("mesh_damping_ratio", 0.1, "0.03 to 0.17 of critical (Kasuba and Evans, 1981)");
}

std::string operation(const NominalGears& g, const InputLoad& load) {
    return "\n[operation]\nfixed = \"ring\"\n" + line("input", "\"" + g.data.input + "\"", "") +
           line("torque_on", "\"" + g.data.input + "\"", "") +
           (g.data.torque_N_m ? given_line("torque_N_m", load.torque_N_m)
                              : line("torque_N_m", load.torque_N_m)) +
           (g.data.speed_rpm ? given_line(g.data.input + "_speed_rpm", load.speed_rpm)
                             : line(g.data.input + "_speed_rpm", load.speed_rpm));
}

std::string effects() {
    return "\n[effects]\n" + line("motion", "\"translational-torsional\"", "") +
           line("foundation", "\"elastic-ring\"",
                "agrees with finite elements (docs/validation/mesh-stiffness-level.md)") +
           line("contact_onset", "\"extended\"", "tip corners touch before and after the path") +
           line("mesh_damping", "\"ratio\"", "") + line("path", "\"hamming\"", "");
}

constexpr const char* kFault =
    "\n[fault]                                     # another gear, side or kind: gearpod describe "
    "--keys fault\n"
    "kind = \"crack\"\nmember = \"planet\"\nside = \"ring\"\nplanet = 1\ndepth_mm = 0\n"
    "angle_deg = 45\n";

std::string random(const DerivedGearbox& d, const InputLoad& load) {
    const Background noise = background(sensor_rates(d.mesh_frequency_Hz));
    std::string text =
        "\n[random]                                    # variation between gearboxes (chosen)\n";
    for (const char* name : {"planet", "sun", "ring", "carrier"}) {
        text += varied(fmt::format("gearbox.{}_bearing_stiffness_N_m", name),
                       lognormal(d.bearings_N_m.at(name), 0.3));
    }
    return text + varied("gearbox.mesh_damping_ratio", "\"uniform\", low = 0.03, high = 0.17") +
           varied_torque(load.torque_N_m) +
           varied("sensor.path_exponent", "\"uniform\", low = -0.1, high = 0.1") +
           varied("sensor." + std::string(noise.key), lognormal(noise.value, 0.2)) +
           varied_depth(d.deepest_crack_m);
}

}  // namespace

std::string gearbox_teeth(const NominalGears& g) {
    const PlanetaryDatasheet& data = g.data;
    std::string text = fmt::format(
        "[gearbox]\nkind = \"planetary\"\nplanets = {}\nsun_teeth = {}\nplanet_teeth = {}\n"
        "ring_teeth = {}\n",
        data.planets, data.sun, data.planet, g.ring_teeth);
    text += module_lines(data);
    for (const auto& [key, value] :
         {std::pair{"addendum_coefficient", data.addendum}, std::pair{"sun_shift", data.sun_shift},
          std::pair{"planet_shift", data.planet_shift}, std::pair{"ring_shift", data.ring_shift},
          std::pair{"centre_distance_mm", data.centre_distance_mm},
          std::pair{"sun_tip_mm", data.sun_tip_mm}, std::pair{"planet_tip_mm", data.planet_tip_mm},
          std::pair{"ring_tip_mm", data.ring_tip_mm}}) {
        if (value) {
            text += fmt::format("{} = {}\n", key, *value);
        }
    }
    return text + body_lines(data, g.face_width_mm);
}

std::string planetary_text(const NominalGears& g, const DerivedGearbox& d, const InputLoad& load,
                           const std::string& command) {
    const PlanetaryDatasheet& data = g.data;
    const std::string gearbox = fmt::format("A planetary gearbox of {}/{}/{} teeth and {} planets",
                                            data.sun, data.planet, g.ring_teeth, data.planets);
    const std::string title = fmt::format(
        "title = \"Planetary gearbox {}/{}/{}: crack of a planet tooth on the ring side\"\n\n",
        data.sun, data.planet, g.ring_teeth);
    return study_header(data, gearbox, command) + title + gearbox_teeth(g) +
           "tooth_profile = \"fillet\"\n" + bodies(d) + accuracy(g, d) + masses(d) +
           bearings(g, d) + operation(g, load) + effects() + kFault +
           sensor_section(d.mesh_frequency_Hz,
                          line("path_exponent", 0.1, "Liang (2016), section 5.1")) +
           random(d, load) + output_sections();
}

}  // namespace gearpod::mc
