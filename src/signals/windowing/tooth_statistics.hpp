// Statistics of the mapped signal of every tooth of a gear: Liang (2016), section 5.3.
//
// A gear with T teeth passes a point of the carrier's frame tooth by tooth, one per mesh period;
// tooth j passes it in mesh periods j, j + T, j + 2 T, ... The tooth's signal consists of the
// samples of those mesh periods, each under a Tukey window one mesh period wide that begins
// `offset` samples late (chosen by windowing.hpp). For a planet T = Z_p, and Z_r turns show every
// tooth once on every ring tooth. A sun tooth returns every T = Z_s meshes, a ring tooth every T =
// Z_r, and both meet all planets in between. The path to the sensor is the same for all teeth of a
// gear if its turns include each of the M_c meshes of a carrier turn equally often:
// turns_of_span().
#pragma once

#include <span>
#include <vector>

#include "signals/tile_signals.hpp"

namespace gearpod::signals {

// Turns of a gear relative to the carrier, into which a span is cut.
struct GearTurns {
    int teeth = 0;
    int turns = 0;

    int meshes() const { return teeth * turns; }
    // Span of these turns for windowing.hpp.
    SpanLayout layout() const { return {teeth, turns, 1}; }
};

// Largest number of turns of the gear that fits into `meshes` and covers whole carrier turns; 0
// turns if there is none.
GearTurns turns_of_span(int teeth, int carrier_meshes, int meshes);
// Smallest number of turns that covers whole carrier turns: lcm(teeth, carrier_meshes) meshes.
GearTurns fewest_turns(int teeth, int carrier_meshes);

// Statistics of the tooth signals, one value per tooth.
struct ToothStatistics {
    std::vector<double> rms;       // m/s^2
    std::vector<double> kurtosis;  // about the mean, normal = 3
    std::vector<double> crest;     // largest magnitude over rms
    std::vector<double> m8a;  // eighth moment about the mean over the fourth power of the second
};

// `samples` has P samples per mesh period, at least those of gear.meshes(); after the gear's last
// mesh it continues from its beginning. `window` has P weights. The statistics of a tooth without
// signal are NaN. Throws std::invalid_argument if the sizes disagree.
ToothStatistics tooth_statistics(std::span<const double> samples, const GearTurns& gear,
                                 std::span<const double> window, int offset);

// Divides a statistic of every tooth by its trend over the teeth; for the RMS, pass its square. The
// trend is a trigonometric polynomial of the orders 0 to `orders`, fitted by least squares and
// bounded below by a hundredth of its mean. It serves a gear that is held fixed, whose teeth
// therefore have different positions along the path. With N planets the mean-square path varies
// smoothly, up to order N of the carrier, and a faulty tooth stands out from it.
void remove_path_trend(std::span<double> values, int orders);

}  // namespace gearpod::signals
