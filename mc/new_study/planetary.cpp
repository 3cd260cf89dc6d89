#include "mc/new_study/planetary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <numbers>
#include <utility>

#include "gears/power_flow.hpp"
#include "mc/new_study/planetary_text.hpp"
#include "mc/numerics/study_scene.hpp"
#include "mc/study/faults/crack_angle.hpp"
#include "mc/study/gears.hpp"

namespace gearpod::mc {
namespace {

// Options of `new planetary` and the study keys that they set.
constexpr std::array kOptions{
    std::pair{"gearbox.sun_teeth", "--sun"},
    std::pair{"gearbox.planet_teeth", "--planet"},
    std::pair{"gearbox.ring_teeth", "--ring"},
    std::pair{"gearbox.planets", "--planets"},
    std::pair{"gearbox.normal_module_mm", "--module"},
    std::pair{"gearbox.module_mm", "--module"},
    std::pair{"gearbox.helix_angle_deg", "--helix"},
    std::pair{"gearbox.pressure_angle_deg", "--pressure-angle"},
    std::pair{"gearbox.face_width_mm", "--face-width"},
    std::pair{"gearbox.sun_shift", "--sun-shift"},
    std::pair{"gearbox.planet_shift", "--planet-shift"},
    std::pair{"gearbox.ring_shift", "--ring-shift"},
    std::pair{"gearbox.addendum_coefficient", "--addendum"},
    std::pair{"gearbox.sun_tip_mm", "--sun-tip"},
    std::pair{"gearbox.planet_tip_mm", "--planet-tip"},
    std::pair{"gearbox.ring_tip_mm", "--ring-tip"},
    std::pair{"gearbox.centre_distance_mm", "--centre-distance"},
    std::pair{"gearbox.tooth_quality", "--quality"},
    std::pair{"operation.input", "--input"},
    std::pair{"operation.torque_N_m", "--torque"},
};

// Name of the study in problems.
const std::string kName = "new planetary";

// Replaces study keys in a problem by the options that set them, because the study is not written
// yet.
Problem as_option(Problem problem) {
    problem.file = kName;
    problem.line = 0;
    if (problem.kind == ProblemKind::tooth_pairs) {
        problem.key = "--helix, --face-width";
        problem.remedy = "give narrower teeth or a smaller helix angle";
        return problem;
    }
    if (problem.kind == ProblemKind::meshing) {
        problem.remedy =
            "the options are --addendum, --centre-distance, --sun-tip, --planet-tip and --ring-tip";
    }
    const auto at = std::ranges::find_if(
        kOptions, [&](const auto& option) { return problem.key == option.first; });
    if (at != kOptions.end()) {
        problem.key = at->second;
    } else {
        problem.remedy = "the value is derived; check --module, --torque and --speed";
    }
    return problem;
}

Problems as_options(Problems problems) {
    std::ranges::transform(problems, problems.begin(), as_option);
    return problems;
}

// Tooth number of the ring for standard gears. The tooth numbers are not checked yet.
int default_ring_teeth(const PlanetaryDatasheet& data) {
    constexpr std::int64_t kMost = 1 << 30;
    return static_cast<int>(std::clamp(data.sun + 2 * std::int64_t{data.planet}, -kMost, kMost));
}

// Default face width, rounded to whole millimetres from 10 mm. Any number if the module is invalid.
double default_width_mm(const PlanetaryDatasheet& data) {
    const double width = 1e3 * default_face_width_m(1e-3 * data.module_mm);
    return !(width > 0.0) || !std::isfinite(width) ? 1.0 : width < 10.0 ? width : std::round(width);
}

// Input torque and speed from two of torque, speed and power.
InputLoad load_of(const PlanetaryDatasheet& data) {
    constexpr double kRadPerS = std::numbers::pi / 30.0;
    const double power_W = 1e3 * data.power_kW.value_or(0.0);
    return {data.torque_N_m.value_or(power_W / (kRadPerS * data.speed_rpm.value_or(1.0))),
            data.speed_rpm.value_or(power_W / (kRadPerS * data.torque_N_m.value_or(1.0)))};
}

Problems load_problems(const PlanetaryDatasheet& data) {
    Problems problems;
    const int given = int{data.torque_N_m.has_value()} + int{data.speed_rpm.has_value()} +
                      int{data.power_kW.has_value()};
    if (given != 2) {
        problems.push_back({kName, 0, "--torque, --speed, --power",
                            fmt::format("{} of the three are given", given),
                            "give exactly two of them, for the " + data.input});
    }
    for (const auto& [option, value] :
         {std::pair{"--torque", data.torque_N_m}, std::pair{"--speed", data.speed_rpm},
          std::pair{"--power", data.power_kW}}) {
        if (value && !(*value > 0.0 && std::isfinite(*value))) {
            problems.push_back(
                {kName, 0, option, fmt::format("must be > 0, but is {:g}", *value), ""});
        }
    }
    return problems;
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
    const auto height = [](const gears::Gear& g) {
        return std::abs(g.tip_radius() - g.root_radius());
    };
    const auto bore_radius = [&](const gears::Gear& g) {
        return std::max(g.root_radius() - default_rim_m(height(g)),
                        kMinBoreRatio * g.root_radius());
    };
    d.centre_distance_m = distance;
    d.sun_body = {sun.pitch_radius(), bore_radius(sun), width};
    d.planet_body = {planet.pitch_radius(), bore_radius(planet), width};
    d.ring_body = {ring.root_radius() + 3.0 * height(ring), ring.pitch_radius(), width};
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
    const gears::PowerFlow flow{gears::FixedMember::ring, input};
    d.torques = gears::balanced_torques(train, input, load.torque_N_m);
    d.mesh_frequency_Hz = gears::mesh_frequency(
        train, gears::signed_speeds(train, flow, input, load.speed_rpm / 60.0));
    d.pin_load_N = std::abs(d.torques.carrier) / (data.planets * distance);
    d.deepest_crack_m = max_crack_depth_m(study);
    return d;
}

}  // namespace

NewStudy new_planetary(const PlanetaryDatasheet& data, const std::string& command) {
    const NominalGears gears{data, data.ring ? *data.ring : default_ring_teeth(data),
                             data.face_width_mm ? *data.face_width_mm : default_width_mm(data)};
    Problems problems = load_problems(data);
    const StudyReading teeth = read_study_text(minimal_study(gears), kName);
    std::ranges::move(as_options(teeth.problems), std::back_inserter(problems));
    if (!teeth.study || !problems.empty()) {
        return {"", problems};
    }
    const InputLoad load = load_of(data);
    const std::string text = planetary_text(gears, derive(*teeth.study, data, load), load, command);
    // Reading finds values out of range; building the scene finds all other problems.
    problems = as_options(make_scene(kName, read_study_text(text, kName)).problems);
    return problems.empty() ? NewStudy{text, {}} : NewStudy{"", problems};
}

}  // namespace gearpod::mc
