#include "signals/tile_signals.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace gearpod::signals {
namespace {

[[noreturn]] void fail(const std::string& what) {
    throw std::invalid_argument("tile signals: " + what);
}

}  // namespace

void copy_lane(std::span<const double> interleaved, int lanes, LaneId lane, std::span<double> out) {
    if (interleaved.size() != out.size() * static_cast<std::size_t>(lanes)) {
        fail(fmt::format("{} values of {} lanes do not fill {}", interleaved.size(), lanes,
                         out.size()));
    }
    copy_lanes(interleaved, lanes, lane, out);
}

void copy_lanes(std::span<const double> interleaved, int lanes, int first, std::span<double> out) {
    const std::size_t all = static_cast<std::size_t>(lanes), values = interleaved.size() / all;
    const std::size_t some = values > 0 ? out.size() / values : 0;
    if (first < 0 || first >= lanes || some > all - static_cast<std::size_t>(first) ||
        values * all != interleaved.size() || some * values != out.size()) {
        fail(fmt::format("{} values of {} lanes from lane {} on do not fill {}", interleaved.size(),
                         lanes, first, out.size()));
    }
    const double* from = interleaved.data() + first;
    for (std::size_t i = 0; i < values; ++i, from += all) {
        for (std::size_t n = 0; n < some; ++n) {
            out[n * values + i] = from[n];
        }
    }
}

void check_tile(const TileSignals& tile, const Timeline& timeline) {
    if (!machine::is_lane_count(tile.lanes)) {
        fail(fmt::format("{} lanes; 16, 8, 4 or 1 are built", tile.lanes));
    }
    if (tile.planets < 1 || tile.phases < 1) {
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
