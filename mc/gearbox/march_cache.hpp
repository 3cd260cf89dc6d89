// Dynamics that a study needs more than once. Path exponent, gain and noise have no part in the
// march: a study whose other inputs take few values marches the same eight gearboxes again and
// again.
#pragma once

#include <array>
#include <cstddef>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>

#include "lockstep/tile/tile.hpp"
#include "mc/results/batch_rows.hpp"
#include "mc/scene/sampling.hpp"
#include "mc/scene/scene.hpp"

namespace gearpod::mc {

// How many gearboxes of the study differ in what their march depends on; none if all of them do: an
// input of the march has a continuous distribution, or every tooth or planet its own errors.
std::optional<std::size_t> distinct_marches(const Scene& scene);

// How often a run of the plan marches, by group: tiles (of as many gearboxes as there are lanes)
// whose motion no tile before them has left behind. `motion_bytes`: of a tile's records.
struct MarchCounts {
    std::array<std::size_t, 2> marched{};
    std::size_t kept = 0;  // motions in the cache at the end
};
MarchCounts count_marches(const Scene& scene, const BatchPlan& plan, double motion_bytes);

// Results of marched tiles by the inputs of their gearboxes, 256 MB of them at most; what finds no
// room is marched again. A result that is used again has the bits of its march. All threads may use
// it at once.
class MarchCache {
  public:
    explicit MarchCache(const Scene& scene) : active_(distinct_marches(scene).has_value()) {}

    // Null if these gearboxes, lane by lane, were not kept.
    std::shared_ptr<const lockstep::TileResult> find(std::span<const InstanceInputs> lanes) const;
    void keep(std::span<const InstanceInputs> lanes, const lockstep::TileResult& result) const;

    std::size_t kept() const;

  private:
    const bool active_;
    mutable std::mutex mutex_;
    mutable std::map<std::string, std::shared_ptr<const lockstep::TileResult>> results_;
    mutable std::size_t bytes_ = 0;
};

}  // namespace gearpod::mc
