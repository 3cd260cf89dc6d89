// Purposes of random numbers. Each purpose has its own stream, so a new one changes no others.
#pragma once

#include <cstdint>
#include <string_view>

#include "mc/random/fnv.hpp"

namespace gearpod::mc {

// The numbers are stable, because results depend on them: FNV-1a hashes of the texts. A test lists
// all of them.
enum class StreamPurpose : std::uint64_t {
    // Inputs of a gearbox. The first three, and those of bearings, are completed by
    // with_suffix().
    random_input = fnv1a(""),                           // and a key of [random]
    table_row = fnv1a("random.rows."),                  // and the number of a table
    sobol_scrambling = fnv1a("ensemble.sampling."),     // and a key of [random]
    baseline_torque = fnv1a("operation.torque"),        // relative to the test record
    planets = fnv1a("gearbox.planets"),                 // differences between planets
    pitch_errors = fnv1a("gearbox.pitch_error.teeth"),  // of single teeth
    index_waves = fnv1a("gearbox.index_wave.gears"),    // waves and eccentricity of gears
    profile_slopes = fnv1a("gearbox.profile_slope.teeth"),
    torque_noise = fnv1a("operation.torque_noise.knots"),
    speed_noise = fnv1a("operation.speed_noise.knots"),
    tone_phases = fnv1a("sensor.tones.phase"),
    bearing_impulses = fnv1a("sensor.bearings."),  // and the number of a bearing
    stage_start = fnv1a("sensor.stages."),         // position of a neighbouring stage; and its name
    record_start = fnv1a("sensor.record.start"),   // tooth position at which a record begins
    assembled_teeth = fnv1a("gearbox.assembly.teeth"),  // of a baseline's assembly
    // Noise of records.
    sensor_noise = fnv1a("noise.sensor"),
    sensor_noise_direction = fnv1a("noise.sensor.direction"),  // from folded noise to samples
    background_noise = fnv1a("noise.background"),
    sensor_noise_kind = fnv1a("noise.sensor.tilt"),  // kind of importance sampling
    encoder_noise = fnv1a("noise.encoder"),
    // Lives.
    life_records = fnv1a("life.records"),  // torque, gain and noise of records
    life_speeds = fnv1a("life.speeds"),
    life_recording_starts = fnv1a("life.starts"),
    reference_noise = fnv1a("life.pattern.noise"),  // reference pattern of a gearbox
    reference_torques = fnv1a("life.pattern.torque"),
    reference_speeds = fnv1a("life.pattern.speed"),
    // Calibration; completed by with_suffix().
    calibration_prior = fnv1a("calibrate.prior."),  // and the key of a calibrated input
    calibration_record = fnv1a("calibrate."),       // and the numbers of background and record
    dataset_split = fnv1a("dataset.split"),  // of a gearbox; recorded ones add "." and the name
    // Synthetic data of forecasts.
    forecast_signals = fnv1a("life.made_up.signals"),
    forecast_rows = fnv1a("analysis.trial"),
};

// One of several streams of a purpose: the hash of its text and the suffix.
constexpr StreamPurpose with_suffix(StreamPurpose purpose, std::string_view suffix) {
    return StreamPurpose{fnv1a(suffix, static_cast<std::uint64_t>(purpose))};
}

}  // namespace gearpod::mc
