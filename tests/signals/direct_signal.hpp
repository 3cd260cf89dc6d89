// Reference sensor signal directly from Liang (2016), Eq. 4.3.1, sample by sample with the
// library's functions, for comparison with the folded signal (sum of the squared signal over all
// planet turns at the same phase of the turn) and the synthesized signal. k is the mesh period, p
// the phase index within it.
#pragma once

#include "signals/path/transmission_path.hpp"
#include "signals/tile_signals.hpp"
#include "tests/test.hpp"

namespace gearpod::signals {

inline double direct_sample(const TileSignals& tile, int lane, const Timeline& timeline,
                            const SpanLayout& layout, const PathWindow& window, double alpha, int k,
                            int p) {
    const double pi = std::numbers::pi;
    const double theta = layout.carrier_meshes == 1
                             ? 0.0
                             : 2.0 * pi * ((k % layout.carrier_meshes) + double(p) / tile.phases) /
                                   layout.carrier_meshes;
    const double* accel = tile.accel[timeline[k % timeline.size()]];
    double y = 0.0;
    for (int n = 0; n < tile.planets; ++n) {
        // The wrap decides the side of a jump: round x = 0 to the side of exact arithmetic.
        double x = std::fmod(theta + 2.0 * pi * n / tile.planets, 2.0 * pi);
        if (2.0 * pi - x < 1e-12) {
            x = 0.0;
        }
        const double g = std::exp(alpha * (x - pi) * (x - pi)) * window.weight(x);
        const int channel = p * 2 * tile.planets + 2 * n;
        y += g * (std::sin(theta) * accel[channel * tile.lanes + lane] +
                  std::cos(theta) * accel[(channel + 1) * tile.lanes + lane]);
    }
    return y;
}

inline std::vector<double> direct_signal(const TileSignals& tile, int lane,
                                         const Timeline& timeline, const SpanLayout& layout,
                                         const PathWindow& window, double alpha) {
    std::vector<double> signal;
    for (int k = 0; k < layout.meshes(); ++k) {
        for (int p = 0; p < tile.phases; ++p) {
            signal.push_back(direct_sample(tile, lane, timeline, layout, window, alpha, k, p));
        }
    }
    return signal;
}

}  // namespace gearpod::signals
