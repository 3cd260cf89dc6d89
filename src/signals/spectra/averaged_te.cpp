#include "signals/spectra/averaged_te.hpp"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

namespace gearpod::signals {
namespace {

// For every distinct mesh, the share of tooth j's Z_r turns that show it.
std::vector<double> shares_of_tooth(int j, const Timeline& timeline, const SpanLayout& layout,
                                    int meshes) {
    std::vector<double> share(meshes, 0.0);
    for (long i = 0; i < layout.ring_teeth; ++i) {
        const long k = j + i * layout.planet_teeth;
        share[timeline[k % static_cast<long>(timeline.size())]] += 1.0;
    }
    for (double& s : share) {
        s /= layout.ring_teeth;
    }
    return share;
}

void remove_lane_means(machine::AlignedVector& values, int lanes) {
    std::vector<double> mean(lanes, 0.0);
    const std::size_t points = values.size() / lanes;
    for (std::size_t i = 0; i < points; ++i) {
        for (int l = 0; l < lanes; ++l) {
            mean[l] += values[i * lanes + l];
        }
    }
    for (std::size_t i = 0; i < points; ++i) {
        for (int l = 0; l < lanes; ++l) {
            values[i * lanes + l] -= mean[l] / static_cast<double>(points);
        }
    }
}

}  // namespace

void average_te(const TileSignals& tile, const Timeline& timeline, const SpanLayout& layout,
                int te_phases, machine::AlignedVector& te_turn) {
    check_tile(tile, timeline);
    if (te_phases < 1 || tile.phases % te_phases != 0 || layout.meshes() < 1) {
        throw std::invalid_argument(
            fmt::format("averaged transmission error: {} encoder samples per mesh of {} samples, "
                        "{} meshes",
                        te_phases, tile.phases, layout.meshes()));
    }
    const int lanes = tile.lanes;
    const int stride = tile.phases / te_phases * lanes;
    te_turn.assign(static_cast<std::size_t>(layout.planet_teeth) * te_phases * lanes, 0.0);
    for (int j = 0; j < layout.planet_teeth; ++j) {
        const std::vector<double> share = shares_of_tooth(j, timeline, layout, tile.meshes());
        double* out = te_turn.data() + static_cast<std::size_t>(j) * te_phases * lanes;
        for (int mesh = 0; mesh < tile.meshes(); ++mesh) {
            if (share[mesh] == 0.0) {
                continue;
            }
            for (int p = 0; p < te_phases; ++p) {
                for (int l = 0; l < lanes; ++l) {
                    out[p * lanes + l] += share[mesh] * tile.te[mesh][p * stride + l];
                }
            }
        }
    }
    remove_lane_means(te_turn, lanes);
}

}  // namespace gearpod::signals
