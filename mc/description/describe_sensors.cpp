#include "mc/description/describe_sensors.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "mc/coupling/coupled_train.hpp"
#include "mc/description/entries.hpp"
#include "mc/gearbox/other_sources.hpp"
#include "mc/scene/instance_inputs.hpp"
#include "mc/study/gears.hpp"
#include "mc/study/housing.hpp"

namespace gearpod::mc {
namespace {

// Prints the impulses of a faulty bearing at nominal speed, and their vibration after the low-pass.
void print_bearing(const Scene& scene, const Bearing& bearing) {
    const InstanceInputs inputs = nominal_inputs(scene.study());
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
        nominal_inputs(own.study()).speed_rad_s / nominal_inputs(*stage.study).speed_rad_s;
    return std::abs(factor - 1.0) < 1e-3
               ? ""
               : fmt::format(", {:.4g} times as fast as in its own study, as the shaft requires",
                             factor);
}

// Describes what the shaft of a stage does, with the frequency of its twist.
std::string shaft_text(const Scene& scene, std::size_t stage) {
    const NeighbourStage& own = scene.study().sensor.stages[stage];
    return own.coupled()
               ? fmt::format(
                     "the shaft twists by {:.3g} N m/rad: both gearboxes would turn against "
                     "each other at {:.3g} Hz with a damping ratio of {:g}; it sets the "
                     "torque of the stage{}",
                     own.shaft_stiffness_N_m_rad, shaft_mode(scene, stage).frequency_Hz,
                     own.shaft_damping_ratio,
                     is_mirrored(scene, stage)
                         ? "; its study is mirrored, since it lets the other side drive"
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
    const Scene& own = scene.stages()[number];
    print_entry(
        "neighbouring stage",
        fmt::format(
            "\"{}\": {}; its {} on the {}{}{}; meshes at {:.4g} Hz; gain x {:g}; {}{}", stage.name,
            own.study().title, member_name(*stage.stage_shaft), member_name(*stage.shaft),
            stage.of.empty() ? "" : fmt::format(" of \"{}\"", stage.of),
            other_speed_text(stage, own), std::abs(own.nominal_mesh_frequency_Hz()), stage.gain,
            shaft_text(scene, number),
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
    for (std::size_t i = 0; i < scene.stages().size(); ++i) {
        print_stage(scene, i);
    }
}

}  // namespace gearpod::mc
