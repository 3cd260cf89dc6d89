// Calls code that is compiled for a fixed number of lanes.
#pragma once

#include <type_traits>

namespace gearpod::mc {

// Calls call(std::integral_constant<int, W>) for W = 1, 4, 8 or 16 lanes.
template <class Call>
auto with_lane_count(int lanes, Call call) {
    if (lanes == 1) {
        return call(std::integral_constant<int, 1>());
    }
    if (lanes == 4) {
        return call(std::integral_constant<int, 4>());
    }
    if (lanes == 8) {
        return call(std::integral_constant<int, 8>());
    }
    return call(std::integral_constant<int, 16>());
}

}  // namespace gearpod::mc
