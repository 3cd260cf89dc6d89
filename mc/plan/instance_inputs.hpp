// Inputs of one gearbox, and how they follow from the numbers of a study: drawn where these are
// random, else nominal.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <optional>
#include <string_view>
#include <vector>

#include "dynamics/planetary.hpp"
#include "mc/study/keys/key.hpp"
#include "mc/study/sensor_signal.hpp"
#include "mc/study/study.hpp"

namespace gearpod::mc {

// Number that may differ between the gearboxes of a study: index among the keys that may be random,
// in the order of the schema.
enum class InputId : std::size_t {};
// Precondition: the key "section.name" exists and may be random.
InputId input_id(std::string_view key);

// Values of all these numbers for one gearbox, SI; empty for those that are not given.
class InputValues {
  public:
    // The nominal values of a study.
    explicit InputValues(const Study& study);

    void set(InputId id, double value) { values_[static_cast<std::size_t>(id)] = value; }
    std::optional<double> operator[](InputId id) const {
        return values_[static_cast<std::size_t>(id)];
    }
    // Value of a key, for example get<"operation.torque_N_m">(), and the same with a default.
    template <KeyText kKey>
    std::optional<double> get() const {
        static const InputId id = input_id(kKey.text);
        return (*this)[id];
    }
    template <KeyText kKey>
    double or_0() const {
        return get<kKey>().value_or(0.0);
    }

  private:
    std::vector<std::optional<double>> values_;
};

using Planets = std::array<dynamics::PlanetDeviations, dynamics::kMaxPlanets>;

// Inputs of one body; all 0 if the gearbox does not have it.
struct BodyInstance {
    double mass_kg;
    // Resolved from the study's values: J / r^2 for a planetary gearbox (r: base radius, for the
    // carrier the centre distance), J for a fixed-shaft one.
    double inertia_over_r2_kg, inertia_kg_m2;
    double bearing_stiffness_N_m;  // 0 if a torsional study gives none
    double bearing_damping_N_s_m;
    // Tooth deviations relative to ISO 1328 grade 5; 0 without a quality.
    double tooth_scale;
};

// Inputs of a fixed-shaft gearbox; all 0 in a planetary one.
struct FixedShaftInstance {
    double motor_inertia_kg_m2, load_inertia_kg_m2;
    double motor_coupling_stiffness_N_m_rad, load_coupling_stiffness_N_m_rad;
    double motor_coupling_damping_N_m_s_rad, load_coupling_damping_N_m_s_rad;
    double load_torque_N_m;  // given, or in balance with the motor's torque
};

// Fluctuation inputs of Fluctuations, with 0 for values that are not given. The order is cycles per
// turn of the input, bands are cycles per second.
struct FluctuationInstance {
    double torque_noise, torque_noise_Hz;
    double speed, speed_order, speed_phase_rad;
    double speed_noise, speed_noise_Hz;
};

// All inputs that may differ between gearboxes, SI. Names as in Study.
struct InstanceInputs {
    MemberArray<BodyInstance> bodies;
    double support_stiffness_N_m, support_damping_N_s_m;
    double mesh_damping;  // parameter of the law effects.mesh_damping
    FixedShaftInstance fixed_shaft;
    double backlash_m;  // 2b
    // Deviations, rms, in addition to those of a quality.
    double pitch_error_m, eccentricity_m;
    Planets planets;
    double torque_N_m;
    double speed_rad_s;  // of speed_member()
    FluctuationInstance fluctuations;
    double path_exponent;
    double gain;           // sensor's factor on the gearbox's vibration
    double tone_level;     // factor on the amplitudes of its tones
    double bearing_level;  // factor on the amplitudes of its bearings
    double housing_frequency_factor;
    double noise_m_s2;             // rms of all accelerometer noise
    double white_noise_m_s2;       // rms of the part that the low-pass does not filter
    double background_noise_m_s2;  // rms of the part that is the machine's background
    double encoder_noise_rad;      // rms
    double fault_size;             // 0 in the threshold group and without a fault
    // Parameters of crack growth as in Life; 0 without one.
    double paris_factor, paris_exponent, curve_pace;
};

inline SensorNoise noise_of(const InstanceInputs& inputs) {
    return {inputs.noise_m_s2, inputs.white_noise_m_s2, inputs.background_noise_m_s2};
}

// Conversion of the values of one gearbox to its inputs: constants that all gearboxes of a study
// have in common.
struct InputsRecipe {
    // Keys and gear of one body. A body without a key does not have that property.
    struct Body {
        std::optional<InputId> mass, inertia, inertia_over_r2, bearing_stiffness, bearing_damping,
            quality;
        double radius_m = 0.0;      // base radius, centre distance (carrier), or pitch radius
        double disc_over_r2 = 0.0;  // J / (m r^2) of a solid disc
    };

    explicit InputsRecipe(const Study& study);

    InputValues nominal;
    MemberArray<Body> bodies;
    std::optional<double> gear_ratio;     // gear to pinion teeth of a fixed-shaft gearbox
    std::optional<InputId> mesh_damping;  // parameter of the law effects.mesh_damping
    std::optional<InputId> fault_size;    // empty without a fault
    Planets planets;                      // given differences
    NoiseModel noise;
};

// Member whose speed a study gives: sun or carrier, or the pinion.
Member speed_member(const Study& study);

// Inputs of one gearbox, including J / r^2 and the given differences between planets.
InstanceInputs instance_inputs(const InputsRecipe& recipe, const InputValues& values);
// The same with all values nominal; fault_size is the nominal size.
InstanceInputs nominal_inputs(const Study& study);

// Random differences between planets.
struct PlanetScatter {
    PlanetScatter(const Gearbox& gearbox, DrawnPer pin_owner);

    std::vector<double> angles_rad;  // of the planets on the carrier
    DrawnPer pins;                   // position errors of the pins
};
// Adds them to the planets of one gearbox. Takes five standard normal variates per planet, whatever
// the values; the first two move its pin.
void add_random_planets(const PlanetScatter& scatter, const InputValues& values,
                        std::function<double()> normal, Planets& planets);

}  // namespace gearpod::mc
