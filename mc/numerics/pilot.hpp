// Pilot: a few gearboxes of a study on which solver settings are compared. Random inputs, noise and
// sampling grid are the same for all settings, so that all differences are numerical.
#pragma once

#include <functional>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "mc/ensemble/gearbox/gearbox_tile.hpp"
#include "mc/numerics/solver_setting.hpp"
#include "mc/plan/planner.hpp"
#include "mc/plan/sampling.hpp"

namespace gearpod::mc {

// Result of one solver setting for the gearboxes of a pilot.
struct PilotRecord {
    std::vector<bool> ok;                       // by gearbox
    std::vector<std::vector<double>> sensor;    // by gearbox, m/s^2, noise-free, at every sample
    std::vector<std::vector<double>> te;        // by gearbox, rad, without its mean
    std::vector<std::vector<double>> features;  // by gearbox, [feature * noise levels + level]
    int features_used = 0, levels = 0;
    int steps = 0;             // per mesh period
    double tile_meshes = 0.0;  // mesh periods integrated, summed over tiles
    // Processor time per gearbox of one thread, in full tiles with as many lanes as in a run.
    double integration_s = 0.0;  // time integration only
    double total_s = 0.0;        // sampling, stiffness, integration, signals and features

    double meshes_per_tile() const;
    // Processor time of the integration per gearbox and mesh period.
    double mesh_s() const;
};

// Gearboxes `first`, `first` + `stride`, ... of the test group: one tile of eight, independent of
// numerics.lanes, so that results do not depend on it.
std::vector<GearboxId> pilot_gearboxes(std::uint64_t first = 0, std::uint64_t stride = 1);

// Gearboxes of a study that are computed with several solver settings. Signals cover the fault's
// pattern (one mesh period without a fault), at most 200 mesh periods.
class Pilot {
  public:
    explicit Pilot(Planner planner, std::vector<GearboxId> ids = pilot_gearboxes());
    const Planner& planner() const { return planner_; }
    std::size_t size() const { return ids_.size(); }
    // Mesh periods of PilotRecord::sensor and te.
    int signal_meshes() const { return signal_meshes_; }
    // Throws SceneError.
    PilotRecord run(const Numerics& numerics) const;
    // Record of motions integrated by another program; one tile of eight lanes at a time.
    using ForeignIntegrator = std::function<lockstep::TileResult(std::span<const GearboxId>)>;
    PilotRecord record_of_integration(const ForeignIntegrator& integrate) const;

  private:
    using Tile = std::function<GearboxTile(std::span<const GearboxId>)>;
    PilotRecord record(const TilePlan& plan, int lanes, const Tile& tile_of) const;

    Planner planner_;
    std::vector<GearboxId> ids_;
    int signal_meshes_ = 0;
};

// Error of a record relative to a reference.
struct PilotError {
    // Relative L2 errors: root of the sum of squared differences over all gearboxes and samples,
    // over that of the reference (transmission error: without its mean). Infinite if a gearbox
    // failed that the reference has.
    double sensor = 0.0, te = 0.0;
    // The same over the gearboxes, by feature and noise level: [feature * noise levels + level].
    std::vector<double> relative;
    // The same in the feature's unit: root mean square, and largest error of a gearbox.
    std::vector<double> rms, largest;

    // Largest relative error of feature `f` over the noise levels.
    double feature(int f, int levels) const;
    double largest_feature() const;
    // Index of the feature with the largest relative error.
    int worst_feature(int levels) const;
    double signals() const;  // the larger of sensor and TE
};
PilotError pilot_error(const PilotRecord& record, const PilotRecord& reference);

// Reference solution of a pilot: two independent methods with their steps halved until both agree.

struct ReferenceRequest {
    double agreement = 1e-8;
    double convergence_tolerance = 1e-11;
    // Largest number of steps of one integration, over all mesh periods of the pilot's tile.
    double most_tile_steps = 2e7;
    // Limit of the processor time, s: no integration is started that would end later.
    double seconds = std::numeric_limits<double>::infinity();
};

struct Reference {
    // Richardson-extrapolated if halving the steps shows the method's order.
    PilotRecord record;
    SolverSetting first, second;  // the two that agree best, at their finest; `record`: of `first`
    PilotError agreement;  // error of the second relative to the first; empty without a second
    bool reached = false;  // true: the requested agreement was reached
};

// Reference with signals to `agreement`. All methods are integrated with their own steps and half
// of them. The two that are expected to agree at the lowest cost, judged by their orders and step
// costs, are refined further. Throws SceneError if no two methods can integrate the study.
Reference converged_reference(const Pilot& pilot, const Numerics& numerics,
                              const ReferenceRequest& request);

// Reference with features to `agreement` from one method, compared with itself at half the steps.
// Used to choose how to run, where a wrong method would be visible in every gearbox anyway. Uses
// the integrator of the study.
Reference self_converged_reference(const Pilot& pilot, const Numerics& numerics,
                                   const ReferenceRequest& request);

}  // namespace gearpod::mc
