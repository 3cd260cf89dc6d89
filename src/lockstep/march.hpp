// One mesh period of W gearboxes in lockstep: classical Runge-Kutta on the phase grid, with the
// sensor's low-pass integrated beside the motion.
#pragma once

#include <vector>

#include "dynamics/planetary_lanes.hpp"
#include "lockstep/phase_grid.hpp"
#include "lockstep/sensor_filter.hpp"
#include "lockstep/stiffness_nodes.hpp"
#include "machine/lanes.hpp"

namespace gearpod::lockstep {

// What all tiles of an ensemble share; immutable while tiles march.
struct MarchPlan {
    dynamics::PlanetaryLayout layout;
    PhaseGrid grid;
    StiffnessNodes nodes;
    double low_pass_rad_s = 0.0;
    double te_weight[3] = {};  // TE = weight . u of carrier, ring, sun (rad/m)

    int channels() const { return 2 * layout.planets; }
    std::size_t samples() const { return static_cast<std::size_t>(grid.samples); }
};

// Motion of a tile. q, v: [degree of freedom][lane]; filter: [channel][kFilterStates][lane].
struct TileState {
    machine::AlignedVector q, v, filter;
};

// One recorded mesh period. acceleration: [sample][channel][lane], m/s^2, low-passed; channels 2n
// and 2n+1 are planet n's absolute acceleration along the carrier frame's x and y. te:
// [sample][lane], rad. motion: [sample][degree of freedom][lane], m; left empty unless it is asked
// for.
struct MeshRecord {
    machine::AlignedVector acceleration, te, motion;
};

// A pair whose stiffness differs between lanes during some steps of this mesh.
struct PairOverride {
    int pair = 0;
    int first_step = 0;
    int last_step = 0;                     // one past the last
    machine::AlignedVector stiffness;      // [step - first_step][stage node][lane], N/m
    machine::AlignedVector damping_shape;  // likewise
};

// Filter coefficients of a tile: [step kind][kFilterCoefficients][lane].
template <int W>
machine::AlignedVector filter_coefficients(const MarchPlan& plan,
                                           const dynamics::PlanetaryLanes<W>& lanes);

// Marches `state` through one mesh period that begins at an integer phase and records it.
// `record` vectors must have their sizes (see make_record).
void march_mesh_1(const MarchPlan& plan, const dynamics::PlanetaryLanes<1>& lanes,
                  const machine::AlignedVector& filter, const std::vector<PairOverride>& overrides,
                  TileState& state, MeshRecord& record);
void march_mesh_8(const MarchPlan& plan, const dynamics::PlanetaryLanes<8>& lanes,
                  const machine::AlignedVector& filter, const std::vector<PairOverride>& overrides,
                  TileState& state, MeshRecord& record);

template <int W>
void march_mesh(const MarchPlan& plan, const dynamics::PlanetaryLanes<W>& lanes,
                const machine::AlignedVector& filter, const std::vector<PairOverride>& overrides,
                TileState& state, MeshRecord& record) {
    static_assert(W == 1 || W == 8);
    if constexpr (W == 1) {
        march_mesh_1(plan, lanes, filter, overrides, state, record);
    } else {
        march_mesh_8(plan, lanes, filter, overrides, state, record);
    }
}

// Allocates a record of W lanes for the plan.
MeshRecord make_record(const MarchPlan& plan, int lanes, bool with_motion);

}  // namespace gearpod::lockstep
