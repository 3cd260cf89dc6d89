// Samples the gearboxes of an ensemble: the input values of instance k of a group.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "mc/scene/gearbox_streams.hpp"
#include "mc/scene/planets.hpp"
#include "mc/scene/sampling_plan.hpp"
#include "mc/study/copula.hpp"
#include "mc/study/study.hpp"

namespace gearpod::mc {

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
    double speed_rad_s;  // of Sampler::speed_member()
    FluctuationInstance fluctuations;
    double path_exponent;
    double gain;               // sensor's factor on the gearbox's vibration
    double tone_level;         // factor on the amplitudes of its tones
    double noise_m_s2;         // rms
    double encoder_noise_rad;  // rms
    double fault_size;         // 0 in the threshold group and without a fault
    // Parameters of crack growth as in Life; 0 without one.
    double paris_factor, paris_exponent, curve_pace;
};

// Noise distribution of the records that set the thresholds.
NoiseSampling threshold_noise_sampling(const Study& study);

// Random input with a given value, which replaces the random one.
struct GivenInput {
    std::string key;   // "gearbox.tooth_quality"
    double value = 0;  // SI
};

struct ParameterColumn {
    std::string name;  // "planet_bearing_stiffness_N_m", fault_size_column()
    std::string unit;  // SI, e.g. "N/m"; "1" for a pure number
};

// Samples the instances of both groups of one study. Immutable and safe to share between threads.
// sampling_plan.hpp defines how continuous inputs are sampled.
// Inputs with `levels` or `grid` take their values in turn, in all combinations. The level indices
// of instance i are the digits of i in a mixed radix with the numbers of values as bases. The
// lowest digit is the fault's size, so that each size gets equally many gearboxes; the others
// follow in the order of the schema. n gearboxes contain all combinations equally often if n is a
// multiple of their number.
class Sampler {
  public:
    explicit Sampler(const Study& study);

    // Instance `index` (0, 1, ...) of a group, independent of what was sampled before.
    InstanceInputs sample(Group group, std::uint64_t index) const;
    // Instance of a record. The baseline record has no fault, its own values of the inputs that
    // vary from record to record, and a torque that differs by features.baseline_torque_scatter.
    InstanceInputs sample(const GearboxId& id) const;
    // Instance of the test record with some given inputs; all other random numbers are unchanged.
    InstanceInputs sample(const GearboxId& id, std::span<const GivenInput> given) const;
    // Nominal values; fault_size is the nominal size.
    InstanceInputs nominal() const;

    // Member that InstanceInputs::speed_rad_s refers to: sun, ring or carrier, or the pinion.
    Member speed_member() const;

    // Columns of /instances: every random input, the weight of exponentially tilted records, and
    // the fault's size last.
    std::vector<ParameterColumn> columns() const;
    // Values of one instance in the order of columns(), SI; the weight is that of a plain record,
    // 1.
    std::vector<double> row(const GearboxId& id) const;

  private:
    Study draw(const GearboxId& id) const;
    InstanceInputs resolve(const Study& drawn, const GearboxId& id) const;
    Study study_;
    Copula copula_;
    // By random input: number of successive instances with the same level index.
    std::vector<std::uint64_t> level_strides_;
    SamplingPlan plan_;
};

// Inputs of one gearbox from the nominal values of a study, including J / r^2 and the given
// differences between planets.
InstanceInputs resolve_inputs(const Study& study);

}  // namespace gearpod::mc
