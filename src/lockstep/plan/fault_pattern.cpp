#include "lockstep/plan/fault_pattern.hpp"

#include <algorithm>
#include <cmath>

namespace gearpod::lockstep {
namespace {

// Passage of the tooth pair of `pair` that engages nearest to `due` (mesh periods), shifted into
// [0, length).
FaultPassage passage_near(const PairSet& pairs, int pair, double due, int length, int curve) {
    const double start = pairs.start[static_cast<std::size_t>(pair)];
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
            passage_near(pairs, first_pair + n, first + order * turn * teeth, teeth, 0));
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

FaultPattern planet_fault_pattern(const PairSet& pairs, int planet, PlanetSide side,
                                  int planet_teeth) {
    const int sun_pair = planet, ring_pair = pairs.pairs() / 2 + planet;
    FaultPattern pattern;
    pattern.length = planet_teeth;
    const int first = side == PlanetSide::ring ? ring_pair : sun_pair;
    pattern.passages.push_back({first, pairs.start[static_cast<std::size_t>(first)], 0});
    if (side == PlanetSide::both) {
        const double half_turn = 0.5 * (planet_teeth + (pairs.reversed ? 1 : -1));
        const double pitch = pairs.pitch_phase(sun_pair) + half_turn;
        const double since =
            pairs.pitch_phase(ring_pair) - pairs.start[static_cast<std::size_t>(ring_pair)];
        pattern.passages.push_back(passage_near(pairs, ring_pair, pitch - since, planet_teeth, 1));
    }
    sort_passages(pattern);
    return pattern;
}

FaultPattern shaft_fault_pattern(const PairSet& pairs, int teeth) {
    return {teeth, {{0, pairs.start[0], 0}}};
}

}  // namespace gearpod::lockstep
