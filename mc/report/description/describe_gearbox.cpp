#include "mc/report/description/describe_gearbox.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <vector>

#include "mc/ensemble/gearbox/other_sources.hpp"
#include "mc/plan/drivetrain.hpp"
#include "mc/plan/instance_inputs.hpp"
#include "mc/plan/mesh_loads.hpp"
#include "mc/report/description/terminal_text.hpp"
#include "mc/study/faults/fault_kind.hpp"
#include "mc/study/gears.hpp"
#include "mc/study/housing.hpp"
#include "stiffness/iso_6336.hpp"

namespace gearpod::mc {
namespace {

std::string joined(const std::vector<std::string>& texts) {
    return fmt::format("{}", fmt::join(texts, " "));
}

// Formats a number with six figures, which hides rounding errors of unit conversions and the sign
// of zero.
std::string figures(double value) {
    return fmt::format("{:.6g}", value == 0.0 ? 0.0 : value);
}

std::string rpm_text(double rad_s) {
    return figures(rad_s * 30.0 / std::numbers::pi) + " rpm";
}

// Prints nominal speed and torque of every member. Speeds are positive in the input's direction of
// rotation; torques are magnitudes.
void print_planetary_members(const Study& study) {
    const gears::PlanetaryTrain train = planetary_train(study);
    const InstanceInputs nominal = nominal_inputs(study);
    const gears::PowerFlow flow{study.operation.fixed, study.operation.input};
    const gears::Speeds turning =
        gears::signed_speeds(train, flow, speed_member(study), nominal.speed_rad_s);
    const gears::CentralMembers torque =
        gears::balanced_torques(train, study.operation.torque_on, nominal.torque_N_m);
    const double sense = gears::speed_of(turning, flow.input) < 0.0 ? -1.0 : 1.0;
    const auto print = [&](Member member, double speed, double load) {
        const bool held = member == study.operation.fixed;
        const char* role = held ? "fixed" : member == study.operation.input ? "input" : "output";
        print_entry(std::string(member_name(member)),
                    fmt::format("{}, {} N m ({})", held ? "stationary" : rpm_text(sense * speed),
                                figures(std::abs(load)), role));
    };
    print(Member::sun, turning.sun, torque.sun);
    const double pin_N = std::abs(torque.carrier) / (train.planets * centre_distance_m(study));
    print_entry("planets",
                fmt::format("{}, {} relative to the carrier, {:.4g} kN on each pin",
                            rpm_text(sense * turning.planet),
                            rpm_text(sense * (turning.planet - turning.carrier)), 1e-3 * pin_N));
    print(Member::ring, turning.ring, torque.ring);
    print(Member::carrier, turning.carrier, torque.carrier);
}

void print_members(const Study& study) {
    if (study.gearbox.kind == GearboxKind::planetary) {
        print_planetary_members(study);
        return;
    }
    const InstanceInputs nominal = nominal_inputs(study);
    const double ratio =
        static_cast<double>(*teeth_of(study, Member::pinion)) / *teeth_of(study, Member::gear);
    print_entry("pinion", fmt::format("{}, {} N m (input)", rpm_text(nominal.speed_rad_s),
                                      figures(nominal.torque_N_m)));
    print_entry("gear", fmt::format("{}, {} N m (output)", rpm_text(-ratio * nominal.speed_rad_s),
                                    figures(nominal.fixed_shaft.load_torque_N_m)));
}

// Prints fault sizes in the unit of the study, and as fractions of the largest possible size (for a
// crack, the whole way through the tooth root).
void print_fault_sizes(const Scene& scene) {
    const FaultPlan& fault = scene.fault().plan();
    if (fault.sizes.empty()) {
        return;
    }
    const Unit& unit = fault.unit();
    const double largest = scene.fault().largest_size();
    std::vector<std::string> sizes, shares;
    for (const double size : fault.sizes) {
        sizes.push_back(figures(size / unit.to_si));
        shares.push_back(fmt::format("{:.3g}", 100.0 * size / largest));
    }
    std::string text = fmt::format("{}{}", fault.groups ? "random, in groups with the edges " : "",
                                   fmt::join(sizes, ", "));
    if (!unit.suffix.empty()) {
        text += fmt::format(" {}", unit.name);
    }
    if (!unit.suffix.empty() && largest > 0.0) {
        text += fmt::format("; {} % of the largest possible size, {:.4g} {}",
                            fmt::join(shares, ", "), largest / unit.to_si, unit.name);
    }
    print_entry("fault sizes", text);
    print_entry("fault origin", fault.origin);
}

void print_planetary(const PlanetaryDrivetrain& drivetrain) {
    const auto& train = drivetrain.train();
    print_entry("teeth (sun/planet/ring)",
                fmt::format("{}/{}/{}, {} planets", train.sun_teeth, train.planet_teeth,
                            train.ring_teeth, train.planets));
    std::vector<std::string> sun, ring;
    for (int n = 0; n < train.planets; ++n) {
        sun.push_back(fmt::format("{:.4g}", gears::sun_mesh_phase(train, n, drivetrain.sense())));
        ring.push_back(fmt::format("{:.4g}", gears::ring_mesh_phase(train, n, drivetrain.sense())));
    }
    if (!train.positions_rad.empty()) {
        const gears::PlanetPlaces places = gears::planet_places(train);
        std::vector<std::string> positions;
        for (int n = 0; n < train.planets; ++n) {
            positions.push_back(
                fmt::format("{:.6g}", gears::planet_angle(places, n) * 180.0 / std::numbers::pi));
        }
        print_entry("planet positions", joined(positions) + " deg");
    }
    print_entry("mesh phases, sun", joined(sun));
    print_entry("mesh phases, ring", fmt::format("{}; ring relative to sun {:g}", joined(ring),
                                                 drivetrain.ring_to_sun_phase()));
}

void print_fixed_shaft(const Study& study) {
    const int pinion = *teeth_of(study, Member::pinion), gear = *teeth_of(study, Member::gear);
    print_entry("teeth (pinion/gear)", fmt::format("{}/{}", pinion, gear));
    const InstanceInputs nominal = nominal_inputs(study);
    const double balanced = nominal.torque_N_m * gear / pinion;
    const double load = nominal.fixed_shaft.load_torque_N_m;
    if (std::abs(load - balanced) > 1e-6 * balanced) {
        print_entry("torques out of balance",
                    fmt::format("the load torque is {:g} N m, but {:.4g} N m would balance the "
                                "motor; the mean speed is kept, and the difference only changes "
                                "the vibration",
                                load, balanced));
    }
}

// Warns of contact below the form circle, where a rack-generated tooth has a fillet instead of an
// involute.
void print_fillet_warnings(const MeshMembers& members, const gears::MeshGeometry& mesh) {
    for (const int which : {1, 2}) {
        const gears::Gear& gear = mesh.gear(which);
        const double lowest = mesh.contact_radius(which, which == 1 ? 0.0 : mesh.contact_ratio());
        if (!gear.internal && lowest < gear.form_radius()) {
            print_entry("fillet interference",
                        fmt::format("contact on the {} reaches down to a diameter of {:.4f} mm, "
                                    "but its fillet begins at {:.4f} mm; shorter teeth of the "
                                    "mating gear avoid this",
                                    member_name(which == 1 ? members.member_1 : members.member_2),
                                    2e3 * lowest, 2e3 * gear.form_radius()));
        }
    }
}

// Prints profile shifts and the geometry that follows from them; nothing for standard gears.
void print_shifts(const Scene& scene) {
    const Study& study = scene.study();
    if (!shift_given(study)) {
        return;
    }
    std::string shifts;
    for (const Member member : kAllMembers) {
        if (has_toothed_member(study.gearbox.kind, member)) {
            const gears::Gear gear = gear_of(study, member);
            shifts += fmt::format(
                "{}{} {:.4f}, tip diameter {:.4f} mm ({:.3f} mm thick)", shifts.empty() ? "" : "; ",
                member_name(member), gear.profile_shift / normal_over_transverse(study.gearbox),
                2e3 * gear.tip_radius(), 1e3 * gear.thickness_at(gear.tip_radius()));
        }
    }
    print_entry("profile shifts", shifts);
    print_entry("centre distance", fmt::format("{:.6g} mm", 1e3 * centre_distance_m(study)));
    for (const SceneMesh& mesh : scene.meshes()) {
        if (mesh.geometry) {
            const gears::MeshGeometry& g = *mesh.geometry;
            print_entry(mesh_name(mesh.members) + " geometry",
                        fmt::format("working pressure angle {:.4f} deg, backlash {:.4f} mm, tip "
                                    "clearances {:.3f} and {:.3f} mm",
                                    g.working_pressure_angle() * 180.0 / std::numbers::pi,
                                    1e3 * g.backlash(), 1e3 * g.tip_clearance(1),
                                    1e3 * g.tip_clearance(2)));
            print_fillet_warnings(mesh.members, g);
        }
    }
}

// Prints how much stiffer than the standard's value a mesh with rigid gear bodies is.
void print_rigid_bodies(const Scene& scene) {
    const Study& study = scene.study();
    if (study.effects.foundation != Foundation::none || stiffness_given(study)) {
        return;
    }
    std::vector<std::string> ratios;
    for (const SceneMesh& mesh : scene.meshes()) {
        const auto standard = stiffness::iso_6336_stiffness(
            *mesh.geometry, study.gearbox.helix_angle_rad, material_of(study, mesh.members));
        ratios.push_back(mesh_name(mesh.members) +
                         (standard
                              ? fmt::format(" {:.2f}", mean_total(*mesh.stiffness) / standard->mesh)
                              : " about 2.0 to 2.5"));
    }
    print_entry("rigid gear bodies",
                fmt::format("mesh stiffness too high: {} times the mean of ISO 6336-1, method B; "
                            "effects.foundation = \"elastic-ring\" adds elastic gear bodies "
                            "(docs/validation/mesh-stiffness-level.md)",
                            fmt::join(ratios, ", ")));
}

// Prints load and nominal stresses of each mesh, and warnings of torques that cannot be meant.
void print_loads(const Study& study) {
    bool stressed = false;
    for (const MeshLoad& load : mesh_loads(study)) {
        print_entry(mesh_name(load.members) + " load", load_text(load));
        stressed = stressed || load.stress;
    }
    if (stressed) {
        print_entry("stresses",
                    fmt::format("nominal ones of ISO 6336, method B, at the nominal torque{}; "
                                "without factors for application, dynamics and load distribution",
                                study.gearbox.kind == GearboxKind::planetary
                                    ? ", shared evenly by the planets"
                                    : ""));
    }
    for (const Problem& warning : load_warnings(study, "")) {
        print_entry("check the torque", fmt::format("{}; {}", warning.what, warning.remedy));
    }
}

}  // namespace

std::string contact_ratio_text(const stiffness::MeshStiffness& mesh) {
    const double nominal = mesh.path_end() - mesh.path_begin();
    const double transverse = mesh.slice().path_end() - mesh.slice().path_begin();
    std::string text = fmt::format("{:.4f}", nominal);
    if (transverse < nominal - 1e-9) {
        text +=
            fmt::format(" (transverse {:.4f}, overlap {:.4f})", transverse, nominal - transverse);
    }
    if (nominal < mesh.contact_ratio() - 1e-9) {
        text += fmt::format(", {:.4f} with corner contact", mesh.contact_ratio());
    }
    return text;
}

void print_gearbox(const Scene& scene) {
    print_heading("gearbox");
    if (const auto* planetary = dynamic_cast<const PlanetaryDrivetrain*>(&scene.drivetrain())) {
        print_planetary(*planetary);
    } else {
        print_fixed_shaft(scene.study());
    }
    print_shifts(scene);
    for (const SceneMesh& mesh : scene.meshes()) {
        print_entry(mesh_name(mesh.members) + " mesh",
                    fmt::format("contact ratio {}, mean stiffness {:.4g} N/m",
                                contact_ratio_text(*mesh.stiffness), mean_total(*mesh.stiffness)));
    }
    print_rigid_bodies(scene);
    print_entry("mesh frequency", fmt::format("{:.4f} Hz", scene.nominal_mesh_frequency_Hz()));
    print_members(scene.study());
    print_loads(scene.study());
    print_fault_sizes(scene);
}

namespace {

// Prints the impulses of a faulty bearing at nominal speed, and their vibration after the low-pass.
void print_bearing(const Scene& scene, const Bearing& bearing) {
    const InstanceInputs inputs = scene.gearbox().nominal;
    const signals::BearingImpulses impulses = bearing_impulses(scene, inputs, bearing);
    print_entry(bearing.role == SourceRole::other_fault ? "other fault" : "faulty bearing",
                fmt::format("{}: {:.3f} impulses per shaft turn, {:.4g} Hz; {:.3g} m/s^2 rms after "
                            "the low-pass, while loaded most",
                            bearing_text(bearing), impulses_per_turn(bearing), impulses.rate_Hz,
                            signals::bearing_rms(impulses, scene.study().sensor.low_pass_Hz)));
}

// Speed of a stage if it differs from that of its own study; "" if it does not.
std::string other_speed_text(const NeighbourStage& stage, const Scene& own) {
    const double factor =
        own.gearbox().nominal.speed_rad_s / nominal_inputs(*stage.study).speed_rad_s;
    return std::abs(factor - 1.0) < 1e-3
               ? ""
               : fmt::format(", {:.4g} times as fast as in its own study, as the shaft requires",
                             factor);
}

// Describes what the shaft of a stage does, with the frequency of its twist.
std::string shaft_text(const std::optional<StageShaft>& shaft) {
    return shaft
               ? fmt::format(
                     "the shaft twists by {:.3g} N m/rad: both gearboxes would turn against "
                     "each other at {:.3g} Hz with a damping ratio of {:g}; it sets the "
                     "torque of the stage{}",
                     shaft->stiffness_N_m_rad, shaft->frequency_Hz, shaft->damping_ratio,
                     shaft->mirrored ? "; its study is mirrored, since it lets the other side drive"
                                     : "")
               : "the shaft transmits no vibration (no shaft_stiffness_N_m_rad)";
}

// Prints the responses of the first sensor to the forces in bearings.
void print_bearing_responses(const Sensor& sensor) {
    for (const HousingBearing& bearing : kHousingBearings) {
        const std::string_view shaft = member_name(bearing.shaft);
        for (const HousingMode& mode : sensor.housing_modes) {
            if (mode.*bearing.per_kg != 0.0) {
                print_entry("housing mode",
                            fmt::format("{:g} Hz: a force of 1 N in the bearing of the {} gives "
                                        "{:.3g} m/s^2 at resonance",
                                        mode.frequency_Hz, shaft,
                                        std::abs(mode.*bearing.per_kg) / (2.0 * mode.damping)));
            }
        }
        if (const std::vector<double>& gain = sensor.*bearing.gain; !gain.empty()) {
            const auto largest = std::ranges::max_element(gain);
            print_entry("housing response",
                        fmt::format("a force of 1 N in the bearing of the {} gives at most {:.3g} "
                                    "m/s^2, at {:g} Hz",
                                    shaft, *largest,
                                    sensor.response_Hz[static_cast<std::size_t>(
                                        std::distance(gain.begin(), largest))]));
        }
    }
}

void print_stage(const Scene& scene, std::size_t number) {
    const NeighbourStage& stage = scene.study().sensor.stages[number];
    const Scene& own = *scene.gearbox().stages[number].plan;
    print_entry(
        "neighbouring stage",
        fmt::format(
            "\"{}\": {}; its {} on the {}{}{}; meshes at {:.4g} Hz; gain x {:g}; {}{}", stage.name,
            own.study().title, member_name(*stage.stage_shaft), member_name(*stage.shaft),
            stage.of.empty() ? "" : fmt::format(" of \"{}\"", stage.of),
            other_speed_text(stage, own), std::abs(own.nominal_mesh_frequency_Hz()), stage.gain,
            shaft_text(scene.gearbox().stages[number].shaft),
            stage.role == SourceRole::other_fault ? "; its fault is that of other_fault records"
            : stage.study->fault.kind != nullptr  ? "; its fault is left out"
                                                  : ""));
}

// Text of the measuring chain of an additional sensor, and of its noise if that has another rms
// than a multiple of the first one's.
std::string chain_text(const Study& study, const AdditionalSensor& sensor) {
    std::string text;
    if (sensor.sampling_Hz) {
        text += fmt::format("; sampling rate {:g} Hz", *sensor.sampling_Hz);
    }
    if (sensor.low_pass_Hz) {
        text += fmt::format("; low-pass {:g} Hz", *sensor.low_pass_Hz);
    }
    if (sensor.mounting_Hz) {
        text += fmt::format("; mounting resonance {:g} Hz, damping {:g}", *sensor.mounting_Hz,
                            sensor.mounting_damping);
    }
    if (sensor.delay_s != 0.0) {
        text += fmt::format("; samples {:g} s {}", std::abs(sensor.delay_s),
                            sensor.delay_s > 0.0 ? "late" : "early");
    }
    if (sensor.range_m_s2) {
        text += fmt::format("; range {:g} m/s^2", *sensor.range_m_s2);
    }
    const auto list = [&](const char* name, const std::vector<double>& values) {
        text += values.empty()
                    ? ""
                    : fmt::format("; {} of the modes {:g}", name, fmt::join(values, ", "));
    };
    list("participation", sensor.participation);
    for (const HousingBearing& bearing : kHousingBearings) {
        list(bearing.per_kg_name, sensor.*bearing.own_per_kg);
        if (const std::vector<double>& gain = sensor.*bearing.own_gain; !gain.empty()) {
            text +=
                fmt::format("; a force of 1 N in the bearing of the {} gives at most {:.3g} m/s^2",
                            member_name(bearing.shaft), std::ranges::max(gain));
        }
    }
    if (sensor.low_pass_Hz || sensor.quantisation_m_s2) {
        text += fmt::format("; noise {:.4g} m/s^2 rms times the noise level",
                            noise_at(study, sensor, noise_of(nominal_inputs(study))).all_m_s2);
    }
    return text;
}

}  // namespace

void print_sensors(const Scene& scene) {
    const Study& study = scene.study();
    if (study.effects.path != nullptr) {
        print_entry("transmission path",
                    fmt::format("{} window, exponent {:g}", study.effects.path->name,
                                study.sensor.path_exponent));
    } else {
        print_entry("sensor", fmt::format("on the {} bearing, along the line of action",
                                          member_name(study.sensor.position)));
    }
    if (study.sensor.gain != 1.0 || study.find_random("sensor.gain") != nullptr) {
        print_entry("sensor gain",
                    fmt::format("{:g} times the gearbox vibration", study.sensor.gain));
    }
    print_entry("sensor low-pass",
                fmt::format("{:g} Hz, 4th-order Butterworth", study.sensor.low_pass_Hz));
    if (study.sensor.range_m_s2) {
        print_entry("sensor range", fmt::format("samples are clipped at {:g} m/s^2 of either sign",
                                                *study.sensor.range_m_s2));
    }
    if (!study.sensor.tones.empty()) {
        print_entry("interfering tones", fmt::format("{}", study.sensor.tones.size()));
    }
    for (const HousingMode& mode : study.sensor.housing_modes) {
        print_entry("housing mode",
                    fmt::format("{:g} Hz, damping {:g}, participation {:g}: {:.3g} times the {} at "
                                "resonance",
                                mode.frequency_Hz, mode.damping, mode.participation,
                                mode.participation / (2.0 * mode.damping),
                                mode.nodal_diameters
                                    ? fmt::format("load on the ring with {} nodal diameters",
                                                  *mode.nodal_diameters)
                                    : "vibration that arrives"));
    }
    if (!study.sensor.response_Hz.empty()) {
        print_entry("housing response",
                    fmt::format("measured at {} frequencies from {:g} to {:g} Hz; nothing passes "
                                "outside",
                                study.sensor.response_Hz.size(), study.sensor.response_Hz.front(),
                                study.sensor.response_Hz.back()));
    }
    print_bearing_responses(study.sensor);
    for (const AdditionalSensor& sensor : study.sensor.additional) {
        print_entry(
            "additional sensor",
            fmt::format("\"{}\": {:g} degrees from the first one, {}, gain x {:g}, noise x "
                        "{:g}{}",
                        sensor.name, sensor.angle_deg, sensor.tangential ? "tangential" : "radial",
                        sensor.gain, sensor.noise, chain_text(study, sensor)));
    }
    for (const Bearing& bearing : study.sensor.bearings) {
        print_bearing(scene, bearing);
    }
    for (std::size_t i = 0; i < scene.gearbox().stages.size(); ++i) {
        print_stage(scene, i);
    }
}

}  // namespace gearpod::mc
