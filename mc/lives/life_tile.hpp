// Some gearboxes of a study from their draws to the features of all their records: marched once at
// each of a few depths and torques, their records composed.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "mc/gearbox/gearbox_tile.hpp"
#include "mc/lives/crack_life.hpp"
#include "mc/results/results_file.hpp"

namespace gearpod::mc {

struct GearboxLife {
    Status status = Status::ok;
    LifeHistory history;
    std::vector<std::vector<double>> values;  // [feature][record]; none of a gearbox that failed
};

// What interpolation takes, the largest of some gearboxes, rms over the span: in the middle of the
// first and the last step of depth, over what the crack changes there, and without a crack between
// the torques, over the signal.
struct InterpolationErrors {
    double first_m = 0.0, first = 0.0;  // depth, error
    double last_m = 0.0, last = 0.0;
    double torque = 0.0;  // 0 where all records have one torque
};

// How long what belongs to gearboxes and what belongs to records took, seconds of processor time.
struct LifeCosts {
    double gearboxes = 0.0, records = 0.0;
    long gearbox_count = 0, record_count = 0;
};

class LifeTiles {
  public:
    // Throws SceneError for what records cannot be composed of.
    explicit LifeTiles(const Scene& scene);

    std::vector<GearboxLife> run(std::span<const GearboxId> ids, bool cracked,
                                 LifeCosts& costs) const;

    InterpolationErrors interpolation_errors(std::span<const GearboxId> ids) const;

    // Gearboxes in lockstep.
    std::size_t lanes() const;

  private:
    class Lane;
    // Sensor and transmission error of every gearbox at a depth and a factor on its torque.
    std::vector<LaneSignals> march(std::span<const GearboxId> ids, double depth_m, double torque,
                                   std::vector<Status>& status) const;
    InstanceInputs inputs(const GearboxId& id) const;
    double depth(int step) const;
    // Of factors on the torque: those that are marched, and how much of each makes up another.
    std::vector<double> torques() const;
    std::vector<double> shares(double torque) const;

    const Scene& scene_;
    const Sampler sampler_;
    const signals::PathGrid path_;
    const CrackLife crack_;
};

}  // namespace gearpod::mc
