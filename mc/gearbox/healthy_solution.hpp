// Integrates gearboxes once without a fault, then again for any fault size. A fault changes only
// its passages and the mesh periods of decay after them. Only these are integrated again if
// integrates_perturbation_only (solution_choice.hpp).
#pragma once

#include <span>
#include <vector>

#include "mc/gearbox/gearbox_tile.hpp"

namespace gearpod::mc {

// Healthy reference solution of a tile, and its solutions with a fault. The scene, the path and the
// ids must outlive it.
class HealthySolution {
  public:
    // `inputs` holds the inputs of the gearboxes in `ids`; their fault sizes are ignored. The
    // sensor gain is taken as 1, because the records apply it later.
    HealthySolution(const Scene& scene, const signals::PathGrid& path,
                    std::span<const GearboxId> ids, std::vector<InstanceInputs> inputs, int fewest);

    // Sensor signal, transmission error and status of each gearbox. A gearbox that failed has no
    // signals.
    struct Signals {
        std::vector<LaneSignals> lane;
        std::vector<Status> status;
    };
    const Signals& healthy() const { return healthy_; }
    // Signals of all gearboxes with a fault of this size (SI units). They equal those of a full
    // integration within the convergence tolerance.
    Signals with_fault(double size) const;

  private:
    std::vector<InstanceInputs> inputs_of(double size) const;
    Signals signals_of(const GearboxTile& tile) const;
    void change_te(const GearboxTile& changed, std::vector<LaneSignals>& lanes) const;
    void change_sensor(const GearboxTile& changed, std::vector<LaneSignals>& lanes) const;

    const Scene& scene_;
    const signals::PathGrid& path_;
    const std::span<const GearboxId> ids_;
    std::vector<InstanceInputs> inputs_;  // one per lane
    lockstep::SpanStates states_;
    std::vector<machine::AlignedVector> te_;  // MeshRecord::te of every mesh period
    Signals healthy_;
};

}  // namespace gearpod::mc
