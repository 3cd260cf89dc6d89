// Index types that cannot be mixed up: a number becomes an id only explicitly, an id never becomes
// another kind of id, and every id indexes arrays as an int does.
#pragma once

#include <concepts>
#include <utility>

namespace gearpod {

template <class Kind>
class Id {
  public:
    constexpr Id() = default;
    constexpr explicit Id(std::integral auto index) : index_(static_cast<int>(index)) {}

    constexpr operator int() const { return index_; }
    constexpr Id& operator++() {
        ++index_;
        return *this;
    }
    friend constexpr bool operator<(Id id, std::integral auto count) {
        return std::cmp_less(id.index_, count);
    }

  private:
    int index_ = 0;
};

using PairId = Id<struct PairKind>;      // gear pair
using LaneId = Id<struct LaneKind>;      // realization of a tile
using PlanetId = Id<struct PlanetKind>;  // planet, counted from 0
using SensorId = Id<struct SensorKind>;  // sensor, counted from 0

// Gear pairs of a planet: all sun-planet pairs come first, then all ring-planet pairs.
constexpr PairId sun_pair(PlanetId planet) {
    return PairId{0 + planet};
}
constexpr PairId ring_pair(PlanetId planet, int planets) {
    return PairId{planets + planet};
}
constexpr PlanetId planet_of(PairId pair, int planets) {
    return PlanetId{pair % planets};
}

}  // namespace gearpod
