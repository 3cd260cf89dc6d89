#include "signals/tile_signals.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace gearpod::signals {
namespace {

constexpr int kMaxPlanets = 8;

[[noreturn]] void fail(const std::string& what) {
    throw std::invalid_argument("tile signals: " + what);
}

}  // namespace

void copy_lane(std::span<const double> interleaved, int lanes, int lane, std::span<double> out) {
    if (lane < 0 || lane >= lanes || interleaved.size() != out.size() * lanes) {
        throw std::invalid_argument(fmt::format("lane {} of {}: {} values do not fill {}", lane,
                                                lanes, interleaved.size(), out.size()));
    }
    for (std::size_t i = 0; i < out.size(); ++i) {
        out[i] = interleaved[i * lanes + lane];
    }
}

void check_tile(const TileSignals& tile, const Timeline& timeline) {
    if (!machine::is_lane_count(tile.lanes)) {
        fail(fmt::format("{} lanes; 16, 8, 4 or 1 are built", tile.lanes));
    }
    if (tile.planets < 1 || tile.planets > kMaxPlanets || tile.phases < 1) {
        fail(fmt::format("{} planets, {} phases", tile.planets, tile.phases));
    }
    if (tile.accel.size() != tile.te.size()) {
        fail(fmt::format("{} meshes of acceleration but {} of transmission error",
                         tile.accel.size(), tile.te.size()));
    }
    if (timeline.empty()) {
        fail("empty timeline");
    }
    const auto [low, high] = std::minmax_element(timeline.begin(), timeline.end());
    if (*low < 0 || *high >= tile.meshes()) {
        fail(fmt::format("timeline names meshes {}..{}, recorded are 0..{}", *low, *high,
                         tile.meshes() - 1));
    }
}

}  // namespace gearpod::signals
