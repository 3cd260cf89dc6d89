// Solution of a tile: the motion of its gearboxes alone, or together with the stages to which
// elastic shafts couple them.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "machine/wall_clock.hpp"
#include "mc/gearbox/solution_choice.hpp"
#include "mc/results/results_file.hpp"
#include "mc/scene/sampling.hpp"

namespace gearpod::mc {

// Returns the seconds since `start` and sets `start` to now.
inline double lap(WallClock::time_point& start) {
    const auto now = WallClock::now();
    return std::chrono::duration<double>(now - std::exchange(start, now)).count();
}

// Motion of a tile, and the time that it took.
struct TileSolution {
    lockstep::TileResult integration;
    // Samples of each coupled stage at its own sensor, [stage][gearbox][sample], m/s^2.
    std::vector<std::vector<std::vector<double>>> coupled;
    int meshes = 0;  // integrated, of all stages
    double stiffness_s = 0.0, integration_s = 0.0;
    double integration_cpu_s = 0.0;  // processor time of this thread for the time integration
};

// In the functions below `realizations` has one gearbox per lane.

// Solves a tile by the strategy that solution_of(loads) returns.
TileSolution solve(const Scene& scene, std::span<const Realization> realizations,
                   const std::function<lockstep::Solution(const TileLoads&)>& solution_of);

// Receives the record of a mesh period, as lockstep::RecordedSpan::on_record.
using OnRecord = std::function<void(int, const lockstep::MeshRecord&)>;

// Solves a tile together with the coupled stages next to its gearboxes. The gearboxes of stage
// `faulty_stage` have their fault. Requires check_stages(scene).
TileSolution solve_coupled(const Scene& scene, std::span<const Realization> realizations,
                           const lockstep::RecordOptions& options, const OnRecord& on_record,
                           std::optional<std::size_t> faulty_stage);

// Status of a gearbox whose lane ended with that status.
Status status_of(const Scene& scene, const InstanceInputs& instance, lockstep::LaneStatus status);

}  // namespace gearpod::mc
