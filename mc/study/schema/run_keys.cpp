// Keys of [sensor], [features], [detection], [monitoring], [life], [numerics] and [ensemble].
#include "features/feature.hpp"
#include "lockstep/integrators/facts.hpp"
#include "mc/study/keys/access.hpp"
#include "mc/study/keys/units.hpp"
#include "mc/study/schema/presence.hpp"
#include "mc/study/schema/table.hpp"

namespace gearpod::mc {
namespace {

constexpr ChoiceName kPositions[] = {name("pinion", Member::pinion), name("gear", Member::gear)};
constexpr ChoiceName kStepGrids[] = {name("uniform", StepGrid::uniform),
                                     name("graded", StepGrid::graded)};
constexpr ChoiceName kPrecisions[] = {name("double", Precision::double_precision),
                                      name("single", Precision::single_precision)};
constexpr ChoiceName kSamplings[] = {name("plain", SamplingKind::plain),
                                     name("sobol", SamplingKind::sobol)};
constexpr ChoiceName kHorizons[] = {name("reuse", Horizon::reuse),
                                    name("superpose", Horizon::superpose),
                                    name("march", Horizon::march)};
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
constexpr Range kShare = from_to(1e-9, 1 - 1e-9);
constexpr Range kTolerance = {0.0, 1.0, false, true};

std::span<const ChoiceName> feature_names() {
    static const std::vector<ChoiceName> names = [] {
        std::vector<ChoiceName> all;
        for (const features::Feature& feature : features::all_features()) {
            all.push_back({feature.name, static_cast<int>(all.size())});
        }
        return all;
    }();
    return names;
}

// clang-format off
const Key kRunKeys[] = {
    {"sensor", "sampling_Hz", number<&Sensor::sampling_Hz>, kHz, kFrequency, acceleration, kSampling, "sampling rate of the accelerometer"},
    {"sensor", "low_pass_Hz", number<&Sensor::low_pass_Hz>, kHz, kFrequency, acceleration, kSampling, "anti-alias low-pass"},
    {"sensor", "position", choice<&Sensor::position>(kPositions), kNone, kAny, fixed_shaft<acceleration_detail>, kShared, "bearing on which the sensor sits"},
    {"sensor", "path_exponent", number<&Sensor::path_exponent>, kNone, from_to(-1, 1), planetary<acceleration_detail>, kRandom, "exponent of the transmission path"},
    {"sensor", "gain", number<&Sensor::gain>, kNone, kPositive, acceleration_detail, kRandom, "what the gearbox's vibration is times before tones and noise are added: what housing and mounting make of it"},
    {"sensor", "noise_m_s2", number<&Sensor::noise_m_s2>, kMPerS2, kNotNegative, noise_rms, kRandom, "rms noise of the accelerometer: white up to half the sampling rate, whatever the low-pass"},
    {"sensor", "noise_density_m_s2_per_sqrt_Hz", number<&Sensor::noise_density_m_s2_per_sqrt_Hz>, kMPerS2RootHz, kNotNegative, noise_density, kRandom, "noise of the accelerometer by its one-sided density, as data sheets give it (1 ug/sqrt(Hz) is 9.81e-6): white before the low-pass, which it passes like the signal"},
    {"sensor", "tones", list<&Sensor::tones>, kNone, kAny, acceleration_detail, kShared, "interfering tones from elsewhere"},
    {"sensor", "tone_level", number<&Sensor::tone_level>, kNone, kNotNegative, with_tones, kRandom, "what the amplitudes of all tones are times: how loud the rest of this machine is"},
    {"sensor", "encoder_sampling_Hz", number<&Sensor::encoder_sampling_Hz>, kHz, kFrequency, always, kSampling, "sampling rate of the encoders"},
    {"sensor", "encoder_noise_arcsec", number<&Sensor::encoder_noise_rad>, kArcsec, kNotNegative, may, kRandom, "rms noise of the transmission error"},
    {"sensor", "noise_levels", ascending<&Sensor::noise_levels>, kNone, kNotNegative, may, kSampling, "factors on both noises, ascending"},

    {"features", "use", list<&Features::use>, kNone, kAny, may, kShared, "features to compute; by default the basic ones: te_rms te_kurtosis te_fc te_fm0 sensor_rms window_ratio window_z; change_... and own_... compare with the gearbox's own healthy record"},
    {"features", "tukey_taper", number<&Features::tukey_taper>, kNone, from_to(0, 1), may, kShared, "tapered fraction of the mesh window"},
    {"features", "te_harmonics", integer<&Features::te_harmonics>, kNone, from_to(1, 1000), may, kShared, "mesh harmonics in te_fm0"},
    {"features", "baseline_torque_scatter", number<&Features::baseline_torque_scatter>, kNone, from_to(0, 1), with_baseline, kShared, "rms by which the torque of a gearbox's baseline record, healthy, differs from the judged one's: of its logarithm, a share"},

    {"detection", "false_alarm_rate", number<&Detection::false_alarm_rate>, kNone, kShare, may, kShared, "share of healthy gearboxes that may alarm"},
    {"detection", "confidence", number<&Detection::confidence>, kNone, kShare, may, kShared, "confidence of the intervals"},
    {"detection", "size_edges_mm", ascending<&Detection::size_edges_m>, kMm, kNotNegative, length_edges, kShared, "edges of the size groups of a continuous fault size that is a length"},
    {"detection", "size_edges", ascending<&Detection::size_edges>, kNone, kNotNegative, number_edges, kShared, "edges of the size groups of a continuous fault size that is a pure number"},
    {"detection", "uncertain_inputs", list<&Detection::uncertain_inputs>, kNone, kAny, may, kShared, "random inputs, by key, whose distribution is what is known of one value that all gearboxes share, as calibrate finds it: what that leaves open is shown as a band of its own"},

    {"monitoring", "baseline_records", integer<&Monitoring::baseline_records>, kNone, from_to(0, 1e6), may, kShared, "a gearbox's first records, which say what is normal for it; 0: its features are judged as they are"},
    {"monitoring", "torque_regression", boolean<&Monitoring::torque_regression>, kNone, kAny, may, kShared, "what is normal for a gearbox follows the torque of its records along a straight line"},
    {"monitoring", "detectors", list<&Monitoring::detectors>, kNone, kAny, may, kShared, "what watches a gearbox's records: single, 2 of 3, ewma 0.1 (weight of the latest), cusum 0.5 (reference value), trend 100 (records it looks back); each with two-sided behind it or not"},

    {"monitoring", "false_alarms_per_1000_h", number<&Monitoring::false_alarms_per_1000_h>, kNone, kPositive, with_life, kShared, "false alarms in 1000 machine hours of healthy gearboxes that lives' thresholds are set to"},

    {"life", "interval_h", number<&Life::interval_h>, kHours, kPositive, may, kShared, "hours between two records of a gearbox; `lives` then follows gearboxes whose crack grows"},
    {"life", "records", integer<&Life::records>, kNone, from_to(1, 1e5), with_life, kShared, "records of a life at most, the baseline's included"},
    {"life", "healthy_lives", integer<&Life::healthy_lives>, kNone, from_to(1, 1e6), with_life, kShared, "healthy gearboxes that count false alarms, besides those that set the thresholds (ensemble.threshold_instances)"},
    {"life", "first_depth_mm", number<&Life::first_depth_m>, kMm, kPositive, paris_needs, kShared, "depth of the crack that is there when the baseline is known"},
    {"life", "last_depth_mm", number<&Life::last_depth_m>, kMm, kPositive, life_needs, kShared, "depth of the crack at which a life ends"},
    {"life", "paris_factor", number<&Life::paris_factor>, kNone, kPositive, paris_needs, kRandom, "C of Paris' law da/dN = C (Delta K)^m: mm a cycle at 1 MPa m^(1/2)"},
    {"life", "paris_exponent", number<&Life::paris_exponent>, kNone, from_to(1, 10), paris_needs, kRandom, "m of Paris' law"},
    {"life", "curve_h", ascending<&Life::curve_h>, kHours, kNotNegative, with_life, kShared, "in place of Paris' law: hours since the crack is there, from 0 on, at which its depth is given"},
    {"life", "curve_depth_mm", ascending<&Life::curve_depth_m>, kMm, kPositive, curve_needs, kShared, "depths at these hours; linear between"},
    {"life", "curve_pace", number<&Life::curve_pace>, kNone, kPositive, with_curve, kRandom, "how many times as fast as that curve a gearbox's crack grows; by default 1"},
    {"life", "fracture_toughness_MPa_m05", number<&Life::fracture_toughness_Pa_m05>, kMPaRootM, kPositive, with_life, kShared, "stress intensity at which what is left of the tooth breaks; without it the last depth ends a life"},
    {"life", "depth_steps", integer<&Life::depth_steps>, kNone, from_to(1, 100), with_life, kShared, "steps of depth, from none to the last, at which a gearbox is marched; signals between are interpolated"},
    {"life", "torque_scatter", number<&Life::torque_scatter>, kNone, from_to(0, 1), with_life, kShared, "rms by which a record's torque differs from its gearbox's: of its logarithm, a share"},
    {"life", "speed_scatter", number<&Life::speed_scatter>, kNone, from_to(0, 0.3), with_life, kShared, "the same of the speed"},
    {"life", "gain_scatter", number<&Life::gain_scatter>, kNone, from_to(0, 1), with_life, kShared, "the same of the sensor's gain"},
    {"life", "noise_scatter", number<&Life::noise_scatter>, kNone, from_to(0, 1), with_life, kShared, "the same of both noises"},
    {"life", "marched_torques", integer<&Life::marched_torques>, kNone, from_to(2, 16), with_life, kShared, "torques at which a gearbox is marched where its records' torque varies, by default 2; signals between are interpolated"},
    {"life", "marched_speeds", integer<&Life::marched_speeds>, kNone, from_to(2, 16), with_life, kShared, "the same of the speed"},
    {"life", "record_s", number<&Life::record_s>, kS, kPositive, with_life, kShared, "length of a recording; without it or record_turns every tooth of a planet meets every tooth of the ring once"},
    {"life", "record_turns", number<&Life::record_turns>, kNone, kPositive, planetary<with_life>, kShared, "the same in turns of the carrier against the fixed ring or sun"},
    {"life", "recordings", integer<&Life::recordings>, kNone, from_to(1, 1000), with_life, kShared, "recordings that one record averages; where they are short, each begins with other teeth in mesh"},

    {"numerics", "tolerance", number<&Numerics::tolerance>, kNone, kTolerance, integration, kShared, "relative error of the features for which integrator, steps and settle_tolerance are chosen on a pilot, unless given; 0: none"},
    {"numerics", "verify", boolean<&Numerics::verify>, kNone, kAny, integration, kShared, "march eight gearboxes again by finer steps after a run and report what that changes; with a tolerance always"},
    {"numerics", "integrator", choice_or_auto<&Numerics::integrator>(kIntegrators), kNone, kAny, integration, kShared, "time integration; auto: rk4, or sdirk3 where that would need too many steps"},
    {"numerics", "precision", choice<&Numerics::precision>(kPrecisions), kNone, kAny, integration, kShared, "numbers that the motion is marched in; single: with rk4 and central-difference, and orbits settle to 1e-5 at best"},
    {"numerics", "grid", choice<&Numerics::grid>(kStepGrids), kNone, kAny, integration, kShared, "uniform steps, or graded ones: fine after each contact transition, coarse where the response is quiet"},
    {"numerics", "step_tolerance", number<&Numerics::step_tolerance>, kNone, inside(0, 1), integration, kShared, "estimated error of a step over the largest motion, by which a pilot chooses the steps of bs3"},
    {"numerics", "grid_tolerance", number<&Numerics::grid_tolerance>, kNone, inside(0, 1), integration, kShared, "rms error of a pilot's signals, by which the graded grids of all integrators but bs3 are chosen"},
    {"numerics", "steps_per_mesh", integer<&Numerics::steps_per_mesh>, kNone, from_to(0, 1e6), integration, kShared, "time steps in a mesh period; 0: as many as a pilot of the ensemble needs"},
    {"numerics", "settle_tolerance", number<&Numerics::settle_tolerance>, kNone, inside(0, 1), integration, kShared, "relative change at which an orbit has settled"},
    {"numerics", "stiffness_tolerance", number<&Numerics::stiffness_tolerance>, kNone, kTolerance, may, kShared, "share of the largest value that the stiffness curves' terms may leave out; 0: 1e-13, of a faulty tooth pair 4e-10"},
    {"numerics", "face_slices", integer<&Numerics::face_slices>, kNone, from_to(0, 16), flank_gaps, kShared, "slices of a tooth across the face, each with a gap of its own, where teeth are helical or crowned and have relief, crowning or an extended contact; 0: 8"},
    {"numerics", "max_meshes", integer<&Numerics::max_meshes>, kNone, from_to(0, 1e6), integration, kShared, "mesh periods in which it must settle; 0: from the damping"},
    {"numerics", "horizon", choice<&Numerics::horizon>(kHorizons), kNone, kAny, may, kShared, "reuse settled meshes, superpose what each gear's tooth errors do, or march all"},
    {"numerics", "lanes", integer<&Numerics::lanes>, kNone, from_to(1, 16), may, kShared, "gearboxes in lockstep: 8, 4 or 1; in single precision also 16, the default there"},
    {"numerics", "threads", integer<&Numerics::threads>, kNone, from_to(0, 65536), may, kShared, "threads; 0 for what OMP_NUM_THREADS says, else for all"},
    {"numerics", "instruction_set", choice_or_auto<&Numerics::instruction_set>(kInstructionSets), kNone, kAny, may, kShared, "instruction set of the kernels"},

    {"ensemble", "instances", integer<&Ensemble::instances>, kNone, from_to(1, 1e9), always, kShared, "gearboxes over all fault sizes"},
    {"ensemble", "threshold_instances", integer<&Ensemble::threshold_instances>, kNone, from_to(1, 1e9), always, kShared, "further healthy gearboxes that set the thresholds"},
    {"ensemble", "threshold_records", integer<&Ensemble::threshold_records>, kNone, from_to(1, 10000), may, kShared, "records of each of those: the same vibration with sensor and encoder noise drawn anew, for false-alarm rates that are rarer than one in the gearboxes"},
    {"ensemble", "threshold_tilt", boolean<&Ensemble::threshold_tilt>, kNone, kAny, white_records, kShared, "three in four of those records have a stretch of noise tilted towards an alarm and a weight that undoes it: for false-alarm rates down to 1e-6 from the features of the accelerometer, where noise and not the gearbox makes the alarm"},
    {"ensemble", "seed", integer<&Ensemble::seed>, kNone, kNotNegative, always, kShared, "seed of all random numbers"},
    {"ensemble", "sampling", choice<&Ensemble::sampling>(kSamplings), kNone, kAny, may, kShared, "how random inputs are drawn: plain: every gearbox by itself; sobol: so that gearboxes fill the inputs' ranges evenly, which takes scatter from thresholds and rates where inputs rather than noise decide; a number of gearboxes a fault size that is a power of 2 fills them best"},
    {"ensemble", "checkpoint_s", number<&Ensemble::checkpoint_s>, kS, from_to(0, 1e6), may, kShared, "seconds between two checkpoints"},
    {"ensemble", "until.half_width", number<&Until::half_width>, kNone, inside(0, 0.5), may, kShared, "stop once Pd is known within this half width of its interval"},
    {"ensemble", "until.feature", choice<&Until::feature>(feature_names()), kNone, kAny, until_part, kShared, "feature whose Pd that is"},
    {"ensemble", "until.size", number<&Until::size>, kNone, kNotNegative, until_part, kShared, "fault size whose Pd that is, in the unit of the fault's size"},
    {"ensemble", "until.noise_level", number<&Until::noise_level>, kNone, kNotNegative, until_level, kShared, "noise level of that Pd, one of sensor.noise_levels"},
};
// clang-format on

}  // namespace

std::span<const Key> run_keys() {
    return kRunKeys;
}

}  // namespace gearpod::mc
