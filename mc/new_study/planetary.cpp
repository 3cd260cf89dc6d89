#include "mc/new_study/planetary.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <utility>

#include "gears/power_flow.hpp"
#include "mc/new_study/planetary_text.hpp"
#include "mc/numerics/study_scene.hpp"
#include "mc/study/faults/crack_angle.hpp"
#include "mc/study/gears.hpp"

namespace gearpod::mc {
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
    const gears::Member input = by_carrier ? gears::Member::carrier : gears::Member::sun;
    const gears::PowerFlow flow{gears::Member::ring, input};
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
