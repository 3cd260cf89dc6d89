// Keys of [sensor], [features], [detection], [monitoring], [life], [numerics] and [ensemble].
#include "lockstep/integrators/facts.hpp"
#include "mc/study/elements/sensors.hpp"
#include "mc/study/keys/schema_line.hpp"
#include "mc/study/schema/presence.hpp"
#include "mc/study/schema/schema.hpp"

namespace gearpod::mc {
namespace {

constexpr ChoiceName kPositions[] = {name("pinion", Member::pinion), name("gear", Member::gear)};
constexpr ChoiceName kStepGrids[] = {name("uniform", StepGrid::uniform),
                                     name("graded", StepGrid::graded)};
constexpr ChoiceName kPrecisions[] = {name("double", Precision::double_precision),
                                      name("single", Precision::single_precision)};
constexpr ChoiceName kHorizons[] = {name("periodic", Horizon::periodic),
                                    name("superposed", Horizon::superposed),
                                    name("full", Horizon::full)};
// "auto" and the names of all values.
template <class Enum>
std::vector<ChoiceName> names_or_auto(std::span<const Enum> values) {
    std::vector<ChoiceName> all{kAutomatic};
    for (const Enum value : values) {
        all.push_back({name(value), static_cast<int>(value)});
    }
    return all;
}
const std::vector<ChoiceName> kIntegrators = names_or_auto(lockstep::all_integrators());
constexpr machine::InstructionSet kSets[] = {machine::InstructionSet::baseline,
                                             machine::InstructionSet::x86_64_v3,
                                             machine::InstructionSet::x86_64_v4};
const std::vector<ChoiceName> kInstructionSets = names_or_auto<machine::InstructionSet>(kSets);

// Closer to 0 or 1, intervals cannot be computed.
constexpr Range kShare = closed_range(1e-9, 1 - 1e-9), kConfidence = closed_range(1e-9, 0.9999);
constexpr Range kTolerance = {0.0, 1.0, false, true};

// clang-format off
const Key kRunKeys[] = {
    {"sensor", "sampling_Hz", number<&Sensor::sampling_Hz>, kHz, kFrequency, acceleration, kSampling, "sampling rate of the accelerometer"},
    {"sensor", "low_pass_Hz", number<&Sensor::low_pass_Hz>, kHz, kFrequency, acceleration, kSampling, "cut-off frequency of the anti-alias low-pass"},
    {"sensor", "position", choice<&Sensor::position>(kPositions), kNone, kAny, fixed_shaft<acceleration_detail>, kShared, "bearing on which the sensor is mounted"},
    {"sensor", "path_exponent", number<&Sensor::path_exponent>, kNone, closed_range(-1, 1), planetary<acceleration_detail>, kRandom, "exponent of the transmission path"},
    {"sensor", "additional", tables<&Sensor::additional, read_additional_sensors, sensor_table>("sensors", kSensorFields), kNone, kAny, planetary<acceleration_detail>, kShared, "further accelerometers on the ring, by angle_deg from the first one, direction (radial or tangential), gain and noise relative to it: features and detection of each, and of all together. participation of the housing's modes, or response_gain and response_phase_deg, and those of the bearings, if they differ from those of the first one. A measuring chain of its own: sampling_Hz and low_pass_Hz (at most those of the study), mounting_Hz and mounting_damping, delay_s (its samples are late), quantisation_m_s2 and range_m_s2: docs/guide/sensors.md"},
    {"sensor", "housing_modes", tables<&Sensor::housing_modes, read_housing_modes, housing_table>("modes", kHousingFields), kNone, kAny, without_response, kShared, "natural modes of the housing between the gearbox and the sensors, excited by the vibration that reaches the sensor, or with nodal_diameters by the planets that move along an elastic ring; with sun_bearing_per_kg and carrier_bearing_per_kg (1/kg) also by the forces in these bearings: docs/guide/sensors.md"},
    {"sensor", "housing_frequency_factor", number<&Sensor::housing_frequency_factor>, kNone, closed_range(0.1, 10), only_with<"sensor.housing_modes", acceleration_detail>, kRandom, "factor on the natural frequencies of the housing: how this machine differs from the nominal one"},
    {"sensor", "response_Hz", ascending<&Sensor::response_Hz>, kHz, kNotNegative, acceleration_detail, kShared, "frequencies of a measured frequency response of the housing, or a column of a file"},
    {"sensor", "response_gain", numbers<&Sensor::response_gain>, kNone, kNotNegative, needed_with<"sensor.response_Hz">, kShared, "gain of that response: acceleration at the sensor over that at the ring. Complex values in between are interpolated linearly, and nothing passes outside of the given frequencies"},
    {"sensor", "response_phase_deg", numbers<&Sensor::response_phase_rad>, kDeg, kAny, needed_with<"sensor.response_Hz">, kShared, "phase of that response"},
    {"sensor", "sun_response_gain", numbers<&Sensor::sun_response_gain>, kNone, kNotNegative, planetary<only_with<"sensor.response_Hz", bearings_move>>, kShared, "gain of the response at response_Hz to the force in the bearing of the sun, (m/s^2)/N: acceleration at the sensor over that force"},
    {"sensor", "sun_response_phase_deg", numbers<&Sensor::sun_response_phase_rad>, kDeg, kAny, planetary<needed_with<"sensor.sun_response_gain">>, kShared, "phase of that response"},
    {"sensor", "carrier_response_gain", numbers<&Sensor::carrier_response_gain>, kNone, kNotNegative, planetary<only_with<"sensor.response_Hz", bearings_move>>, kShared, "gain of the response at response_Hz to the force in the bearing of the carrier, (m/s^2)/N: acceleration at the sensor over that force"},
    {"sensor", "carrier_response_phase_deg", numbers<&Sensor::carrier_response_phase_rad>, kDeg, kAny, planetary<needed_with<"sensor.carrier_response_gain">>, kShared, "phase of that response"},
    {"sensor", "gain", number<&Sensor::gain>, kNone, kPositive, acceleration_detail, kRandom, "factor on the gearbox's vibration before tones and noise are added: effect of housing and mounting"},
    {"sensor", "cross_axis_percent", number<&Sensor::cross_axis_percent>, kNone, closed_range(0, 100), planetary<acceleration_detail>, kShared, "cross-axis sensitivity of the accelerometers (ISO 16063-31), 3 to 5 in typical data sheets: percent of the acceleration at right angles to its axis, along the same path, that a sensor adds to that along its axis; tangential for a radial sensor, and radial for a tangential one. By default 0"},
    {"sensor", "noise_m_s2", number<&Sensor::noise_m_s2>, kMPerS2, kNotNegative, acceleration_detail, kRandom, "rms noise of the accelerometer: white up to half the sampling rate, not low-pass filtered; adds in quadrature to the noise by density and to the quantisation"},
    {"sensor", "noise_density_m_s2_per_sqrt_Hz", number<&Sensor::noise_density_m_s2_per_sqrt_Hz>, kMPerS2RootHz, kNotNegative, acceleration_detail, kRandom, "noise of the accelerometer by its one-sided density, as in data sheets (1 ug/sqrt(Hz) is 9.81e-6): white before the low-pass, which filters it like the signal"},
    {"sensor", "background_Hz", ascending<&Sensor::background_Hz>, kHz, kPositive, acceleration_detail, kShared, "frequencies at which the background of the machine is given, or a column of a file"},
    {"sensor", "background_density_m_s2_per_sqrt_Hz", numbers<&Sensor::background_density_m_s2_per_sqrt_Hz>, kMPerS2RootHz, kPositive, needed_with<"sensor.background_Hz">, kShared, "one-sided density of the machine's broadband background at these frequencies, before the low-pass: straight lines in between on logarithmic axes, none outside. Adds in quadrature to the other noise and is multiplied by noise_levels"},
    {"sensor", "background_level", number<&Sensor::background_level>, kNone, kNotNegative, only_with<"sensor.background_Hz", acceleration_detail>, kRandom, "factor on that density: vibration level of the rest of this machine"},
    {"sensor", "quantisation_m_s2", number<&Sensor::quantisation_m_s2>, kMPerS2, kNotNegative, acceleration_detail, kShared, "step of the analogue-to-digital converter: adds white noise of step/sqrt(12) rms in quadrature. Its full range over 2^bits; 0: no rounding"},
    {"sensor", "range_m_s2", number<&Sensor::range_m_s2>, kMPerS2, kPositive, acceleration_detail, kShared, "measuring range: samples beyond it, noise included, are clipped to plus or minus this value; by default unlimited"},
    {"sensor", "tones", tables<&Sensor::tones, read_tones, tone_table>("tones", kToneFields), kNone, kAny, acceleration_detail, kShared, "interfering tones from the rest of the machine, each of a frequency or of an order of a shaft of the gearbox (cycles per turn)"},
    {"sensor", "tone_level", number<&Sensor::tone_level>, kNone, kNotNegative, only_with<"sensor.tones", acceleration_detail>, kRandom, "factor on the amplitudes of all tones: vibration level of the rest of this machine"},
    {"sensor", "bearings", tables<&Sensor::bearings, read_bearings, bearing_table>("bearings", kBearingFields), kNone, kAny, acceleration_detail, kShared, "rolling bearings with a local fault, whose impulses the sensor picks up: docs/guide/sensors.md"},
    {"sensor", "bearing_level", number<&Sensor::bearing_level>, kNone, kNotNegative, only_with<"sensor.bearings", acceleration_detail>, kRandom, "factor on the amplitudes of all bearings: how severe their faults are"},
    {"sensor", "stages", tables<&Sensor::stages, read_stages, stage_table>("stages", kStageFields), kNone, kAny, acceleration_detail, kShared, "neighbouring stages, each a study of its own, whose vibration the sensor picks up, too: docs/guide/sensors.md"},
    {"sensor", "encoder_sampling_Hz", number<&Sensor::encoder_sampling_Hz>, kHz, kFrequency, always, kSampling, "sampling rate of the encoders"},
    {"sensor", "encoder_noise_arcsec", number<&Sensor::encoder_noise_rad>, kArcsec, kNotNegative, may, kRandom, "rms noise of the transmission error"},
    {"sensor", "noise_levels", ascending<&Sensor::noise_levels>, kNone, kNotNegative, may, kSampling, "factors on the noise of accelerometer and encoders, ascending"},
    {"sensor", "record_s", number<&Sensor::record_s>, kS, kPositive, may, kShared, "length of a record, which begins at a random tooth position; without it and record_turns, a record has as many planet turns as the ring has teeth (turns of the pinion as the gear has): every tooth has then met every tooth of its mate that it can meet"},
    {"sensor", "record_turns", number<&Sensor::record_turns>, kNone, kPositive, planetary<may>, kShared, "length of a record in turns of the carrier relative to the fixed ring or sun; alternative to record_s"},

    {"features", "use", list<&Features::use>, kNone, kAny, may, kShared, "features to compute; by default the basic ones: te_rms te_kurtosis te_fc te_fm0 sensor_rms window_ratio window_z. change_... and own_... compare with a healthy baseline record of the same gearbox"},
    {"features", "python", list<&Features::python>, kNone, kAny, may, kShared, "Python files with features of your own, such as [\"my_features.py\"], relative to the study: every public function whose first parameter is record is a feature, in addition to use. Reading the study runs these files"},
    {"features", "tukey_taper", number<&Features::tukey_taper>, kNone, closed_range(0, 1), may, kShared, "tapered fraction of the window that selects the mesh periods of a tooth (0: rectangular)"},
    {"features", "te_harmonics", integer<&Features::te_harmonics>, kNone, closed_range(1, 1000), may, kShared, "number of mesh harmonics in te_fm0"},
    {"features", "baseline_torque_scatter", number<&Features::baseline_torque_scatter>, kNone, closed_range(0, 1), with_baseline, kShared, "rms relative difference of torque between a gearbox's healthy baseline record and its test record (standard deviation of the logarithm)"},
    {"features", "baseline_records", integer<&Features::baseline_records>, kNone, closed_range(1, 100), with_baseline, kShared, "number of a gearbox's healthy baseline records that are averaged: their values for own_..., their signals for change_..."},
    {"features", "baseline_redraws", list<&Features::baseline_redraws>, kNone, kAny, with_baseline, kShared, "random properties that the assembly of the baseline does not share with the tested one: pins (random pin positions), teeth (teeth in mesh, and with them the phases of run-out and of all tooth errors). Random inputs differ with per = \"assembly\" or \"record\" in [random]"},

    {"detection", "false_alarm_rate", number<&Detection::false_alarm_rate>, kNone, kShare, may, kShared, "fraction of healthy records that may alarm, for each feature"},
    {"detection", "false_alarms_per_1000_h", number<&Detection::false_alarms_per_1000_h>, kNone, kPositive, may, kShared, "instead of false_alarm_rate: false alarms of a feature in 1000 hours of healthy machines, all machines together"},
    {"detection", "machines", integer<&Detection::machines>, kNone, closed_range(1, 1e6), with_alarm_target, kShared, "number of machines in the fleet that the target is for"},
    {"detection", "record_interval_h", number<&Detection::record_interval_h>, kHours, kPositive, alarm_target_needs, kShared, "hours between two records of a machine; by default life.interval_h"},
    {"detection", "confidence", number<&Detection::confidence>, kNone, kConfidence, may, kShared, "confidence level of the intervals"},
    {"detection", "size_edges_mm", ascending<&Detection::size_edges_m>, kMm, kNotNegative, length_edges, kShared, "edges of the size groups of a continuous fault size that is a length"},
    {"detection", "size_edges", ascending<&Detection::size_edges>, kNone, kNotNegative, number_edges, kShared, "edges of the size groups of a continuous fault size that is a pure number"},
    {"detection", "uncertain_inputs", list<&Detection::uncertain_inputs>, kNone, kAny, may, kShared, "random inputs, by key, whose distribution describes the uncertainty of one value that is the same for all gearboxes, as calibrate estimates it; its effect is shown as a separate band"},
    {"detection", "chosen_values", list<&Detection::chosen_values>, kNone, kAny, may, kShared, "of features.baseline_torque_scatter, gearbox.tooth_quality and the key of the sensor's noise, those whose values are chosen, neither measured nor from a source; the answer of run marks them"},

    {"monitoring", "baseline_records", integer<&Monitoring::baseline_records>, kNone, closed_range(0, 1e6), may, kShared, "number of a gearbox's first records, from which its normal state is estimated; 0: features are monitored without a baseline"},
    {"monitoring", "torque_regression", boolean<&Monitoring::torque_regression>, kNone, kAny, may, kShared, "the normal state of a gearbox depends linearly on the torque of its records"},
    {"monitoring", "detectors", list<&Monitoring::detectors>, kNone, kAny, may, kShared, "detectors that monitor a gearbox's records: single, 2 of 3, ewma 0.1 (weight of the latest record), cusum 0.5 (reference value), trend 100 (number of records); append two-sided to detect changes in both directions"},
    {"monitoring", "average_records", integer<&Monitoring::average_records>, kNone, closed_range(1, 1000), may, kShared, "number of consecutive measured recordings of a gearbox, aligned with its baseline, that features averages before it computes features"},

    {"monitoring", "false_alarms_per_1000_h", number<&Monitoring::false_alarms_per_1000_h>, kNone, kPositive, only_with<"life.interval_h">, kShared, "false alarms in 1000 operating hours of healthy gearboxes for which the thresholds of lives are set"},

    {"life", "interval_h", number<&Life::interval_h>, kHours, kPositive, may, kShared, "hours between two records of a gearbox; the command `lives` then follows gearboxes with a growing crack"},
    {"life", "records", integer<&Life::records>, kNone, closed_range(1, 1e5), only_with<"life.interval_h">, kShared, "largest number of records of a life, baseline records included"},
    {"life", "healthy_lives", integer<&Life::healthy_lives>, kNone, closed_range(1, 1e6), only_with<"life.interval_h">, kShared, "healthy gearboxes for counting false alarms, in addition to those that set the thresholds (ensemble.threshold_instances)"},
    {"life", "first_depth_mm", number<&Life::first_depth_m>, kMm, kPositive, paris_needs, kShared, "depth of the crack when the baseline is known"},
    {"life", "last_depth_mm", number<&Life::last_depth_m>, kMm, kPositive, needed_with<"life.interval_h">, kShared, "depth of the crack at which a life ends"},
    {"life", "paris_factor", number<&Life::paris_factor>, kNone, kPositive, paris_needs, kRandom, "C in Paris' law da/dN = C (Delta K)^m: mm per cycle at 1 MPa m^(1/2)"},
    {"life", "paris_exponent", number<&Life::paris_exponent>, kNone, closed_range(1, 10), paris_needs, kRandom, "m in Paris' law"},
    {"life", "curve_h", ascending<&Life::curve_h>, kHours, kNotNegative, only_with<"life.interval_h">, kShared, "instead of Paris' law: hours since the crack started, from 0, at which its depth is given"},
    {"life", "curve_depth_mm", ascending<&Life::curve_depth_m>, kMm, kPositive, needed_with<"life.curve_h">, kShared, "depths of the crack at the hours of curve_h; linear in between"},
    {"life", "curve_pace", number<&Life::curve_pace>, kNone, kPositive, only_with<"life.curve_h">, kRandom, "rate at which a gearbox's crack grows relative to that curve; 1 by default"},
    {"life", "depth_steps", integer<&Life::depth_steps>, kNone, closed_range(1, 100), only_with<"life.interval_h">, kShared, "number of depth steps from 0 to the last depth at which a gearbox is simulated; signals in between are interpolated"},
    {"life", "torque_scatter", number<&Life::torque_scatter>, kNone, closed_range(0, 1), only_with<"life.interval_h">, kShared, "rms relative difference of a record's torque from its gearbox's (standard deviation of the logarithm)"},
    {"life", "speed_scatter", number<&Life::speed_scatter>, kNone, closed_range(0, 0.3), only_with<"life.interval_h">, kShared, "the same as torque_scatter for the speed"},
    {"life", "gain_scatter", number<&Life::gain_scatter>, kNone, closed_range(0, 1), only_with<"life.interval_h">, kShared, "the same as torque_scatter for the sensor's gain"},
    {"life", "noise_scatter", number<&Life::noise_scatter>, kNone, closed_range(0, 1), only_with<"life.interval_h">, kShared, "the same as torque_scatter for the noise of accelerometer and encoders"},
    {"life", "interpolation_tolerance", number<&Life::interpolation_tolerance>, kNone, inside(0, 1), only_with<"life.interval_h">, kShared, "largest error of signals interpolated between torques and speeds, relative to the change made by a crack of half of last_depth_mm; numbers of torques and speeds that are not given are raised from 2 until pilot gearboxes keep it"},
    {"life", "integrated_torques", integer<&Life::polynomial_torques>, kNone, closed_range(3, 17), only_with<"life.interval_h">, kShared, "number of torques at which a gearbox is simulated if the torque varies between its records; signals are interpolated by one polynomial through them. Without it: as many as interpolation_tolerance needs"},
    {"life", "integrated_speeds", integer<&Life::polynomial_speeds>, kNone, closed_range(3, 17), only_with<"life.interval_h">, kShared, "the same as integrated_torques for the speed"},
    {"life", "distinct_torques", integer<&Life::distinct_torques>, kNone, closed_range(2, 33), only_with<"life.interval_h">, kShared, "instead of integrated_torques: number of torques, equally frequent and with the stated scatter, that records have; each is simulated, and nothing is interpolated between them. Without scatter there is one"},
    {"life", "distinct_speeds", integer<&Life::distinct_speeds>, kNone, closed_range(2, 33), only_with<"life.interval_h">, kShared, "the same as distinct_torques for the speed"},
    {"life", "record_s", number<&Life::record_s>, kS, kPositive, only_with<"life.interval_h">, kShared, "length of a recording, by default that of [sensor]; without one, a recording has as many planet turns as the ring has teeth, in which every tooth of a planet meets every ring tooth that it can meet"},
    {"life", "recordings", integer<&Life::recordings>, kNone, closed_range(1, 1000), only_with<"life.interval_h">, kShared, "number of recordings that a record averages; short ones each begin with other teeth in mesh"},

    {"numerics", "tolerance", number<&Numerics::tolerance>, kNone, kTolerance, integration, kShared, "relative error of the features for which integrator, steps and settle_tolerance are chosen on pilot gearboxes, unless they are given; 0: not chosen"},
    {"numerics", "scatter_tolerance", number<&Numerics::scatter_tolerance>, kNone, kTolerance, integration, kShared, "error of the features over their scatter between healthy gearboxes, for which steps_per_mesh and mass_scaling_Hz of central-difference are chosen on sixteen of them; 0: not chosen"},
    {"numerics", "paired_gearboxes", integer<&Numerics::paired_gearboxes>, kNone, closed_range(0, 1e6), integration, kShared, "healthy gearboxes, and as many faulty ones, that a run computes again with finer steps, to predict the size that these would find; 0, or at least 8"},
    {"numerics", "verify", boolean<&Numerics::verify>, kNone, kAny, integration, kShared, "integrate eight gearboxes again with finer steps after a run and report the differences; always done with a tolerance"},
    {"numerics", "integrator", choice_or_auto<&Numerics::integrator>(kIntegrators), kNone, kAny, integration, kShared, "time integration method; auto: rk4, or sdirk3 if rk4 would need too many steps"},
    {"numerics", "precision", choice<&Numerics::precision>(kPrecisions), kNone, kAny, integration, kShared, "floating-point precision of the time integration; single: only with rk4 and central-difference, and orbits converge to 1e-5 at best"},
    {"numerics", "grid", choice<&Numerics::grid>(kStepGrids), kNone, kAny, integration, kShared, "time steps: uniform, or graded (fine after each contact transition, coarse where the response is smooth; only with implicit integrators)"},
    {"numerics", "grid_tolerance", number<&Numerics::grid_tolerance>, kNone, inside(0, 1), integration, kShared, "rms error of the signals of pilot gearboxes, from which graded steps are chosen"},
    {"numerics", "steps_per_mesh", integer<&Numerics::steps_per_mesh>, kNone, closed_range(0, 1e6), integration, kShared, "time steps in a mesh period; 0: chosen on pilot gearboxes of the ensemble"},
    {"numerics", "settle_tolerance", number<&Numerics::convergence_tolerance>, kNone, inside(0, 1), integration, kShared, "relative change at which an orbit counts as converged to the periodic steady state"},
    {"numerics", "mass_scaling_Hz", number<&Numerics::mass_scaling_Hz>, kHz, kNotNegative, integration, kShared, "natural frequency to which faster modes of the nominal gearbox are lowered by additional inertia, so that steps may be longer (selective mass scaling, only with central-difference); 0: none"},
    {"numerics", "stiffness_tolerance", number<&Numerics::stiffness_tolerance>, kNone, kTolerance, may, kShared, "error accepted when the series of a stiffness curve is cut off, relative to the largest term; 0: 1e-13, for a faulty tooth pair 4e-10"},
    {"numerics", "max_meshes", integer<&Numerics::max_meshes>, kNone, closed_range(0, 1e6), integration, kShared, "largest number of mesh periods for converging to the periodic orbit; 0: derived from the damping"},
    {"numerics", "horizon", choice<&Numerics::horizon>(kHorizons), kNone, kAny, may, kShared, "strategy of time integration: repeat the mesh period of the periodic orbit, superpose the effects of each gear's tooth errors, or integrate all mesh periods"},
    {"numerics", "lanes", integer<&Numerics::lanes>, kNone, closed_range(1, 16), may, kShared, "gearboxes integrated in lockstep: 8, 4 or 1; in single precision also 16, the default there"},
    {"numerics", "threads", integer<&Numerics::threads>, kNone, closed_range(0, 65536), may, kShared, "number of threads; 0: the value of OMP_NUM_THREADS, or else one per processor"},
    {"numerics", "instruction_set", choice_or_auto<&Numerics::instruction_set>(kInstructionSets), kNone, kAny, may, kShared, "instruction set of the kernels"},

    {"ensemble", "instances", integer<&Ensemble::instances>, kNone, closed_range(1, 1e9), always, kShared, "number of gearboxes over all fault sizes"},
    {"ensemble", "threshold_instances", integer<&Ensemble::threshold_instances>, kNone, closed_range(1, 1e9), always, kShared, "number of additional healthy gearboxes that set the thresholds"},
    {"ensemble", "threshold_records", integer<&Ensemble::threshold_records>, kNone, closed_range(1, 10000), may, kShared, "number of records of each of these healthy gearboxes: the same vibration with new sensor and encoder noise (and another first tooth if records have a length), for false-alarm rates below one in the number of gearboxes"},
    {"ensemble", "threshold_tilt", boolean<&Ensemble::importance_sampling>, kNone, kAny, white_records, kShared, "importance sampling of the noise by exponential tilting: three in four of those records have a part of the noise sampled with a higher probability of an alarm, and a weight that corrects for it. For false-alarm rates down to 1e-6 of accelerometer features whose alarms are caused by noise rather than by the gearbox"},
    {"ensemble", "seed", integer<&Ensemble::seed>, kNone, kNotNegative, always, kShared, "seed of all random numbers"},
    {"ensemble", "checkpoint_s", number<&Ensemble::checkpoint_s>, kS, closed_range(0, 1e6), may, kShared, "seconds between two checkpoints"},
};
// clang-format on

}  // namespace

std::span<const Key> run_keys() {
    return kRunKeys;
}

}  // namespace gearpod::mc
