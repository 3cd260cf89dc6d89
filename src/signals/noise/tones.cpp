#include "signals/noise/tones.hpp"

#include <fmt/format.h>

#include <numbers>
#include <stdexcept>

namespace gearpod::signals {
namespace {

struct Phasor {
    double sine;
    double cosine;
};

// Phasor at `turns` times `count`, plus an angle. Whole turns are removed before the product is
// rounded.
Phasor phasor(double turns, long count, double angle) {
    const double whole = std::rint(turns * static_cast<double>(count));
    const double rest = std::fma(turns, static_cast<double>(count), -whole);
    const double radians = std::fma(2.0 * std::numbers::pi, rest, angle);
    return {std::sin(radians), std::cos(radians)};
}

// Phasors sine[i * stride], cosine[i * stride] at first + i steps of `turns`. Each is the product
// of two phasors, one for every 64th step and one for the steps between, so that rounding errors do
// not accumulate.
void fill_phasors(double turns, double angle, long first, int count, std::size_t stride,
                  double* sine, double* cosine) {
    constexpr int kBetween = 64;
    Phasor between[kBetween];
    for (int i = 0; i < kBetween; ++i) {
        between[i] = phasor(turns, i, 0.0);
    }
    // Blocks begin at multiples of 64 whatever the first step, so that any part of a span has the
    // same bits.
    Phasor block{};
    for (long i = 0; i < count; ++i) {
        const long step = first + i;
        if (i == 0 || step % kBetween == 0) {
            block = phasor(turns, step - step % kBetween, angle);
        }
        const Phasor& fine = between[step % kBetween];
        sine[i * stride] = std::fma(block.sine, fine.cosine, block.cosine * fine.sine);
        cosine[i * stride] = std::fma(block.cosine, fine.cosine, -(block.sine * fine.sine));
    }
}

}  // namespace

ToneTable::ToneTable(const Tones& tones, int lanes, int first_mesh, int meshes, int phases) {
    const auto width = static_cast<std::size_t>(lanes);
    const std::size_t values = tones.frequency_Hz.size();
    if (lanes < 1 || values % width != 0 || tones.amplitude_m_s2.size() != values ||
        tones.phase_rad.size() != values || (values > 0 && tones.mesh_period_s.size() != width) ||
        first_mesh < 0 || meshes < 0 || phases < 1) {
        throw std::invalid_argument(fmt::format(
            "tones: {} frequencies, {} amplitudes, {} phases, {} mesh periods for {} lanes", values,
            tones.amplitude_m_s2.size(), tones.phase_rad.size(), tones.mesh_period_s.size(),
            lanes));
    }
    tones_ = static_cast<int>(values / width);
    const auto span = static_cast<std::size_t>(meshes);
    mesh_sine_.resize(values * span);
    mesh_cosine_.resize(values * span);
    phase_sine_.resize(values * static_cast<std::size_t>(phases));
    phase_cosine_.resize(values * static_cast<std::size_t>(phases));
    for (std::size_t i = 0; i < values; ++i) {
        const std::size_t lane = i % width;
        const double turns = tones.frequency_Hz[i] * tones.mesh_period_s[lane];
        const std::size_t first = i / width * span * width + lane;
        fill_phasors(turns, 0.0, first_mesh, meshes, width, &mesh_sine_[first],
                     &mesh_cosine_[first]);
        fill_phasors(turns / phases, tones.phase_rad[i], 0, phases, values, &phase_sine_[i],
                     &phase_cosine_[i]);
    }
    for (std::size_t i = 0; i < phase_sine_.size(); ++i) {
        phase_sine_[i] *= tones.amplitude_m_s2[i % values];
        phase_cosine_[i] *= tones.amplitude_m_s2[i % values];
    }
}

void add_tones(const Tones& tones, int lane, int phases, std::span<double> samples) {
    const std::size_t lanes = tones.mesh_period_s.size(), first = static_cast<std::size_t>(lane);
    Tones lane_tones;
    lane_tones.mesh_period_s = {tones.mesh_period_s[first]};
    for (std::size_t i = first; i < tones.frequency_Hz.size(); i += lanes) {
        lane_tones.frequency_Hz.push_back(tones.frequency_Hz[i]);
        lane_tones.amplitude_m_s2.push_back(tones.amplitude_m_s2[i]);
        lane_tones.phase_rad.push_back(tones.phase_rad[i]);
    }
    const std::size_t per_mesh = static_cast<std::size_t>(phases),
                      meshes = samples.size() / per_mesh;
    const ToneTable table(lane_tones, 1, 0, static_cast<int>(meshes), phases);
    const auto count = static_cast<std::size_t>(table.tones());
    for (std::size_t i = 0; i < samples.size(); ++i) {
        for (std::size_t t = 0; t < count; ++t) {
            const std::size_t mesh = t * meshes + i / per_mesh, phase = i % per_mesh * count + t;
            samples[i] = plus_tone(samples[i], table.mesh_sine()[mesh], table.mesh_cosine()[mesh],
                                   table.phase_sine()[phase], table.phase_cosine()[phase]);
        }
    }
}

}  // namespace gearpod::signals
