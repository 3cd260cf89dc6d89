// Cache of time integrations that a study needs repeatedly. Path exponent, gain and noise do not
// affect the motion. If the other inputs take few values, the same tiles of gearboxes recur.
#pragma once

#include <array>
#include <cstddef>
#include <map>
#include <memory>
#include <mutex>
#include <span>
#include <string>

#include "lockstep/tile/tile.hpp"
#include "mc/plan/ensemble_plan.hpp"
#include "mc/plan/sampling.hpp"
#include "mc/plan/solve_plan.hpp"

namespace gearpod::mc {

// Number of tiles that a run of these batches integrates, by group. Tiles hold as many gearboxes as
// there are lanes; tiles found in the cache are not counted. `motion_bytes`: size of the records of
// a tile.
struct IntegrationCounts {
    std::array<std::size_t, 2> integrated{};
    std::size_t kept = 0;  // results in the cache at the end
};
IntegrationCounts count_integrations(const Sampler& sampler, const SolvePlan& solve,
                                     const BatchPlan& batches, double motion_bytes);

// Results of integrated tiles, by the inputs of their gearboxes; at most 256 MB. Results that do
// not fit are integrated again. A cached result is bitwise equal to a new integration. Thread-safe.
class IntegrationCache {
  public:
    explicit IntegrationCache(const SolvePlan& solve) : active_(solve.reuses_results) {}

    // Null if these gearboxes, in this order of lanes, are not in the cache.
    std::shared_ptr<const lockstep::TileResult> find(std::span<const Realization> lanes) const;
    void keep(std::span<const Realization> lanes, const lockstep::TileResult& result) const;

    std::size_t kept() const;

  private:
    const bool active_;
    mutable std::mutex mutex_;
    mutable std::map<std::string, std::shared_ptr<const lockstep::TileResult>> results_;
    mutable std::size_t bytes_ = 0;
};

}  // namespace gearpod::mc
