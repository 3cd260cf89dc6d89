// Sensors of a study, and what they pick up apart from the gearbox.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "mc/study/member.hpp"

namespace gearpod::mc {

struct Study;

// Interfering tone at the sensor: of a given frequency, or an order of a shaft of the gearbox.
struct Tone {
    double frequency_Hz = 0.0;  // 0 if it belongs to a shaft
    double amplitude_m_s2 = 0.0;
    std::optional<Member> shaft = {};
    double order = 0.0;  // cycles per turn of the shaft

    bool operator==(const Tone&) const = default;
};

// Faulty part of a rolling bearing.
enum class BearingFault { outer, inner, roller, cage };
// Records that contain the vibration of a fault elsewhere: all of them, or those of another fault
// than the study's.
enum class SourceRole { background, other_fault };

// Rolling bearing with a local fault (signals/noise/bearing_impulses.hpp). The outer ring stands
// still, the inner ring turns with the shaft.
struct Bearing {
    BearingFault fault = BearingFault::outer;
    std::optional<Member> shaft = {};  // of the gearbox, or elsewhere:
    double shaft_Hz = 0.0;             // rotation of a shaft outside of the gearbox
    int elements = 0;                  // rolling elements
    double diameter_ratio = 0.0;       // of a rolling element to the pitch circle
    double contact_angle_deg = 0.0;
    double amplitude_m_s2 = 0.0;  // of the response to one impulse, before the low-pass
    double resonance_Hz = 0.0, damping = 0.0;
    double slip = 0.0;           // standard deviation of an interval over its mean
    double load_zone_deg = 0.0;  // width
    SourceRole role = SourceRole::background;

    bool operator==(const Bearing&) const = default;
};

// Neighbouring stage, whose vibration reaches the sensor, too. A shaft connects it with the study's
// gearbox. If the shaft has a stiffness, it twists and both gearboxes vibrate together; otherwise
// both turn steadily.
struct NeighbourStage {
    std::string name;
    std::string text;                          // its study, with all defaults
    std::shared_ptr<const Study> study;        // that text, read; never null
    std::optional<Member> shaft, stage_shaft;  // the common shaft: here, and in that stage
    std::string of;     // `shaft` is that of this earlier stage; "": of the study's gearbox
    double gain = 1.0;  // factor on the vibration at that study's own sensor
    double shaft_stiffness_N_m_rad = 0.0;  // 0: the shaft does not transmit vibration
    // Damping ratio of the motion in which both gearboxes turn against each other as rigid bodies.
    double shaft_damping_ratio = 0.02;
    // other_fault: the stage is healthy, and has its study's fault in records of another fault.
    SourceRole role = SourceRole::background;

    bool coupled() const { return shaft_stiffness_N_m_rad > 0.0; }

    bool operator==(const NeighbourStage& other) const {
        return name == other.name && text == other.text && shaft == other.shaft &&
               stage_shaft == other.stage_shaft && of == other.of && gain == other.gain &&
               shaft_stiffness_N_m_rad == other.shaft_stiffness_N_m_rad &&
               shaft_damping_ratio == other.shaft_damping_ratio && role == other.role;
    }
};

// Natural mode of the housing between the gearbox and the sensors
// (signals/path/frequency_response.hpp).
struct HousingMode {
    double frequency_Hz = 0.0, damping = 0.0;
    double participation = 0.0;  // at the first sensor
    // Mode of the ring with this number of nodal diameters, which the planets excite as moving
    // loads; without it, the vibration that reaches the sensor excites the mode.
    std::optional<int> nodal_diameters = {};
    // Participation of the force in the bearing of sun and carrier, 1/kg: product of the mode shape
    // there and at the first sensor over the modal mass.
    double sun_bearing_per_kg = 0.0, carrier_bearing_per_kg = 0.0;

    bool operator==(const HousingMode&) const = default;
};

// Further accelerometer on the ring of a planetary gearbox, compared with the first one.
struct AdditionalSensor {
    std::string name;
    double angle_deg = 0.0;   // from the first one, in the sense of the carrier's positive rotation
    bool tangential = false;  // direction: tangential, or else radial
    double gain = 1.0;        // factors on those of the first one
    double noise = 1.0;
    // Participation of each of the housing's modes, and measured response at Sensor::response_Hz;
    // empty: as at the first sensor.
    std::vector<double> participation, response_gain, response_phase_deg;
    // The same for the forces in the bearings of sun and carrier.
    std::vector<double> sun_bearing_per_kg, sun_response_gain, sun_response_phase_deg;
    std::vector<double> carrier_bearing_per_kg, carrier_response_gain, carrier_response_phase_deg;
    // Measuring chain of its own (signals/path/frequency_response.hpp); without a value, that of
    // the first one.
    std::optional<double> sampling_Hz, low_pass_Hz, mounting_Hz;
    double mounting_damping = 0.03;
    double delay_s = 0.0;                     // of its samples
    std::optional<double> quantisation_m_s2;  // not multiplied by `noise`
    std::optional<double> range_m_s2;

    bool operator==(const AdditionalSensor&) const = default;
};

struct Sensor {
    double sampling_Hz = 0.0;
    double low_pass_Hz = 0.0;
    Member position = Member::pinion;  // fixed-shaft: bearing on which the sensor is mounted
    double path_exponent = 0.1;
    std::vector<AdditionalSensor> additional;
    std::vector<HousingMode> housing_modes;
    double housing_frequency_factor = 1.0;  // on the natural frequencies of the housing
    // Measured frequency response of the housing to the first sensor; may be empty.
    std::vector<double> response_Hz, response_gain, response_phase_rad;
    // Response at these frequencies to the forces in the bearings of sun and carrier, (m/s^2)/N.
    std::vector<double> sun_response_gain, sun_response_phase_rad;
    std::vector<double> carrier_response_gain, carrier_response_phase_rad;
    double gain = 1.0;  // factor on the gearbox's vibration, before tones and noise are added
    // Part of the acceleration at right angles to their axes that the sensors pick up, percent.
    std::optional<double> cross_axis_percent;
    double noise_m_s2 = 0.0;                               // rms, white
    std::optional<double> noise_density_m_s2_per_sqrt_Hz;  // in addition; low-pass filtered
    // Background of the machine by its density at given frequencies, in addition; may be empty.
    std::vector<double> background_Hz, background_density_m_s2_per_sqrt_Hz;
    double background_level = 1.0;   // factor on that density
    double quantisation_m_s2 = 0.0;  // step of the analogue-to-digital converter
    // Largest magnitude of a sample, at which it is clipped; unlimited without a value.
    std::optional<double> range_m_s2;
    std::vector<Tone> tones;
    double tone_level = 1.0;  // factor on the amplitudes of all tones
    std::vector<Bearing> bearings;
    double bearing_level = 1.0;  // factor on the amplitudes of all bearings
    std::vector<NeighbourStage> stages;
    double encoder_sampling_Hz = 0.0;
    double encoder_noise_rad = 0.0;         // rms
    std::vector<double> noise_levels{1.0};  // factors on both noises, ascending
    // Length of a record, in seconds or in carrier turns; by default every tooth of the monitored
    // gear meets every tooth of its mate once.
    std::optional<double> record_s, record_turns;

    bool operator==(const Sensor&) const = default;
};

}  // namespace gearpod::mc
