// Implements LifeTiles::run(): integrates gearboxes from depth to depth, and measures the
// interpolation errors.
#include "machine/thread_clock.hpp"
#include "mc/lives/interpolation.hpp"
#include "mc/lives/life_lane.hpp"

namespace gearpod::mc {

std::vector<GearboxLife> LifeTiles::run(std::span<const GearboxId> ids, bool cracked,
                                        LifeCosts& costs,
                                        std::span<InterpolationErrors> errors) const {
    std::vector<Lane> lanes;
    double start = thread_processor_s(), looked = 0.0;
    const auto lap = [&](double& sum) {
        const double now = thread_processor_s();
        sum += now - start;
        start = now;
    };
    for (const GearboxId& id : ids) {
        lanes.emplace_back(*this, id, cracked);
    }
    std::vector<HealthyMarch> marches;
    for (const Load& load : loads()) {
        marches.push_back(march(ids, load));
    }
    const auto at_depth = [&](double depth_m) {
        Marched all(ids.size());
        for (const HealthyMarch& one : marches) {
            HealthyMarch::Signals marched = depth_m > 0.0 ? one.with_fault(depth_m) : one.healthy();
            for (std::size_t lane = 0; lane < ids.size(); ++lane) {
                all[lane].push_back(std::move(marched.lane[lane]));
                if (marched.status[lane] != Status::ok && !lanes[lane].failed()) {
                    lanes[lane].fail(marched.status[lane]);
                }
            }
        }
        return all;
    };
    const Marched healthy = at_depth(0.0);
    lap(costs.gearboxes);
    Look look(*this, ids, marches.front(), errors);
    look.between_loads(healthy);
    lap(looked);
    Marched low = healthy;
    for (int step = 0; step < (cracked ? scene_.study().life.depth_steps : 1); ++step) {
        Marched high = cracked ? at_depth(depth(step + 1)) : Marched(ids.size());
        lap(costs.gearboxes);
        if (cracked) {
            look.between_depths(step, healthy, low, high);
            lap(looked);
        }
        for (std::size_t lane = 0; lane < ids.size(); ++lane) {
            if (lanes[lane].failed()) {
                continue;
            }
            if (step == 0) {
                lanes[lane].learn(healthy[lane]);
            }
            lap(costs.gearboxes);
            lanes[lane].listen(depth(step), depth(step + 1), healthy[lane], low[lane], high[lane]);
            lap(costs.records);
        }
        low = std::move(high);
    }
    std::vector<GearboxLife> lives;
    for (Lane& lane : lanes) {
        lives.push_back(std::move(lane).take());
        costs.record_count += static_cast<long>(lives.back().history.records.size());
    }
    costs.gearbox_count += static_cast<long>(ids.size());
    lap(costs.gearboxes);
    return lives;
}

}  // namespace gearpod::mc
