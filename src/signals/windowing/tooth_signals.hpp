// The mapped signal of every tooth of a gear, by its statistics: Liang (2016), section 5.3.
//
// A gear with T teeth passes a point of the carrier's frame tooth by tooth, one a mesh period;
// tooth j does so at meshes j, j + T, j + 2 T, ... The tooth's signal consists of the samples of
// those meshes, each under a Tukey window one mesh period wide that begins `offset` samples late:
// windowing.hpp chooses it. For a planet T = Z_p, and Z_r turns show every tooth once on every ring
// tooth. A sun tooth comes round every T = Z_s meshes, a ring tooth every T = Z_r, and both meet
// all planets in between. The path to the sensor is the same for all teeth of a gear if its turns
// meet every one of the M_c meshes of a carrier turn alike: turns_of_span().
#pragma once

#include <span>
#include <vector>

#include "signals/tile_signals.hpp"

namespace gearpod::signals {

// A gear's turns relative to the carrier that a span is cut into.
struct GearTurns {
    int teeth = 0;
    int turns = 0;

    int meshes() const { return teeth * turns; }
    // As windowing.hpp takes it.
    SpanLayout layout() const { return {teeth, turns, 1}; }
};

// As many turns of the gear as fit into `meshes` and are whole multiples of the carrier's turn as
// well; 0 turns if none do.
GearTurns turns_of_span(int teeth, int carrier_meshes, int meshes);
// The fewest such turns: lcm(teeth, carrier_meshes) meshes.
GearTurns fewest_turns(int teeth, int carrier_meshes);

// One value per tooth.
struct ToothStatistics {
    std::vector<double> rms;       // m/s^2
    std::vector<double> kurtosis;  // about the mean, normal = 3
    std::vector<double> crest;     // largest magnitude over rms
    std::vector<double> m8a;  // eighth moment about the mean over the fourth power of the second
};

// `samples`: P a mesh period, at least those of gear.meshes(); they go on from their beginning
// after the gear's last mesh. `window`: P weights. NaN for a tooth without signal. Throws
// std::invalid_argument if the sizes disagree.
ToothStatistics tooth_statistics(std::span<const double> samples, const GearTurns& gear,
                                 std::span<const double> window, int offset);

// Divides a statistic of every tooth (of the RMS its square) by its trend over the teeth, a
// trigonometric polynomial of the orders 0 to `orders` fitted by least squares (not below a
// hundredth of the mean): for a gear that is held and whose teeth therefore stand at places of
// their own along the path. With N planets the path varies smoothly, in the mean square up to the
// order N of the carrier; a faulty tooth stands out of it.
void remove_path_trend(std::span<double> values, int orders);

}  // namespace gearpod::signals
