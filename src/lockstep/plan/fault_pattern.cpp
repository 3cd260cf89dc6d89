#include "lockstep/plan/fault_pattern.hpp"

#include <algorithm>
#include <cmath>

namespace gearpod::lockstep {
namespace {

// Passage of the tooth pair of `pair` that engages nearest to `due` (mesh periods), shifted into
// [0, length).
FaultPassage passage_near(const PairSet& pairs, PairId pair, double due, int length, int curve) {
    const double start = pairs.start[pair];
    const long meshes = std::lround(due - start) % length;
    return {pair, start + static_cast<double>(meshes < 0 ? meshes + length : meshes), curve};
}

void sort_passages(FaultPattern& pattern) {
    std::sort(pattern.passages.begin(), pattern.passages.end(),
              [](const auto& a, const auto& b) { return a.start < b.start; });
}

// Pattern of a sun or ring tooth. `order` is +1 if the tooth meets the planets in ascending order,
// -1 if in descending order.
FaultPattern central_gear_pattern(const PairSet& pairs, const PlanetPositions& planets, int teeth,
                                  int first_pair, int order) {
    FaultPattern pattern;
    pattern.length = teeth;
    const double first = pairs.start[static_cast<std::size_t>(first_pair)];
    for (int n = 0; n < planets.planets(); ++n) {
        const double turn = planets.position[static_cast<std::size_t>(n)];
        pattern.passages.push_back(
            passage_near(pairs, PairId{first_pair + n}, first + order * turn * teeth, teeth, 0));
    }
    sort_passages(pattern);
    return pattern;
}

}  // namespace

// The sun overtakes the planets in ascending order, and the planets overtake the ring in descending
// order. Both orders are swapped if the sun turns more slowly than the carrier.
FaultPattern sun_fault_pattern(const PairSet& pairs, const PlanetPositions& planets,
                               int sun_teeth) {
    return central_gear_pattern(pairs, planets, sun_teeth, 0, pairs.reversed ? -1 : 1);
}

FaultPattern ring_fault_pattern(const PairSet& pairs, const PlanetPositions& planets,
                                int ring_teeth) {
    return central_gear_pattern(pairs, planets, ring_teeth, planets.planets(),
                                pairs.reversed ? 1 : -1);
}

FaultPattern planet_fault_pattern(const PairSet& pairs, PlanetId planet, PlanetSide side,
                                  int planet_teeth) {
    const PairId with_sun = sun_pair(planet), with_ring = ring_pair(planet, pairs.pairs() / 2);
    FaultPattern pattern;
    pattern.length = planet_teeth;
    const PairId first = side == PlanetSide::ring ? with_ring : with_sun;
    pattern.passages.push_back({first, pairs.start[static_cast<std::size_t>(first)], 0});
    if (side == PlanetSide::both) {
        const double half_turn = 0.5 * (planet_teeth + (pairs.reversed ? 1 : -1));
        const double pitch = pairs.pitch_phase(with_sun) + half_turn;
        const double since =
            pairs.pitch_phase(with_ring) - pairs.start[with_ring];
        pattern.passages.push_back(passage_near(pairs, with_ring, pitch - since, planet_teeth, 1));
    }
    sort_passages(pattern);
    return pattern;
}

FaultPattern shaft_fault_pattern(const PairSet& pairs, int teeth) {
    return {teeth, {{PairId{0}, pairs.start[0], 0}}};
}

}  // namespace gearpod::lockstep
