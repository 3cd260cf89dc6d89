// Values of a study's numbers for one gearbox: drawn where they are random, else nominal.
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "dynamics/planetary.hpp"
#include "mc/study/keys/key.hpp"
#include "mc/study/noise.hpp"
#include "mc/study/study.hpp"

namespace gearpod::mc {

class InputValues {
  public:
    // The study must outlive the object.
    explicit InputValues(const Study& study) : study_(study) {}

    const Study& study() const { return study_; }

    // Replaces the number of study() that is stored at `place` (NumberAccess::place), SI.
    void set(const void* place, double value) { values_.emplace_back(place, value); }

    // Value of a number, which must be a member of study(), not a copy.
    double of(const double& number) const {
        const double* own = find(&number);
        return own != nullptr ? *own : number;
    }
    std::optional<double> of(const std::optional<double>& number) const {
        const double* own = find(&number);
        return own != nullptr ? *own : number;
    }
    double of(const double&&) const = delete;
    std::optional<double> of(const std::optional<double>&&) const = delete;
    // Value of a number that is named by its key; empty if it is not given.
    std::optional<double> of(const NumberAccess& access) const {
        const double* own = find(access.place(study_));
        return own != nullptr ? *own : access.get(study_);
    }

  private:
    // The value that was set last, or null.
    const double* find(const void* place) const {
        for (auto value = values_.rbegin(); value != values_.rend(); ++value) {
            if (value->first == place) {
                return &value->second;
            }
        }
        return nullptr;
    }

    const Study& study_;
    std::vector<std::pair<const void*, double>> values_;
};

// Differences between the planets of one gearbox.

using Planets = std::array<dynamics::PlanetDeviations, dynamics::kMaxPlanets>;

// Planets as given in the study; identical if nothing is given.
Planets given_planets(const Study& study);

// Adds the random deviations. Uses five standard normal variates per planet from both sources,
// whatever the study contains; positions of pins follow from `normal_of_pins`.
void add_random_planets(const InputValues& values, std::function<double()> normal,
                        std::function<double()> normal_of_pins, Planets& planets);

// Inputs of one gearbox that may differ between the gearboxes of a study.

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

// Fluctuation inputs of Fluctuations, with 0 for values that are not given. Orders are cycles per
// turn of the input, frequencies cycles per second.
struct FluctuationInstance {
    double torque, torque_order, torque_Hz, torque_phase_rad;
    double torque_noise, torque_noise_Hz;
    double speed, speed_order, speed_phase_rad;
    double speed_noise, speed_noise_Hz;
};

// All inputs that may differ between gearboxes, SI. Names as in Study.
struct InstanceInputs {
    MemberArray<BodyInstance> bodies;
    double support_stiffness_N_m, support_damping_N_s_m;
    dynamics::DampingParameters mesh_damping;  // of the law effects.mesh_damping
    FixedShaftInstance fixed_shaft;
    double backlash_m;  // 2b
    // Deviations, rms, in addition to those of a quality.
    double pitch_error_m, index_wave_m, eccentricity_m, profile_slope_m;
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
    double low_pass_Hz;            // of the sensor that has this noise
    double own_sampling_Hz;        // of that sensor's converter; 0: that of the study
    double range_m_s2;             // of that sensor; infinite without one
    double encoder_noise_rad;      // rms
    double fault_size;             // 0 in the threshold group and without a fault
    // Parameters of crack growth as in Life; 0 without one.
    double paris_factor, paris_exponent, curve_pace;
};

// Noise of the sensor in a gearbox with these inputs.
inline SensorNoise noise_of(const InstanceInputs& inputs) {
    return {inputs.noise_m_s2, inputs.white_noise_m_s2, inputs.background_noise_m_s2};
}

// Member whose speed a study gives: sun, ring or carrier, or the pinion.
Member speed_member(const Study& study);

// Inputs of one gearbox, including J / r^2 and the given differences between planets.
InstanceInputs instance_inputs(const InputValues& values);
// The same with all values nominal; fault_size is the nominal size.
InstanceInputs nominal_inputs(const Study& study);

}  // namespace gearpod::mc
