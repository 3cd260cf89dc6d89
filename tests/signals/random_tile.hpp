// A tile of random mesh periods, for tests of the signal chain.
#pragma once

#include "signals/tile_signals.hpp"
#include "tests/test.hpp"

namespace gearpod::signals {

// Selects `count` of eight lanes, from lane `first` on.
inline machine::AlignedVector lanes_of(const machine::AlignedVector& eight, int first, int count) {
    machine::AlignedVector part(eight.size() / 8 * count);
    for (std::size_t i = 0; i < part.size(); ++i) {
        part[i] = eight[i / count * 8 + first + i % count];
    }
    return part;
}

struct RandomTile {
    std::vector<machine::AlignedVector> accel, te;
    TileSignals signals;

    RandomTile(int lanes, int planets, int phases, int meshes, unsigned seed = 1) {
        std::mt19937_64 engine(seed);
        std::normal_distribution<double> normal;
        signals = {lanes, planets, phases, {}, {}};
        accel.resize(meshes);
        te.resize(meshes);
        for (int mesh = 0; mesh < meshes; ++mesh) {
            accel[mesh].resize(static_cast<std::size_t>(phases) * 2 * planets * lanes);
            te[mesh].resize(static_cast<std::size_t>(phases) * lanes);
            std::ranges::generate(accel[mesh], [&] { return normal(engine); });
            std::ranges::generate(te[mesh], [&] { return 1e-5 * normal(engine); });
            signals.accel.push_back(accel[mesh].data());
            signals.te.push_back(te[mesh].data());
        }
    }
    // Copies `count` lanes of a tile of eight, from lane `first` on.
    RandomTile(const RandomTile& other, int first, int count)
        : RandomTile(count, other.signals.planets, other.signals.phases, other.signals.meshes()) {
        for (std::size_t mesh = 0; mesh < accel.size(); ++mesh) {
            std::ranges::copy(lanes_of(other.accel[mesh], first, count), accel[mesh].begin());
            std::ranges::copy(lanes_of(other.te[mesh], first, count), te[mesh].begin());
        }
    }
    RandomTile(const RandomTile&) = delete;
    RandomTile& operator=(const RandomTile&) = delete;
};

// Timeline of a crack event: meshes 1..events from mesh `first` on, in a pattern of `length`
// meshes.
inline Timeline event_timeline(int length, int first, int events) {
    Timeline timeline(length, 0);
    for (int e = 0; e < events; ++e) {
        timeline[(first + e) % length] = e + 1;
    }
    return timeline;
}

}  // namespace gearpod::signals
