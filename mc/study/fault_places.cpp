#include "mc/study/fault_places.hpp"

namespace gearpod::mc {
namespace {

std::vector<FaultPlace> places_on_planet(FaultSide side) {
    switch (side) {
        case FaultSide::sun:
            return {{0, 2}};
        case FaultSide::ring:
            return {{1, 1}};
        case FaultSide::both:
            return {{0, 2}, {1, 1}};
    }
    return {};
}

}  // namespace

std::vector<FaultPlace> fault_places(const Fault& fault) {
    switch (fault.member.value()) {
        case Member::planet:
            return places_on_planet(fault.side.value());
        case Member::ring:
            return {{1, 2}};
        case Member::gear:
            return {{0, 2}};
        case Member::sun:
        case Member::pinion:
            return {{0, 1}};
        case Member::carrier:
            return {};
    }
    return {};
}

}  // namespace gearpod::mc
