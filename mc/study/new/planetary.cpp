#include "mc/study/new/planetary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <map>
#include <string>
#include <utility>

#include "gears/planetary.hpp"
#include "mc/numerics/study_scene.hpp"
#include "mc/study/faults/crack.hpp"
#include "mc/study/gears.hpp"
#include "mc/study/new/datasheet.hpp"
#include "mc/study/new/rules.hpp"
#include "mc/study/new/study_text.hpp"

namespace gearpod::mc {

// Datasheet completed with the ring's tooth number and the face width.
struct NominalGears {
    PlanetaryDatasheet data;
    int ring_teeth = 0;
    double face_width_mm = 0;
};

// Values derived by the rules of rules.hpp.
struct DerivedGearbox {
    double centre_distance_m = 0;
    Annulus sun_body, planet_body, ring_body;
    RollerBearing bearing;  // of a planet
    // Stiffness of bearings and support, given or by rule: sun, planet, ring, carrier, support.
    std::map<std::string, double> bearings_N_m;
    double carrier_mass_kg = 0, carrier_inertia_kg_m2 = 0;
    gears::CentralMembers torques;
    double mesh_frequency_Hz = 0, pin_load_N = 0, deepest_crack_m = 0;
};

// Returns section [gearbox] with the datasheet values and the material.
std::string gearbox_teeth(const NominalGears& gears);

// Returns the complete study. `command`: command line, quoted in its first comment.
std::string planetary_text(const NominalGears& gears, const DerivedGearbox& derived,
                           const InputLoad& load, const std::string& command);

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

namespace {

// Tooth number of the ring for standard gears. The tooth numbers are not checked yet.
int default_ring_teeth(const PlanetaryDatasheet& data) {
    constexpr std::int64_t kMost = 1 << 30;
    return static_cast<int>(std::clamp(data.sun + 2 * std::int64_t{data.planet}, -kMost, kMost));
}

// Minimal study with the teeth only. Reading it checks the teeth.
std::string minimal_study(const NominalGears& gears) {
    return gearbox_teeth(gears) +
           "tooth_profile = \"fillet\"\nsupport_stiffness_N_m = 1e9\n"
           "[operation]\nfixed = \"ring\"\ninput = \"sun\"\ntorque_N_m = 1\nsun_speed_rpm = 1\n"
           "[effects]\nmotion = \"quasi-static-torsional\"\n"
           "[fault]\nkind = \"crack\"\nmember = \"planet\"\nside = \"ring\"\ndepth_mm = 0\n"
           "angle_deg = 45\n"
           "[sensor]\nencoder_sampling_Hz = 1000\n"
           "[ensemble]\ninstances = 1\nthreshold_instances = 1\nseed = 1\n";
}

// Bodies, bearings and loads that follow by the rules.
DerivedGearbox derive(const Study& study, const PlanetaryDatasheet& data, const InputLoad& load) {
    DerivedGearbox d;
    const gears::Gear sun = gear_of(study, Member::sun), planet = gear_of(study, Member::planet),
                      ring = gear_of(study, Member::ring);
    const double width = study.gearbox.face_width_m.value();
    const double distance = centre_distance_m(study);
    d.centre_distance_m = distance;
    d.sun_body = {sun.pitch_radius(), default_bore_radius_m(sun), width};
    d.planet_body = {planet.pitch_radius(), default_bore_radius_m(planet), width};
    d.ring_body = {ring.root_radius() + 3.0 * tooth_height_m(ring), ring.pitch_radius(), width};
    d.bearing = bearing_in_bore(2.0 * d.planet_body.inner_m, width);
    const double pin_radius = 0.5 * d.bearing.inner_diameter_m;
    const Annulus plate{distance + 2.0 * pin_radius, 0.0, 0.25 * width},
        pin{pin_radius, 0.0, 1.5 * width};
    d.carrier_mass_kg = 2.0 * plate.mass_kg() + data.planets * pin.mass_kg();
    d.carrier_inertia_kg_m2 =
        2.0 * plate.inertia_kg_m2() +
        data.planets * (pin.inertia_kg_m2() + pin.mass_kg() * distance * distance);
    const gears::PlanetaryTrain train{data.sun, data.planet, *teeth_of(study, Member::ring),
                                      data.planets};
    const bool by_carrier = data.input == "carrier";
    const Member input = by_carrier ? Member::carrier : Member::sun;
    const gears::PowerFlow flow{Member::ring, input};
    d.torques = gears::balanced_torques(train, input, load.torque_N_m);
    d.mesh_frequency_Hz = gears::mesh_frequency(
        train, gears::signed_speeds(train, flow, input, load.speed_rpm / 60.0));
    d.pin_load_N = std::abs(d.torques.carrier) / (data.planets * distance);
    const double bearing = d.bearing.stiffness_N_m(d.pin_load_N);
    d.bearings_N_m = {{"sun", data.sun_bearing_N_m.value_or(0.02 * bearing)},
                      {"planet", data.planet_bearing_N_m.value_or(bearing)},
                      {"ring", data.ring_bearing_N_m.value_or(2.0 * bearing)},
                      {"carrier", data.carrier_bearing_N_m.value_or(bearing)},
                      {"support", 2.0 * bearing}};
    d.deepest_crack_m = max_crack_depth_m(study);
    return d;
}

}  // namespace

NewStudy new_planetary(const PlanetaryDatasheet& data, const std::string& command,
                       const DatasheetSource& source) {
    const NominalGears gears{data, data.ring ? *data.ring : default_ring_teeth(data),
                             face_width_mm(data)};
    Problems problems = load_problems(data, source, data.input);
    const StudyReading teeth = read_study_text(minimal_study(gears), source.file);
    std::ranges::move(as_named_by(source, teeth.problems), std::back_inserter(problems));
    if (!teeth.study || !problems.empty()) {
        return {"", problems};
    }
    const InputLoad load = load_of(data);
    const std::string text = planetary_text(gears, derive(*teeth.study, data, load), load, command);
    // Reading finds values out of range; building the scene finds all other problems.
    problems =
        as_named_by(source, make_scene(source.file, read_study_text(text, source.file)).problems);
    return problems.empty() ? NewStudy{text, {}} : NewStudy{"", std::move(problems)};
}

}  // namespace gearpod::mc
