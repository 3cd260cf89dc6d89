// Purposes of random numbers. Each purpose has its own stream, so a new one changes no others.
#pragma once

#include <Random123/philox.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <string_view>

#include "mc/study/random/fnv.hpp"

namespace gearpod::mc {

// The numbers are stable, because results depend on them: FNV-1a hashes of the texts. A test lists
// all of them.
enum class StreamPurpose : std::uint64_t {
    // Inputs of a gearbox. The first two, and those of bearings, are completed by
    // with_suffix().
    random_input = fnv1a(""),                           // and a key of [random]
    table_row = fnv1a("random.rows."),                  // and the number of a table
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
    // Synthetic data of forecasts.
    forecast_signals = fnv1a("life.made_up.signals"),
};

// One of several streams of a purpose: the hash of its text and the suffix.
constexpr StreamPurpose with_suffix(StreamPurpose purpose, std::string_view suffix) {
    return StreamPurpose{fnv1a(suffix, static_cast<std::uint64_t>(purpose))};
}

// Counter-based random numbers: Philox4x64-10 (Salmon et al. 2011), from Random123.
// Contract: the words depend on (seed, group, instance, purpose) only. The same instance is the
// same gearbox for any ranks, threads, lanes, order or restart.

// Two independent samples of a study: healthy gearboxes that set the thresholds, and test gearboxes
// to which the thresholds are applied.
enum class Group : std::uint64_t { threshold = 0, test = 1 };

// UniformRandomBitGenerator. Word w of a stream is word w mod 4 of block w / 4. The block is Philox
// at counter (block, instance, purpose, 0) and key (seed, group).
class Philox {
  public:
    using result_type = std::uint64_t;
    using Block = std::array<std::uint64_t, 4>;

    Philox(std::uint64_t seed, Group group, std::uint64_t instance, StreamPurpose purpose)
        : key_{{seed, static_cast<std::uint64_t>(group)}},
          counter_{{0, instance, static_cast<std::uint64_t>(purpose), 0}} {}

    static constexpr result_type min() { return 0; }
    static constexpr result_type max() { return std::numeric_limits<result_type>::max(); }

    result_type operator()() {
        if (used_ == buffer_.size()) {
            refill();
        }
        return buffer_[used_++];
    }

    void fill(std::span<std::uint64_t> words) {
        std::size_t next = 0;
        while (next < words.size()) {
            if (used_ == buffer_.size() && words.size() - next >= buffer_.size()) {
                const Engine::ctr_type block = Engine{}(counter_, key_);
                ++counter_[0];
                std::copy(block.begin(), block.end(), words.begin() + next);
                next += block.size();
            } else {
                words[next++] = (*this)();
            }
        }
    }

    // Block `number` of the stream, independent of its current position.
    Block block(std::uint64_t number) const {
        Engine::ctr_type counter = counter_;
        counter[0] = number;
        const Engine::ctr_type words = Engine{}(counter, key_);
        Block block{};
        std::copy(words.begin(), words.end(), block.begin());
        return block;
    }

  private:
    using Engine = r123::Philox4x64;

    void refill() {
        buffer_ = Engine{}(counter_, key_);
        ++counter_[0];
        used_ = 0;
    }

    Engine::key_type key_;
    Engine::ctr_type counter_;
    Engine::ctr_type buffer_{};
    std::size_t used_ = 4;
};

}  // namespace gearpod::mc
