// Integrates gearboxes once without a fault, then again for any fault size. A fault changes only
// its passages and the mesh periods of decay after them. Only these are integrated again if
// SolvePlan::perturbation_only.
#pragma once

#include <vector>

#include "mc/ensemble/gearbox/gearbox_tile.hpp"

namespace gearpod::mc {

// Healthy reference solution of a tile, and its solutions with a fault. The plan must
// outlive it.
class HealthySolution {
  public:
    // The fault sizes of the gearboxes are ignored. The sensor gain is taken as 1, because the
    // records apply it later.
    HealthySolution(const TilePlan& plan, std::vector<Realization> realizations, int fewest);

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
    std::vector<Realization> with_size(double size) const;
    Signals signals_of(const GearboxTile& tile) const;
    void change_te(const GearboxTile& changed, std::vector<LaneSignals>& lanes) const;
    void change_sensor(const GearboxTile& changed, std::vector<LaneSignals>& lanes) const;

    const TilePlan& plan_;
    std::vector<Realization> realizations_;
    int lanes_ = 0;
    lockstep::SpanStates states_;
    std::vector<machine::AlignedVector> te_;  // MeshRecord::te of every mesh period
    Signals healthy_;
};

}  // namespace gearpod::mc
