#include "gears/planetary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <string>
#include <tuple>

#include "mc/study/faults/crack.hpp"
#include "mc/study/gears.hpp"
#include "mc/study/new/datasheet.hpp"
#include "mc/study/new/rules.hpp"
#include "mc/study/new/study_text.hpp"

namespace gearpod::mc {
namespace {

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

// Section [gearbox] in parts: keys of the whole gearbox with the datasheet values and the material,
// and the tables of the members.
struct GearboxText {
    std::string general;
    MemberTables members{"sun", "planet", "ring", "carrier"};
};

void add_bodies(const DerivedGearbox& d, MemberTables& members) {
    members["sun"] +=
        line("bore_mm", 2e3 * d.sun_body.inner_m,
             "rims of 1.2 tooth heights: thinner ones weaken the root (AGMA 2001-D04, "
             "backup ratio)");
    members["planet"] += line("bore_mm", 2e3 * d.planet_body.inner_m, "holds the bearing");
    members["ring"] += line("outer_mm", 2e3 * d.ring_body.outer_m,
                            "rim of three tooth heights, with room for bolts (chosen)");
    const auto body = [&](const char* name, const Annulus& annulus, const char* comment) {
        members[name] += line("mass_kg", annulus.mass_kg(), comment) +
                         line("inertia_kg_m2", annulus.inertia_kg_m2());
    };
    body("sun", d.sun_body, "a steel ring between bore and reference circle (7850 kg/m^3)");
    body("planet", d.planet_body, "");
    body("ring", d.ring_body, "between reference circle and outside");
    members["carrier"] +=
        line("mass_kg", d.carrier_mass_kg,
             "two plates of a quarter of the face width, one pin diameter beyond the pins") +
        line("inertia_kg_m2", d.carrier_inertia_kg_m2, "and pins of 1.5 face widths, chosen");
}

// True if a datasheet gives that member's bearing stiffness.
bool bearing_given(const PlanetaryDatasheet& data, const std::string& name) {
    return name == "sun"       ? data.sun_bearing_N_m.has_value()
           : name == "planet"  ? data.planet_bearing_N_m.has_value()
           : name == "ring"    ? data.ring_bearing_N_m.has_value()
           : name == "carrier" ? data.carrier_bearing_N_m.has_value()
                               : false;
}

// Adds the bearings of the members; returns the support of the ring.
std::string add_bearings(const NominalGears& g, const DerivedGearbox& d, MemberTables& members) {
    for (const char* name : {"sun", "planet", "ring", "carrier"}) {
        const double stiffness = d.bearings_N_m.at(name);
        members[name] +=
            (bearing_given(g.data, name) ? given_line("bearing_stiffness_N_m", stiffness, "given")
                                         : line("bearing_stiffness_N_m", stiffness)) +
            line("bearing_damping_N_s_m", bearing_damping_N_s_m(stiffness));
    }
    const RollerBearing& b = d.bearing;
    const double support = d.bearings_N_m.at("support");
    return fmt::format(
               "# Planet bearings: 2 rows of {} rollers, {} mm long, loaded with {} kN:\n"
               "# 1e9 Z^0.9 l^0.8 F^0.1 (Kraemer, after Palmgren). Chosen: carrier bearings of "
               "the\n"
               "# same stiffness, a bolted ring of twice the stiffness, and a floating sun of a\n"
               "# fiftieth, so that the planets share the load. Damping: 1e-5 s times the\n"
               "# stiffness (Kraemer: 0.25e-5 to 2.5e-5 s).\n",
               b.rollers, rounded_text(1e3 * b.roller_length_m),
               rounded_text(1e-3 * d.pin_load_N)) +
           line("support_stiffness_N_m", support, "holds the ring's rotation") +
           line("support_damping_N_s_m", bearing_damping_N_s_m(support));
}

// Standard deviation of the pin positions: a normal distribution with 95 % within the tolerance.
double pin_rms_um(const DerivedGearbox& d) {
    return 1e6 * grade_7_tolerance_m(d.centre_distance_m) / 4.0;
}

std::string accuracy(const NominalGears& g, const DerivedGearbox& d) {
    return line("tooth_quality", g.data.quality.value_or(kDefaultQuality),
                "ISO 1328 grade of all gears") +
           line("pin_tangential_rms_um", pin_rms_um(d),
                "a quarter of ISO 286's tolerance of grade 7 on the centre distance") +
           line("pin_radial_rms_um", pin_rms_um(d)) +
           line("mesh_damping_ratio", 0.1, "0.03 to 0.17 of critical (Kasuba and Evans, 1981)");
}

std::string operation(const NominalGears& g, const InputLoad& load) {
    return "\n[operation]\nfixed = \"ring\"\n" + line("input", "\"" + g.data.input + "\"", "") +
           line("torque_on", "\"" + g.data.input + "\"", "") +
           load_lines(g.data, load, g.data.input + "_speed_rpm");
}

constexpr const char* kFault =
    "\n[fault]                                     # other kinds: gearpod describe --keys fault\n"
    "kind = \"crack\"\n"
    "member = \"planet\"                           # on its ring side (fault.side); or \"sun\", "
    "\"ring\"\n"
    "depth_mm = 0\nangle_deg = 45\n";

std::string random(const DerivedGearbox& d, const InputLoad& load, const Background& noise) {
    std::string text =
        "\n[random]                                    # variation between gearboxes (chosen)\n";
    for (const char* name : {"planet", "sun", "ring", "carrier"}) {
        text += varied(fmt::format("gearbox.{}.bearing_stiffness_N_m", name),
                       lognormal(d.bearings_N_m.at(name), 0.3));
    }
    return text + varied("gearbox.mesh_damping_ratio", "\"uniform\", low = 0.03, high = 0.17") +
           varied_torque(load.torque_N_m) +
           varied("sensor.path_exponent", "\"uniform\", low = -0.1, high = 0.1") +
           varied("sensor." + std::string(noise.key), lognormal(noise.value, 0.2)) +
           varied_depth(d.deepest_crack_m);
}

GearboxText gearbox_teeth(const NominalGears& g) {
    const PlanetaryDatasheet& data = g.data;
    GearboxText text;
    text.general = fmt::format("[gearbox]\nkind = \"planetary\"\nplanets = {}\n", data.planets) +
                   teeth_lines(data, g.face_width_mm);
    for (const auto& [member, teeth, shift, tip_mm] :
         {std::tuple{"sun", data.sun, data.sun_shift, data.sun_tip_mm},
          std::tuple{"planet", data.planet, data.planet_shift, data.planet_tip_mm},
          std::tuple{"ring", g.ring_teeth, data.ring_shift, data.ring_tip_mm}}) {
        text.members[member] += gear_lines(teeth, shift, tip_mm);
    }
    return text;
}

// Returns the complete study. `command`: command line, quoted in its first comment.
std::string planetary_text(const NominalGears& g, const DerivedGearbox& d, const InputLoad& load,
                           const std::string& command) {
    const PlanetaryDatasheet& data = g.data;
    auto [general, members] = gearbox_teeth(g);
    add_bodies(d, members);
    const std::string support = add_bearings(g, d, members);
    const NewSensor sensor = new_sensor(data, d.mesh_frequency_Hz);
    return study_header(
               data,
               fmt::format("A planetary gearbox of {}/{}/{} teeth and {} planets", data.sun,
                           data.planet, g.ring_teeth, data.planets),
               command,
               fmt::format("Planetary gearbox {}/{}/{}", data.sun, data.planet, g.ring_teeth),
               "crack of a tooth") +
           general + accuracy(g, d) + support + members.text() + operation(g, load) +
           effects_section("hamming") + kFault +
           sensor_section(data, sensor, line("path_exponent", 0.1, "Liang (2016), section 5.1")) +
           random(d, load, sensor.background) + output_sections(data, sensor.background);
}

// Minimal study with the teeth only. Reading it checks the teeth.
std::string minimal_study(const NominalGears& gears) {
    const auto [general, members] = gearbox_teeth(gears);
    return general + "support_stiffness_N_m = 1e9\n" + members.text() +
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

int ring_teeth(const PlanetaryDatasheet& data) {
    constexpr std::int64_t kMost = 1 << 30;
    return data.ring.value_or(
        static_cast<int>(std::clamp(data.sun + 2 * std::int64_t{data.planet}, -kMost, kMost)));
}

NewStudy new_planetary(const PlanetaryDatasheet& data, const std::string& command,
                       const DatasheetSource& source) {
    const NominalGears gears{data, ring_teeth(data), face_width_mm(data)};
    return checked_study(data, source, data.input, minimal_study(gears),
                         [&](const Study& teeth, const InputLoad& load) {
                             return planetary_text(gears, derive(teeth, data, load), load, command);
                         });
}

}  // namespace gearpod::mc
