// Gearboxes that are marched once without a fault, and then at any size of it: where every mesh is
// marched for itself, a fault changes but those that it passes and some behind, and no others are
// marched again.
#pragma once

#include <span>
#include <vector>

#include "mc/gearbox/gearbox_tile.hpp"

namespace gearpod::mc {

// Whether a fault marches but what differs from the march without; otherwise all of it.
bool marches_changes_alone(const Scene& scene);

// The scene, the path and the ids must outlive it.
class HealthyMarch {
  public:
    // `inputs`: of the gearboxes in `ids`, with whatever fault. Their gain is taken as 1: the
    // records amplify.
    HealthyMarch(const Scene& scene, const signals::PathGrid& path, std::span<const GearboxId> ids,
                 std::vector<InstanceInputs> inputs, int fewest);

    // Of the gearboxes: sensor and transmission error, and how the march ended; a gearbox that
    // failed has no signals.
    struct Signals {
        std::vector<LaneSignals> lane;
        std::vector<Status> status;
    };
    const Signals& healthy() const { return healthy_; }
    // All with a fault of that size, SI. Changed meshes are those of a march of all of them but for
    // the settling tolerance.
    Signals with_fault(double size) const;

  private:
    std::vector<InstanceInputs> inputs_of(double size) const;
    Signals signals_of(const GearboxTile& tile) const;
    void change_te(const GearboxTile& changed, std::vector<LaneSignals>& lanes) const;
    void change_sensor(const GearboxTile& changed, std::vector<LaneSignals>& lanes) const;

    const Scene& scene_;
    const signals::PathGrid& path_;
    const std::span<const GearboxId> ids_;
    std::vector<InstanceInputs> inputs_;  // one a lane
    std::vector<lockstep::TileState> states_;
    std::vector<machine::AlignedVector> te_;  // of every mesh: MeshRecord::te
    Signals healthy_;
};

}  // namespace gearpod::mc
