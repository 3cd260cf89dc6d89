// The gearboxes of an ensemble: which values instance k of a group has.
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

// Of one body; all 0 of one that the gearbox has not.
struct BodyInstance {
    double mass_kg;
    // Resolved whichever way the study gives them: of a planetary gearbox J / r^2 (r: base radius,
    // carrier: centre distance), of a fixed-shaft one J.
    double inertia_over_r2_kg, inertia_kg_m2;
    double bearing_stiffness_N_m;  // 0 where a torsional study leaves it out
    double bearing_damping_N_s_m;
    // What its teeth deviate over those of ISO 1328 grade 5; 0 without a quality.
    double tooth_scale;
};

// Of a fixed-shaft gearbox; all 0 in a planetary one.
struct FixedShaftInstance {
    double motor_inertia_kg_m2, load_inertia_kg_m2;
    double motor_coupling_stiffness_N_m_rad, load_coupling_stiffness_N_m_rad;
    double motor_coupling_damping_N_m_s_rad, load_coupling_damping_N_m_s_rad;
    double load_torque_N_m;  // resolved
};

// As in Fluctuations, with 0 for what is not given. Orders and frequencies are turns of the sine.
struct FluctuationInstance {
    double torque, torque_order, torque_Hz, torque_phase_rad;
    double torque_noise, torque_noise_Hz;
    double speed, speed_order, speed_phase_rad;
    double speed_noise, speed_noise_Hz;
};

// All inputs that may differ between gearboxes, SI. Names as in Study.
struct InstanceInputs {
    EachMember<BodyInstance> bodies;
    double support_stiffness_N_m, support_damping_N_s_m;
    double mesh_damping;  // ratio (1), time (s) or constant (N s/m), as effects.mesh_damping says
    FixedShaftInstance fixed_shaft;
    double backlash_m;                                                    // 2b
    double pitch_error_m, index_wave_m, eccentricity_m, profile_slope_m;  // rms, beside a quality's
    Planets planets;
    double torque_N_m;
    double speed_rad_s;  // of Sampler::speed_member()
    FluctuationInstance fluctuations;
    double path_exponent;
    double gain;               // of the sensor on the gearbox's vibration
    double tone_level;         // on the amplitudes of its tones
    double noise_m_s2;         // rms
    double encoder_noise_rad;  // rms
    double fault_size;         // 0 in the threshold group and without a fault
    // Of the law by which its crack grows, as in Life; 0 without one.
    double paris_factor, paris_exponent, curve_pace;
};

// How the records that set thresholds are drawn.
NoiseDraws threshold_draws(const Study& study);

// A random input that is given rather than drawn.
struct GivenInput {
    std::string key;   // "gearbox.tooth_quality"
    double value = 0;  // SI
};

struct ParameterColumn {
    std::string name;  // "planet_bearing_stiffness_N_m", fault_size_column()
    std::string unit;  // SI, e.g. "N/m"; "1" for a pure number
};

// Instances of both groups of one study. Immutable; safe to share between threads. How continuous
// inputs are drawn, sampling_plan.hpp says.
//
// `levels` and `grid` inputs take their values in turn, all combinations of them: instance i has
// the digits of i in a mixed radix whose bases are the numbers of values. The lowest digit is
// the fault's size, so that each size gets equally many gearboxes, then come the others in the
// order of the schema. n gearboxes hold all combinations alike if n is a multiple of their number.
class Sampler {
  public:
    explicit Sampler(const Study& study);

    // Instance `index` (0, 1, ...) of a group; the same whatever was sampled before.
    InstanceInputs sample(Group group, std::uint64_t index) const;
    // Of a record: the baseline has no fault yet, draws of its own of what belongs to records, and
    // another torque by features.baseline_torque_scatter.
    InstanceInputs sample(const GearboxId& id) const;
    // Of the judged record, with what is given; all other draws are as they were.
    InstanceInputs sample(const GearboxId& id, std::span<const GivenInput> given) const;
    // Nominal values; fault_size is the nominal size.
    InstanceInputs nominal() const;

    // The member whose speed InstanceInputs::speed_rad_s is: sun, ring or carrier, or the pinion.
    Member speed_member() const;

    // Every random input, the weight of tilted records, and the fault's size last: what /instances
    // holds.
    std::vector<ParameterColumn> columns() const;
    // The values of one instance in that order, SI; the weight of a plain record, 1.
    std::vector<double> row(const GearboxId& id) const;

  private:
    Study draw(const GearboxId& id) const;
    InstanceInputs resolve(const Study& drawn, const GearboxId& id) const;
    Study study_;
    Copula copula_;
    // By random input: how many instances have the same turn in succession.
    std::vector<std::uint64_t> turn_lengths_;
    SamplingPlan plan_;
};

// J / r^2 and the rest of one gearbox, from the nominal values of a study. Planets differ as they
// are given.
InstanceInputs resolve_inputs(const Study& study);

}  // namespace gearpod::mc
