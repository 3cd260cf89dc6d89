#include "mc/plan/description.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <set>

#include "analysis/detection/threshold.hpp"
#include "analysis/report/false_alarm_text.hpp"
#include "mc/plan/ensemble_plan.hpp"
#include "mc/plan/mesh_loads.hpp"
#include "mc/plan/scene.hpp"
#include "mc/study/assumptions.hpp"
#include "mc/study/fluctuations.hpp"
#include "mc/study/gears.hpp"
#include "mc/study/schema/schema.hpp"
#include "mc/study/sensor_signal.hpp"
#include "stiffness/foundation/foundation_models.hpp"
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

// Speed of a stage if it differs from that of its study; "" if it does not.
std::string other_speed_text(const NeighbourStage& stage, const GearboxPlan& plan) {
    const double factor = plan.nominal.speed_rad_s / nominal_inputs(*stage.study).speed_rad_s;
    return std::abs(factor - 1.0) < 1e-3
               ? ""
               : fmt::format(", {:.4g} times as fast as in its own study, as the shaft requires",
                             factor);
}

// Describes what the shaft of a stage does, with the frequency of its twist.
std::string shaft_text(const std::optional<StageShaft>& shaft) {
    return shaft
               ? fmt::format(
                     "the shaft twists by {:.3g} N m/rad: both gearboxes would turn against each "
                     "other at {:.3g} Hz with a damping ratio of {:g}; it sets the torque of the "
                     "stage{}",
                     shaft->stiffness_N_m_rad, shaft->frequency_Hz, shaft->damping_ratio,
                     shaft->mirrored ? "; its study is mirrored, since it lets the other side drive"
                                     : "")
               : "the shaft transmits no vibration (no shaft_stiffness_N_m_rad)";
}

// Nominal sizes of the sinusoidal and the random part of a fluctuation.
std::string sizes(double amplitude, const std::string& rate, double rms, double band_Hz) {
    std::string text =
        rate.empty() ? "" : fmt::format("sine with {:g} of the mean, {}", amplitude, rate);
    if (band_Hz > 0.0) {
        text += fmt::format("{}noise with {:g} rms of the mean, up to {:g} Hz",
                            text.empty() ? "" : "; ", rms, band_Hz);
    }
    return text;
}

class Describer {
  public:
    Describer(const Study& study, const GearboxPlan& gearbox, double decay_meshes)
        : study_(study), gearbox_(gearbox), decay_meshes_(decay_meshes) {}

    std::vector<DescriptionSection> sections() && {
        begin("gearbox");
        add_gearbox();
        begin("effects simulated");
        add_simulated();
        begin("effects omitted");
        add_omitted();
        return std::move(sections_);
    }

  private:
    void begin(const char* heading) { sections_.push_back({heading, {}}); }
    // Adds an entry, or a paragraph if its name is empty.
    template <class... Values>
    void add(std::string name, fmt::format_string<Values...> text, Values&&... values) {
        sections_.back().entries.push_back(
            {std::move(name), fmt::format(text, std::forward<Values>(values)...)});
    }
    template <class... Values>
    void add_if(bool condition, std::string name, fmt::format_string<Values...> text,
                Values&&... values) {
        if (condition) {
            add(std::move(name), text, std::forward<Values>(values)...);
        }
    }
    bool is_random(const std::string& key) const { return study_.find_random(key) != nullptr; }

    // Adds nominal speed and torque of every member. Speeds are positive in the input's direction
    // of rotation; torques are magnitudes.
    void add_planetary_members() {
        const gears::PlanetaryTrain train = planetary_train(study_);
        const gears::PowerFlow flow{study_.operation.fixed, study_.operation.input};
        const gears::Speeds turning =
            gears::signed_speeds(train, flow, speed_member(study_), gearbox_.nominal.speed_rad_s);
        const gears::CentralMembers torque =
            gears::balanced_torques(train, study_.operation.torque_on, gearbox_.nominal.torque_N_m);
        const double sense = gears::speed_of(turning, flow.input) < 0.0 ? -1.0 : 1.0;
        const auto print = [&](Member member, double speed, double load) {
            const bool held = member == study_.operation.fixed;
            const char* role = held                               ? "fixed"
                               : member == study_.operation.input ? "input"
                                                                  : "output";
            add(std::string(member_name(member)), "{}, {} N m ({})",
                held ? "stationary" : rpm_text(sense * speed), figures(std::abs(load)), role);
        };
        print(Member::sun, turning.sun, torque.sun);
        const double pin_N = std::abs(torque.carrier) / (train.planets * centre_distance_m(study_));
        add("planets", "{}, {} relative to the carrier, {:.4g} kN on each pin",
            rpm_text(sense * turning.planet), rpm_text(sense * (turning.planet - turning.carrier)),
            1e-3 * pin_N);
        print(Member::ring, turning.ring, torque.ring);
        print(Member::carrier, turning.carrier, torque.carrier);
    }

    void add_members() {
        if (study_.gearbox.kind == GearboxKind::planetary) {
            add_planetary_members();
            return;
        }
        const double ratio = static_cast<double>(*teeth_of(study_, Member::pinion)) /
                             *teeth_of(study_, Member::gear);
        add("pinion", "{}, {} N m (input)", rpm_text(gearbox_.nominal.speed_rad_s),
            figures(gearbox_.nominal.torque_N_m));
        add("gear", "{}, {} N m (output)", rpm_text(-ratio * gearbox_.nominal.speed_rad_s),
            figures(gearbox_.nominal.fixed_shaft.load_torque_N_m));
    }

    // Adds fault sizes in the unit of the study, and as fractions of the largest possible size (for
    // a crack, the whole way through the tooth root).
    void add_fault_sizes() {
        const FaultPlan& fault = gearbox_.fault().plan();
        if (fault.sizes.empty()) {
            return;
        }
        const Unit& unit = fault.unit();
        const double largest = gearbox_.fault().largest_size();
        std::vector<std::string> sizes, shares;
        for (const double size : fault.sizes) {
            sizes.push_back(figures(size / unit.to_si));
            shares.push_back(fmt::format("{:.3g}", 100.0 * size / largest));
        }
        std::string text =
            fmt::format("{}{}", fault.groups ? "random, in groups with the edges " : "",
                        fmt::join(sizes, ", "));
        if (!unit.suffix.empty()) {
            text += fmt::format(" {}", unit.name);
        }
        if (!unit.suffix.empty() && largest > 0.0) {
            text += fmt::format("; {} % of the largest possible size, {:.4g} {}",
                                fmt::join(shares, ", "), largest / unit.to_si, unit.name);
        }
        add("fault sizes", "{}", text);
        add("fault origin", "{}", fault.origin);
    }

    void add_planetary(const PlanetaryDrivetrain& drivetrain) {
        const auto& train = drivetrain.train();
        add("teeth (sun/planet/ring)", "{}/{}/{}, {} planets", train.sun_teeth, train.planet_teeth,
            train.ring_teeth, train.planets);
        std::vector<std::string> sun, ring;
        for (PlanetId n{0}; n < train.planets; ++n) {
            sun.push_back(
                fmt::format("{:.4g}", gears::sun_mesh_phase(train, n, drivetrain.sense())));
            ring.push_back(
                fmt::format("{:.4g}", gears::ring_mesh_phase(train, n, drivetrain.sense())));
        }
        if (!train.positions_rad.empty()) {
            const gears::PlanetPositions planets = gears::planet_positions(train);
            std::vector<std::string> positions;
            for (PlanetId n{0}; n < train.planets; ++n) {
                positions.push_back(fmt::format(
                    "{:.6g}", gears::planet_angle(planets, n) * 180.0 / std::numbers::pi));
            }
            add("planet positions", "{}", joined(positions) + " deg");
        }
        add("mesh phases, sun", "{}", joined(sun));
        add("mesh phases, ring", "{}; ring relative to sun {:g}", joined(ring),
            drivetrain.ring_to_sun_phase());
    }

    void add_fixed_shaft() {
        const int pinion = *teeth_of(study_, Member::pinion),
                  gear = *teeth_of(study_, Member::gear);
        add("teeth (pinion/gear)", "{}/{}", pinion, gear);
        const double balanced = gearbox_.nominal.torque_N_m * gear / pinion;
        const double load = gearbox_.nominal.fixed_shaft.load_torque_N_m;
        if (std::abs(load - balanced) > 1e-6 * balanced) {
            add("torques out of balance",
                "the load torque is {:g} N m, but {:.4g} N m would balance the motor; the mean "
                "speed is kept, and the difference only changes the vibration",
                load, balanced);
        }
    }

    // Adds warnings of contact below the form circle, where a rack-generated tooth has a fillet
    // instead of an involute.
    void add_fillet_warnings(const MeshMembers& members, const gears::MeshGeometry& mesh) {
        for (const int which : {1, 2}) {
            const gears::Gear& gear = mesh.gear(which);
            const double lowest =
                mesh.contact_radius(which, which == 1 ? 0.0 : mesh.contact_ratio());
            if (!gear.internal && lowest < gear.form_radius()) {
                add("fillet interference",
                    "contact on the {} reaches down to a diameter of {:.4f} mm, but its fillet "
                    "begins at {:.4f} mm; shorter teeth of the mating gear avoid this",
                    member_name(which == 1 ? members.member_1 : members.member_2), 2e3 * lowest,
                    2e3 * gear.form_radius());
            }
        }
    }

    // Adds profile shifts and the geometry that follows from them; nothing for standard gears.
    void add_shifts() {
        if (!shift_given(study_)) {
            return;
        }
        std::string shifts;
        for (const Member member : kAllMembers) {
            if (has_toothed_member(study_.gearbox.kind, member)) {
                const gears::Gear gear = gear_of(study_, member);
                shifts += fmt::format("{}{} {:.4f}, tip diameter {:.4f} mm ({:.3f} mm thick)",
                                      shifts.empty() ? "" : "; ", member_name(member),
                                      gear.profile_shift / normal_over_transverse(study_.gearbox),
                                      2e3 * gear.tip_radius(),
                                      1e3 * gear.thickness_at(gear.tip_radius()));
            }
        }
        add("profile shifts", "{}", shifts);
        add("centre distance", "{:.6g} mm", 1e3 * centre_distance_m(study_));
        for (const SceneMesh& mesh : gearbox_.stiffness->meshes()) {
            if (mesh.geometry) {
                const gears::MeshGeometry& g = *mesh.geometry;
                add(mesh_name(mesh.members) + " geometry",
                    "working pressure angle {:.4f} deg, backlash {:.4f} mm, tip clearances {:.3f} "
                    "and {:.3f} mm",
                    g.working_pressure_angle() * 180.0 / std::numbers::pi, 1e3 * g.backlash(),
                    1e3 * g.tip_clearance(1), 1e3 * g.tip_clearance(2));
                add_fillet_warnings(mesh.members, g);
            }
        }
    }

    // Adds how much stiffer than the standard's value a mesh with rigid gear bodies is.
    void add_rigid_bodies() {
        if (study_.effects.foundation != Foundation::none || stiffness_given(study_)) {
            return;
        }
        std::vector<std::string> ratios;
        for (const SceneMesh& mesh : gearbox_.stiffness->meshes()) {
            const auto standard = stiffness::iso_6336_stiffness(
                *mesh.geometry, study_.gearbox.helix_angle_rad, material_of(study_, mesh.members));
            ratios.push_back(
                mesh_name(mesh.members) +
                (standard ? fmt::format(" {:.2f}", mean_total(*mesh.stiffness) / standard->mesh)
                          : " about 2.0 to 2.5"));
        }
        add("rigid gear bodies",
            "mesh stiffness too high: {} times the mean of ISO 6336-1, method B; "
            "effects.foundation = \"elastic-ring\" adds elastic gear bodies "
            "(docs/validation/mesh-stiffness-level.md)",
            fmt::join(ratios, ", "));
    }

    // Adds load and nominal stresses of each mesh, and warnings of torques that cannot be meant.
    void add_loads() {
        bool stressed = false;
        for (const MeshLoad& load : mesh_loads(study_)) {
            add(mesh_name(load.members) + " load", "{}", load_text(load));
            stressed = stressed || load.stress;
        }
        if (stressed) {
            add("stresses",
                "nominal ones of ISO 6336, method B, at the nominal torque{}; without factors for "
                "application, dynamics and load distribution",
                study_.gearbox.kind == GearboxKind::planetary ? ", shared evenly by the planets"
                                                              : "");
        }
        for (const Problem& warning : load_warnings(study_, "")) {
            add("check the torque", "{}; {}", warning.what, warning.remedy);
        }
    }

    void add_gearbox() {
        if (const auto* planetary =
                dynamic_cast<const PlanetaryDrivetrain*>(gearbox_.drivetrain.get())) {
            add_planetary(*planetary);
        } else {
            add_fixed_shaft();
        }
        add_shifts();
        for (const SceneMesh& mesh : gearbox_.stiffness->meshes()) {
            const double mean_N_m = mean_total(*mesh.stiffness);
            add(mesh_name(mesh.members) + " mesh", "contact ratio {}, mean stiffness {:.4g} N/m{}",
                contact_ratio_text(*mesh.stiffness), mean_N_m,
                study_.gearbox.face_width_m
                    ? fmt::format(", {:.3g} N/(mm um) of face width",
                                  1e-9 * mean_N_m / *study_.gearbox.face_width_m)
                    : "");
        }
        add_rigid_bodies();
        add("mesh frequency", "{:.4f} Hz", gearbox_.mesh_frequency_Hz);
        add_members();
        add_loads();
        add_fault_sizes();
    }

    // Adds the impulses of a faulty bearing at nominal speed, and their vibration after the
    // low-pass.
    void add_bearing(const Bearing& bearing) {
        const signals::BearingImpulses impulses =
            bearing_impulses(gearbox_, gearbox_.nominal, bearing);
        add(bearing.role == SourceRole::other_fault ? "other fault" : "faulty bearing",
            "{}: {:.3f} impulses per shaft turn, {:.4g} Hz; {:.3g} m/s^2 rms after the low-pass, "
            "while loaded most",
            bearing_text(bearing), impulses_per_turn(bearing), impulses.rate_Hz,
            signals::bearing_rms(impulses, study_.sensor.low_pass_Hz));
    }

    void add_bearing_responses(const Sensor& sensor) {
        for (const HousingBearing& bearing : kHousingBearings) {
            const std::string_view shaft = member_name(bearing.shaft);
            for (const HousingMode& mode : sensor.housing_modes) {
                if (mode.*bearing.per_kg != 0.0) {
                    add("housing mode",
                        "{:g} Hz: a force of 1 N in the bearing of the {} gives {:.3g} m/s^2 at "
                        "resonance",
                        mode.frequency_Hz, shaft,
                        std::abs(mode.*bearing.per_kg) / (2.0 * mode.damping));
                }
            }
            if (const std::vector<double>& gain = sensor.*bearing.gain; !gain.empty()) {
                const auto largest = std::ranges::max_element(gain);
                add("housing response",
                    "a force of 1 N in the bearing of the {} gives at most {:.3g} m/s^2, at {:g} "
                    "Hz",
                    shaft, *largest,
                    sensor.response_Hz[static_cast<std::size_t>(
                        std::distance(gain.begin(), largest))]);
            }
        }
    }

    void add_stage(std::size_t number) {
        const NeighbourStage& stage = study_.sensor.stages[number];
        const StagePlan& planned = gearbox_.stages[number];
        const GearboxPlan& gearbox = *planned.gearbox;
        add("neighbouring stage",
            "\"{}\": {}; its {} on the {}{}{}; meshes at {:.4g} Hz; gain x {:g}; {}{}", stage.name,
            stage.study->title, member_name(*stage.stage_shaft), member_name(*stage.shaft),
            stage.of.empty() ? "" : fmt::format(" of \"{}\"", stage.of),
            other_speed_text(stage, gearbox), std::abs(gearbox.mesh_frequency_Hz), stage.gain,
            shaft_text(planned.shaft),
            stage.role == SourceRole::other_fault ? "; its fault is that of other_fault records"
            : stage.study->fault.kind != nullptr  ? "; its fault is left out"
                                                  : "");
    }

    // Text of the measuring chain of an additional sensor, and of its noise if that has another rms
    // than a multiple of the first one's.
    std::string chain_text(const AdditionalSensor& sensor) {
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
                text += fmt::format(
                    "; a force of 1 N in the bearing of the {} gives at most {:.3g} m/s^2",
                    member_name(bearing.shaft), std::ranges::max(gain));
            }
        }
        if (sensor.low_pass_Hz || sensor.quantisation_m_s2) {
            text +=
                fmt::format("; noise {:.4g} m/s^2 rms times the noise level",
                            noise_stage(study_, &sensor).of(noise_of(gearbox_.nominal)).all_m_s2);
        }
        return text;
    }

    void add_sensors() {
        if (study_.effects.path != nullptr) {
            add("transmission path", "{} window, exponent {:g}", study_.effects.path->name,
                study_.sensor.path_exponent);
        } else {
            add("sensor", "on the {} bearing, along the line of action",
                member_name(study_.sensor.position));
        }
        add_if(study_.sensor.gain != 1.0 || is_random("sensor.gain"), "sensor gain",
               "{:g} times the gearbox vibration", study_.sensor.gain);
        if (study_.sensor.cross_axis_percent) {
            add("cross-axis sensitivity", "{:g} % of the acceleration at right angles to the axis",
                *study_.sensor.cross_axis_percent);
        }
        add("sensor low-pass", "{:g} Hz, 4th-order Butterworth", study_.sensor.low_pass_Hz);
        if (study_.sensor.range_m_s2) {
            add("sensor range", "samples are clipped at {:g} m/s^2 of either sign",
                *study_.sensor.range_m_s2);
        }
        add_if(!study_.sensor.tones.empty(), "interfering tones", "{}", study_.sensor.tones.size());
        for (const HousingMode& mode : study_.sensor.housing_modes) {
            add("housing mode",
                "{:g} Hz, damping {:g}, participation {:g}: {:.3g} times the {} at resonance",
                mode.frequency_Hz, mode.damping, mode.participation,
                mode.participation / (2.0 * mode.damping),
                mode.nodal_diameters
                    ? fmt::format("load on the ring with {} nodal diameters", *mode.nodal_diameters)
                    : "vibration that arrives");
        }
        if (!study_.sensor.response_Hz.empty()) {
            add("housing response",
                "measured at {} frequencies from {:g} to {:g} Hz; nothing passes outside",
                study_.sensor.response_Hz.size(), study_.sensor.response_Hz.front(),
                study_.sensor.response_Hz.back());
        }
        add_bearing_responses(study_.sensor);
        for (const AdditionalSensor& sensor : study_.sensor.additional) {
            add("additional sensor",
                "\"{}\": {:g} degrees from the first one, {}, gain x {:g}, noise x {:g}{}",
                sensor.name, sensor.angle_deg, sensor.tangential ? "tangential" : "radial",
                sensor.gain, sensor.noise, chain_text(sensor));
        }
        for (const Bearing& bearing : study_.sensor.bearings) {
            add_bearing(bearing);
        }
        for (std::size_t i = 0; i < gearbox_.stages.size(); ++i) {
            add_stage(i);
        }
    }

    // True if the damping is 0 in every gearbox. Random values are never 0.
    bool none(const std::string& key, double nominal) { return nominal == 0.0 && !is_random(key); }

    bool no_mesh_damping(double nominal) {
        return dynamics::with_mesh_damping(study_.effects.mesh_damping, [&](auto law) {
            return none("gearbox." + std::string(law.kParameter.key), nominal);
        });
    }

    std::string undamped() {
        if (study_.effects.quasi_static()) {
            return "";
        }
        const Gearbox& g = study_.gearbox;
        const FixedShaft& f = study_.fixed_shaft;
        const bool planetary = g.kind == GearboxKind::planetary;
        std::vector<std::string> parts, bearings;
        const auto add_part = [&](bool undamped, const std::string& part) {
            if (undamped) {
                parts.push_back(part);
            }
        };
        add_part(no_mesh_damping(gearbox_.nominal.mesh_damping), "meshes");
        for (const Member member :
             planetary ? std::vector{Member::sun, Member::planet, Member::ring, Member::carrier}
                       : std::vector{Member::pinion, Member::gear}) {
            const std::string name(member_name(member));
            if (!study_.effects.torsional() && none(member_key(member, "bearing_damping_N_s_m"),
                                                    g.bodies[member].bearing_damping_N_s_m)) {
                bearings.push_back(name);
            }
        }
        add_part(!bearings.empty(), fmt::format("bearings of {}", fmt::join(bearings, " and ")));
        add_part(planetary && none("gearbox.support_damping_N_s_m", g.support_damping_N_s_m),
                 fmt::format("support of the {}", member_name(study_.operation.fixed)));
        add_part(!planetary && none("gearbox.motor_coupling_damping_N_m_s_rad",
                                    f.motor_coupling_damping_N_m_s_rad),
                 "motor coupling");
        add_part(!planetary && none("gearbox.load_coupling_damping_N_m_s_rad",
                                    f.load_coupling_damping_N_m_s_rad),
                 "load coupling");
        return fmt::format("{}", fmt::join(parts, ", "));
    }

    void add_motion() {
        const Effects& e = study_.effects;
        std::string text = e.torsional() ? "rotation only (rigid bearings)" : "x, y and rotation";
        if (e.quasi_static()) {
            text += ", quasi-static: equilibrium without inertia at every sample";
        }
        add("motion", "{}", text);
        if (!e.quasi_static()) {
            add("mesh damping", "{}",
                dynamics::with_mesh_damping(e.mesh_damping, [](auto law) { return law.kText; }));
        }
        if (study_.gearbox.kind == GearboxKind::planetary && e.inertial_terms && !e.torsional()) {
            add("inertial terms", "{}",
                e.quasi_static() ? "centrifugal force"
                                 : "Coriolis and centrifugal; rigid-body rotation is removed after "
                                   "every mesh period");
        }
    }

    // Adds warnings of gears outside the range for which their foundation model was fitted.
    void add_foundation_warnings() {
        std::set<Member> members;
        for (const MeshMembers& mesh : meshes_of(study_.gearbox.kind)) {
            members.insert({mesh.member_1, mesh.member_2});
        }
        for (const Member member : members) {
            for (const std::string& warning : stiffness::foundation_warnings(
                     gear_of(study_, member), profile_of(study_), study_.effects.foundation,
                     body_radius_m(study_, member))) {
                add("", "warning: {}: {}", member_name(member), warning);
            }
        }
    }

    // Adds the stiffness factor of rim and web, for example
    // "sun-planet mesh stiffness times 0.84 (C_R of ISO 6336-1: sun 0.84)".
    void add_blanks() {
        for (const MeshMembers& mesh : meshes_of(study_.gearbox.kind)) {
            std::vector<std::string> blanks;
            for (const Member member : {mesh.member_1, mesh.member_2}) {
                if (study_.gearbox.bodies[member].web_m) {
                    blanks.push_back(fmt::format("{} {:.4g}", member_name(member),
                                                 blank_factor(study_, member)));
                }
            }
            if (!blanks.empty()) {
                add("rim and web", "{} mesh stiffness times {:.4g} (C_R of ISO 6336-1: {})",
                    mesh_name(mesh), blank_factor(study_, mesh), fmt::join(blanks, ", "));
            }
        }
    }

    // Adds the rms of an error of the teeth or of the planets' pins.
    void add_rms(const char* key, double rms_m, const char* what, std::vector<std::string>& parts) {
        if (is_random(key)) {
            parts.push_back(fmt::format("{} random", what));
        } else if (rms_m > 0.0) {
            parts.push_back(fmt::format("{} {:g} um rms", what, 1e6 * rms_m));
        }
    }

    // Lists the tooth errors, for example "ISO 1328 grade 6, ring 8; pitch 2 um rms".
    std::string tooth_errors() {
        const ToothErrors& e = study_.errors;
        std::vector<std::string> parts, members;
        for (const Member member : kAllMembers) {
            if (const auto& grade = study_.gearbox.bodies[member].quality) {
                members.push_back(fmt::format("{} {:g}", member_name(member), *grade));
            }
        }
        if (has_tooth_quality(study_)) {
            const std::string all = is_random("gearbox.tooth_quality") ? "random"
                                    : e.tooth_quality ? fmt::format("{:g}", *e.tooth_quality)
                                                      : "";
            parts.push_back(fmt::format("ISO 1328 grade {}{}{}", all,
                                        members.empty() || all.empty() ? "" : ", ",
                                        fmt::join(members, ", ")));
        }
        if (has_measured_teeth(study_)) {
            parts.push_back("measured index deviations");
        }
        add_rms("gearbox.pitch_error_um", e.pitch_error_m, "pitch", parts);
        add_rms("gearbox.eccentricity_um", e.eccentricity_m, "eccentricity", parts);
        return fmt::format("{}", fmt::join(parts, "; "));
    }

    std::string unequal_planets_text() {
        const PlanetDifferences& p = study_.planets;
        std::vector<std::string> parts;
        for (const auto& [list, what] : {std::pair{&p.pin_tangential_m, "tangential pin errors"},
                                         std::pair{&p.pin_radial_m, "radial pin errors"}}) {
            if (!list->empty()) {
                parts.push_back(fmt::format("{} given", what));
            }
        }
        add_rms("gearbox.pin_tangential_rms_um", p.pin_tangential_rms_m, "tangential pin errors",
                parts);
        add_rms("gearbox.pin_radial_rms_um", p.pin_radial_rms_m, "radial pin errors", parts);
        return fmt::format("{}", fmt::join(parts, "; "));
    }

    void add_meshes() {
        const Effects& e = study_.effects;
        if (!stiffness_given(study_)) {
            add("teeth", "{} profile{}", choice_text(study_, "gearbox", "tooth_profile"),
                e.shear ? "" : ", without shear energy");
            if (e.foundation != Foundation::none) {
                add("foundation", "{}", choice_text(study_, "effects", "foundation"));
                add_foundation_warnings();
                add_blanks();
            }
            add_if(e.contact == Contact::load_dependent, "contact",
                   "stiffness depends on the contact force at nominal torque");
        }
        if (e.separation != Separation::none) {
            add("tooth separation", "{}",
                e.separation == Separation::one_sided
                    ? "one-sided: contact loss, but no contact of the back flanks"
                    : fmt::format("two-sided, backlash {:g} mm",
                                  1e3 * study_.gearbox.backlash_m.value_or(0.0)));
        }
        add_if(has_static_errors(study_), "transmission error", "harmonics of the mesh frequency");
        add_if(has_tooth_errors(study_), "tooth errors", "{}", tooth_errors());
        add_if(has_relief(study_), "relief", "gap of each tooth pair along its path of contact");
        add_if(study_.effects.contact_onset == ContactOnset::extended, "contact onset",
               "extended: tip corner contact before and after the path");
        add_if(has_unilateral_teeth(study_), "tooth pairs",
               "unilateral contact: pairs push but never pull");
        add_if(has_unequal_planets(study_), "unequal planets", "{}", unequal_planets_text());
    }

    void add_excitation() {
        const FluctuationInstance f = gearbox_.nominal.fluctuations;
        if (torque_fluctuates(study_)) {
            add("torque fluctuation", "{}", sizes(0.0, "", f.torque_noise, f.torque_noise_Hz));
        }
        if (speed_fluctuates(study_)) {
            const std::string rate = speed_has_sine(study_)
                                         ? fmt::format("{:g} per input revolution", f.speed_order)
                                         : "";
            add("speed fluctuation", "{}",
                sizes(f.speed, rate, f.speed_noise,
                      speed_has_noise(study_) ? f.speed_noise_Hz : 0.0));
        }
        add_if(study_.effects.gravity, "gravity", "-90 deg from the x axis{}",
               gravity_turns(study_) ? ", rotating in the carrier frame" : "");
        if (const std::string why = reason_not_periodic(study_); !why.empty()) {
            add("solution", "{}",
                study_.numerics.horizon == Horizon::superposed
                    ? "superposition of the responses to the errors of each gear; full integration "
                      "where a tooth pair may lose contact"
                    : fmt::format("computed for every mesh period, because {}{}", why,
                                  reason_not_superposed(study_).empty()
                                      ? " (faster if no tooth pair loses contact: numerics.horizon "
                                        "= \"superposed\")"
                                      : ""));
        }
    }

    void add_omitted_excitation() {
        add_if(!torque_fluctuates(study_), "torque fluctuation", "no operation.torque_noise");
        add_if(!speed_fluctuates(study_), "speed fluctuation", "{}",
               study_.effects.quasi_static() ? "no effect without inertia"
                                             : "no operation.speed_fluctuation or speed_noise");
        add_if(!study_.effects.gravity, "gravity", "{}",
               study_.effects.torsional() && planets_balance(study_)
                   ? "the planets' weights balance each other"
                   : "effects.gravity = false");
    }

    bool has_sensor_noise() {
        return sensor_noise_m_s2(study_) > 0.0 || is_random(noise_key(study_)) ||
               is_random("sensor.noise_m_s2");
    }
    bool encoder_noise() {
        return study_.sensor.encoder_noise_rad > 0.0 || is_random("sensor.encoder_noise_arcsec");
    }

    void add_omitted() {
        const Effects& e = study_.effects;
        if (e.quasi_static()) {
            add("inertia and damping", "effects.motion = \"{}\"",
                choice_text(study_, "effects", "motion"));
            add("sensor", "no acceleration without inertia");
        }
        if (e.torsional()) {
            add("x and y motion", "effects.motion = \"{}\"",
                choice_text(study_, "effects", "motion"));
            add("inertial terms", "no effect on rotation");
        } else if (study_.gearbox.kind == GearboxKind::planetary && !e.inertial_terms) {
            add("inertial terms", "effects.inertial_terms = false");
        }
        add_omitted_excitation();
        add_if(!stiffness_given(study_) && e.foundation == Foundation::none, "gear bodies",
               "effects.foundation = \"none\"");
        add_if(study_.gearbox.helix_angle_rad > 0.0, "axial motion, tilting",
               "helical gears move in the transverse plane only");
        add_if(!gearbox_.fault().plan().given(), "fault", "fault.kind = \"none\"");
        add_if(!e.quasi_static() && !has_sensor_noise(), "sensor noise", "{} is 0",
               noise_key(study_));
        add_if(!encoder_noise(), "encoder noise", "sensor.encoder_noise_arcsec is 0");
        if (const std::string without = undamped(); !without.empty()) {
            add("damping", "{}", "0 for " + without);
        }
        add_if(!std::isfinite(decay_meshes_), "",
               "warning: the vibration is undamped, so no gearbox converges to the periodic "
               "steady state");
        add_if(!has_tooth_errors(study_), "tooth errors", "all teeth of a gear are identical");
        add_if(study_.gearbox.kind == GearboxKind::planetary && !has_unequal_planets(study_),
               "unequal planets", "exact pin positions, equal bearings and masses");
        add_if(!has_static_errors(study_) && !has_tooth_errors(study_) && !has_relief(study_),
               "transmission error", "ideal tooth flanks");
        add_if(!stiffness_given(study_) && e.contact_onset == ContactOnset::abrupt,
               "contact beyond the path",
               "effects.contact_onset = \"abrupt\": vibration is overestimated");
        add_if(e.separation == Separation::none && !has_unilateral_teeth(study_),
               "tooth separation", "meshes are springs that never lose contact");
    }

    void add_simulated() {
        add_motion();
        add_meshes();
        add_excitation();
        if (const FaultPlan& fault = gearbox_.fault().plan(); fault.given()) {
            add("fault", "{} on {}", fault.title, fault.location);
        }
        if (!study_.effects.quasi_static()) {
            add_sensors();
            add_if(has_sensor_noise(), "sensor noise", "{}", noise_text(study_));
        }
        add_if(encoder_noise(), "encoder noise", "{:.4g} rad rms times the noise level",
               study_.sensor.encoder_noise_rad);
        add_if(compares_records(study_), "baseline",
               "a healthy record of every gearbox, at a torque that scatters by {:g} % (rms)",
               100.0 * study_.features.baseline_torque_scatter);
    }

    const Study& study_;
    const GearboxPlan& gearbox_;
    const double decay_meshes_;
    std::vector<DescriptionSection> sections_;
};

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

DescriptionSection false_alarm_description(const Study& study) {
    const EnsemblePlan plan(study);
    const double rate = plan.request.false_alarm_rate, confidence = plan.request.confidence;
    const long healthy = plan.threshold_gearboxes, records = plan.threshold_records;
    DescriptionSection section{"false alarms", {}};
    if (const std::string target = false_alarm_target_text(study); !target.empty()) {
        section.entries.push_back({"in time", target});
    }
    section.entries.push_back({"methods", analysis::threshold_methods_text(rate, confidence)});
    if (const std::string few = analysis::size_shortage(plan.test_gearboxes, plan.request);
        !few.empty()) {
        section.entries.push_back({"gearboxes per size", few});
    }
    if (const std::string shortage = plan.healthy_shortage(); !shortage.empty()) {
        section.entries.push_back({"", shortage});
        return section;
    }
    const analysis::Interval found = analysis::threshold_rate_interval(
        healthy * (plan.request.importance_sampling ? 1 : records), rate, confidence);
    section.entries.push_back(
        {"false-alarm rate",
         fmt::format("{:g}; with {}{} healthy gearboxes the true rate is between {:.2g} and {:.2g} "
                     "at {:g} % confidence{}",
                     rate, records > 1 ? fmt::format("{} records of each of ", records) : "",
                     healthy, found.lower, found.upper, 100.0 * confidence,
                     records > 1 ? ", if the records differ mainly by their noise" : "")});
    return section;
}

std::vector<DescriptionSection> description_of(const Study& study, const GearboxPlan& gearbox,
                                               double decay_meshes) {
    return Describer(study, gearbox, decay_meshes).sections();
}

}  // namespace gearpod::mc
