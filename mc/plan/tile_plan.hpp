// Plan of the records of a tile: how its realizations are drawn, built and solved, and what is
// recorded and measured of them.
#pragma once

#include <memory>
#include <vector>

#include "mc/plan/feature_plan.hpp"
#include "mc/plan/gearbox_plan.hpp"
#include "mc/plan/record_plan.hpp"
#include "mc/plan/sampling.hpp"
#include "mc/plan/sensor_plan.hpp"
#include "mc/plan/solve_plan.hpp"

namespace gearpod::mc {

// Immutable. Copies share all parts but the small ones.
struct TilePlan {
    const DrawPlan& draw() const { return sampler->plan(); }
    // The same plan with at most this many recorded mesh periods, which the signal repeats. Used to
    // measure the cost of time integration.
    TilePlan recording_at_most(int meshes) const;
    // The same plan whose records are the span, whatever their length. Lives cut records from it.
    TilePlan of_span() const;

    std::shared_ptr<const Sampler> sampler;
    std::shared_ptr<const GearboxPlan> gearbox;
    std::shared_ptr<const SolvePlan> solve;
    FeaturePlan features;
    // The first sensor and the additional ones.
    std::shared_ptr<const std::vector<SensorPlan>> sensors;
    RecordPlan record;
};

}  // namespace gearpod::mc
