// Implements LifeTiles::run(): integrates gearboxes from depth to depth, and measures the
// interpolation errors.
#include "machine/thread_clock.hpp"
#include "mc/lives/interpolation.hpp"
#include "mc/lives/life_lane.hpp"

namespace gearpod::mc {

std::vector<GearboxLife> LifeTiles::run(std::span<const Realization> gearboxes, bool cracked,
                                        LifeCosts& costs,
                                        std::span<InterpolationErrors> errors) const {
    std::vector<Lane> lanes;
    double start = thread_processor_s(), check_s = 0.0;
    const auto lap = [&](double& sum) {
        const double now = thread_processor_s();
        sum += now - start;
        start = now;
    };
    for (const Realization& one : gearboxes) {
        lanes.emplace_back(*this, one, cracked);
    }
    std::vector<HealthySolution> solutions;
    for (const Load& load : loads()) {
        solutions.push_back(healthy_solution(gearboxes, load));
    }
    const auto at_depth = [&](double depth_m) {
        SignalsByLoad all(gearboxes.size());
        for (const HealthySolution& one : solutions) {
            HealthySolution::Signals solution =
                depth_m > 0.0 ? one.with_fault(depth_m) : one.healthy();
            for (std::size_t lane = 0; lane < gearboxes.size(); ++lane) {
                all[lane].push_back(std::move(solution.lane[lane]));
                if (solution.status[lane] != Status::ok && !lanes[lane].failed()) {
                    lanes[lane].fail(solution.status[lane]);
                }
            }
        }
        return all;
    };
    const SignalsByLoad healthy = at_depth(0.0);
    lap(costs.gearboxes);
    InterpolationCheck check(*this, gearboxes, solutions.front(), errors);
    check.between_loads(healthy);
    lap(check_s);
    SignalsByLoad low = healthy;
    for (int step = 0; step < (cracked ? scene_.study().life.depth_steps : 1); ++step) {
        SignalsByLoad high = cracked ? at_depth(depth(step + 1)) : SignalsByLoad(gearboxes.size());
        lap(costs.gearboxes);
        if (cracked) {
            check.between_depths(step, healthy, low, high);
            lap(check_s);
        }
        for (std::size_t lane = 0; lane < gearboxes.size(); ++lane) {
            if (lanes[lane].failed()) {
                continue;
            }
            if (step == 0) {
                lanes[lane].compute_reference_pattern(healthy[lane]);
            }
            lap(costs.gearboxes);
            lanes[lane].compute_records(depth(step), depth(step + 1), healthy[lane], low[lane],
                                        high[lane]);
            lap(costs.records);
        }
        low = std::move(high);
    }
    std::vector<GearboxLife> lives;
    for (Lane& lane : lanes) {
        lives.push_back(std::move(lane).take());
        costs.record_count += static_cast<long>(lives.back().history.records.size());
    }
    costs.gearbox_count += static_cast<long>(gearboxes.size());
    lap(costs.gearboxes);
    return lives;
}

}  // namespace gearpod::mc
