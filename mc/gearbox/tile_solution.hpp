// Solution of a tile: the motion of its gearboxes alone, or together with the stages to which
// elastic shafts couple them.
#pragma once

#include <functional>
#include <optional>
#include <utility>

#include "machine/wall_clock.hpp"
#include "mc/gearbox/gearbox_tile.hpp"
#include "mc/gearbox/solution_choice.hpp"

namespace gearpod::mc {

// Returns the seconds since `start` and sets `start` to now.
inline double lap(WallClock::time_point& start) {
    const auto now = WallClock::now();
    return std::chrono::duration<double>(now - std::exchange(start, now)).count();
}

// Solves the tile by the strategy that solution_of(loads) returns.
void solve(const Scene& scene,
           const std::function<lockstep::Solution(const TileLoads&)>& solution_of,
           GearboxTile& tile);

// Receives the record of a mesh period, as lockstep::RecordedSpan::on_record.
using OnRecord = std::function<void(int, const lockstep::MeshRecord&)>;

// Solves the tile together with the coupled stages next to its gearboxes, and sets
// GearboxTile::coupled. The gearbox of stage `faulty_stage` has its fault. Requires
// check_coupling(scene).
void solve_coupled(const Scene& scene, const lockstep::RecordOptions& options,
                   const OnRecord& on_record, std::optional<std::size_t> faulty_stage,
                   GearboxTile& tile);

// Status of a gearbox whose lane ended with that status.
Status status_of(const Scene& scene, const InstanceInputs& instance, lockstep::LaneStatus status);

}  // namespace gearpod::mc
