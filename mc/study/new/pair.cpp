#include <fmt/format.h>

#include <tuple>

#include "mc/study/faults/crack.hpp"
#include "mc/study/gears.hpp"
#include "mc/study/new/datasheet.hpp"
#include "mc/study/new/rules.hpp"
#include "mc/study/new/study_text.hpp"

namespace gearpod::mc {
namespace {

// Values of one gear that follow by the rules.
struct DerivedGear {
    Annulus body;
    double bearing_N_m = 0;
    double shaft_N_m_rad = 0;  // torsion between the gear and its motor or load
};

struct DerivedPair {
    DerivedGear pinion, gear;
    double mesh_frequency_Hz = 0, deepest_crack_m = 0, tooth_force_N = 0;
};

// Keys of the whole pair in [gearbox], and the tables of both gears.
struct PairText {
    std::string general;
    MemberTables members{"pinion", "gear"};
};
PairText pair_teeth(const PairDatasheet& data) {
    PairText text;
    text.general = "[gearbox]\nkind = \"fixed-shaft\"\n" + teeth_lines(data, face_width_mm(data));
    text.members["pinion"] = gear_lines(data.pinion, data.pinion_shift, data.pinion_tip_mm);
    text.members["gear"] = gear_lines(data.gear, data.gear_shift, data.gear_tip_mm);
    return text;
}

// The smaller gear, whose teeth crack first: they pass the mesh more often.
const char* cracked_gear(const PairDatasheet& data) {
    return data.pinion <= data.gear ? "pinion" : "gear";
}

// Minimal study with the teeth only. Reading it checks the teeth.
std::string minimal_pair(const PairDatasheet& data) {
    auto [general, members] = pair_teeth(data);
    members["pinion"] += "bearing_stiffness_N_m = 1e8\n";
    members["gear"] += "bearing_stiffness_N_m = 1e8\n";
    return general + "motor_coupling_stiffness_N_m_rad = 1\nload_coupling_stiffness_N_m_rad = 1\n" +
           members.text() +
           "[operation]\ntorque_N_m = 1\npinion_speed_rpm = 1\n"
           "[effects]\nmotion = \"quasi-static\"\npath = \"none\"\n" +
           fmt::format("[fault]\nkind = \"crack\"\nmember = \"{}\"\n", cracked_gear(data)) +
           "depth_mm = 0\nangle_deg = 45\n"
           "[sensor]\nencoder_sampling_Hz = 1000\n"
           "[ensemble]\ninstances = 1\nthreshold_instances = 1\nseed = 1\n";
}

DerivedGear derive_gear(const gears::Gear& gear, double width_m, double force_N,
                        const std::optional<double>& given_N_m) {
    const double bore = default_bore_radius_m(gear);
    return {{gear.pitch_radius(), bore, width_m},
            given_N_m.value_or(bearings_on_shaft(2.0 * bore).stiffness_N_m(force_N)),
            shaft_torsion_N_m_rad(2.0 * bore)};
}

DerivedPair derive_pair(const Study& study, const PairDatasheet& data, const InputLoad& load) {
    const gears::Gear pinion = gear_of(study, Member::pinion), gear = gear_of(study, Member::gear);
    const double width = study.gearbox.face_width_m.value();
    DerivedPair d;
    d.tooth_force_N = load.torque_N_m / pinion.base_radius();
    d.pinion = derive_gear(pinion, width, d.tooth_force_N, data.pinion_bearing_N_m);
    d.gear = derive_gear(gear, width, d.tooth_force_N, data.gear_bearing_N_m);
    d.mesh_frequency_Hz = data.pinion * load.speed_rpm / 60.0;
    d.deepest_crack_m = max_crack_depth_m(study);
    return d;
}

std::string gearbox_section(const PairDatasheet& data, const DerivedPair& d) {
    constexpr double kMotorInertia = 10.0;  // times the gear's; chosen
    auto [general, members] = pair_teeth(data);
    std::string inertias, couplings;
    for (const auto& [name, machine, gear, given] :
         {std::tuple{"pinion", "motor", d.pinion, data.pinion_bearing_N_m.has_value()},
          std::tuple{"gear", "load", d.gear, data.gear_bearing_N_m.has_value()}}) {
        const bool first = name == std::string("pinion");
        const auto of_machine = [&](const char* what) {
            return fmt::format("{}_{}", machine, what);
        };
        members[name] +=
            line("bore_mm", 2e3 * gear.body.inner_m,
                 first ? "rims of 1.2 tooth heights: thinner ones weaken the root (AGMA 2001-D04, "
                         "backup ratio)"
                       : "") +
            line("mass_kg", gear.body.mass_kg(),
                 first ? "a steel ring between bore and reference circle (7850 kg/m^3)" : "") +
            line("inertia_kg_m2", gear.body.inertia_kg_m2()) +
            (given ? given_line("bearing_stiffness_N_m", gear.bearing_N_m, "given")
                   : line("bearing_stiffness_N_m", gear.bearing_N_m)) +
            line("bearing_damping_N_s_m", bearing_damping_N_s_m(gear.bearing_N_m));
        inertias += line(of_machine("inertia_kg_m2"), kMotorInertia * gear.body.inertia_kg_m2(),
                         "ten times the gear's (chosen)");
        couplings +=
            line(of_machine("coupling_stiffness_N_m_rad"), gear.shaft_N_m_rad,
                 first ? "steel shafts of the bore's diameter, ten diameters long (chosen)" : "") +
            line(of_machine("coupling_damping_N_m_s_rad"),
                 bearing_damping_N_s_m(gear.shaft_N_m_rad));
    }
    return general +
           line("tooth_quality", data.quality.value_or(kDefaultQuality),
                "ISO 1328 grade of both gears") +
           line("mesh_damping_ratio", 0.1, "0.03 to 0.17 of critical (Kasuba and Evans, 1981)") +
           inertias + couplings +
           fmt::format(
               "# Bearings: two roller bearings on each shaft, loaded with {} kN together:\n"
               "# 1e9 Z^0.9 l^0.8 F^0.1 (Kraemer, after Palmgren). Damping: 1e-5 s times\n"
               "# the stiffness (Kraemer: 0.25e-5 to 2.5e-5 s).\n",
               rounded_text(1e-3 * d.tooth_force_N)) +
           members.text();
}

std::string pair_text(const PairDatasheet& data, const DerivedPair& d, const InputLoad& load,
                      const std::string& command) {
    const NewSensor sensor = new_sensor(data, d.mesh_frequency_Hz);
    const Background& noise = sensor.background;
    return study_header(data,
                        fmt::format("A pair of gears with {} and {} teeth", data.pinion, data.gear),
                        command, fmt::format("Gear pair {}/{}", data.pinion, data.gear),
                        fmt::format("crack of a {} tooth", cracked_gear(data))) +
           gearbox_section(data, d) + "\n[operation]\n" +
           load_lines(data, load, "pinion_speed_rpm") + effects_section("none") +
           "\n[fault]                                     # another gear or kind: gearpod describe "
           "--keys fault\nkind = \"crack\"\n" +
           fmt::format("member = \"{}\"\ndepth_mm = 0\nangle_deg = 45\n", cracked_gear(data)) +
           sensor_section(data, sensor, line("position", "\"pinion\"", "")) +
           "\n[random]                                    # variation between gearboxes "
           "(chosen)\n" +
           varied("gearbox.pinion.bearing_stiffness_N_m", lognormal(d.pinion.bearing_N_m, 0.3)) +
           varied("gearbox.gear.bearing_stiffness_N_m", lognormal(d.gear.bearing_N_m, 0.3)) +
           varied("gearbox.mesh_damping_ratio", "\"uniform\", low = 0.03, high = 0.17") +
           varied_torque(load.torque_N_m) +
           varied("sensor." + std::string(noise.key), lognormal(noise.value, 0.2)) +
           varied_depth(d.deepest_crack_m) + output_sections(data, noise);
}

}  // namespace

NewStudy new_pair(const PairDatasheet& data, const std::string& command,
                  const DatasheetSource& source) {
    return checked_study(data, source, "driving gear", minimal_pair(data),
                         [&](const Study& teeth, const InputLoad& load) {
                             return pair_text(data, derive_pair(teeth, data, load), load, command);
                         });
}

}  // namespace gearpod::mc
