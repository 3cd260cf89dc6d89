// Inputs and results of the integration of one mesh period of W realizations in lockstep.
#pragma once

#include <vector>

#include "dynamics/gearbox.hpp"
#include "lockstep/plan/integrator.hpp"
#include "lockstep/plan/mode_inertia.hpp"
#include "lockstep/plan/phase_grid.hpp"
#include "lockstep/plan/stiffness_nodes.hpp"
#include "machine/ids.hpp"
#include "machine/lanes.hpp"

namespace gearpod::lockstep {

// Data shared by all tiles of an ensemble; immutable during the integration.
struct IntegrationPlan {
    dynamics::GearboxLayout layout;
    Integrator integrator = kUsualExplicit;
    Precision precision = Precision::double_precision;
    PhaseGrid grid;
    dynamics::MeshLaw mesh_law = dynamics::MeshLaw::linear;
    StiffnessNodes nodes;
    double low_pass_rad_s = 0.0;
    std::vector<double> te_weight;  // TE = weight . q, one per degree of freedom (rad/m)
    ModeInertia mode_inertia = {};  // only integrators with kScalesMass use it

    int channels() const { return 2 * dynamics::sources(layout); }
    std::size_t samples() const { return static_cast<std::size_t>(grid.samples); }
};

// Motion of a tile. q, v: [degree of freedom][lane], m and m/s; filter:
// [channel][kFilterStates][lane].
struct TileState {
    machine::AlignedVector q, v, filter;
};

// One recorded mesh period.
// - acceleration: [sample][channel][lane], m/s^2, low-passed. Channels 2n and 2n+1 are the absolute
//   acceleration of source n (dynamics::sources) along x and y.
// - te: [sample][lane], rad.
// - motion: [sample][degree of freedom][lane], m; empty unless requested.
// - mesh_force: [sample][gear pair][lane], N, springs and mesh damping (MeshForces); empty unless
//   requested.
// - step_states: [step + 1][2 x degree of freedom][lane]: positions (m), then velocities (m/s), at
//   the start of every step and at the end of the last one; empty unless requested.
struct MeshRecord {
    machine::AlignedVector acceleration, te, motion, mesh_force = {};
    machine::AlignedVector step_states = {};
};

// Stiffness of a gear pair that differs between lanes, during some steps of a mesh period.
struct PairOverride {
    PairId pair;
    int first_step = 0;
    int last_step = 0;                     // one past the last
    machine::AlignedVector stiffness;      // [step - first_step][stage node][lane], N/m
    machine::AlignedVector damping_shape;  // same shape
    // Springs of unilateral contact, [step - first_step][stage node][tooth pair][slice][lane], N/m;
    // empty if the plan has none.
    machine::AlignedVector tooth_stiffness = {};
};

// Gaps of a pair's tooth pairs during some steps of a mesh period, [tooth pair][lane], m: the gap
// in the middle of the engagement, and its growth along the engagement (times
// StiffnessNodes::tooth_position).
struct PairGaps {
    PairId pair;
    int first_step = 0;
    int last_step = 0;  // one past the last
    machine::AlignedVector gap, growth;
};

// Deviations of one mesh period from the plan. Gaps and wear are used only by the law `unilateral`.
struct MeshOverrides {
    std::vector<PairOverride> faults;
    std::vector<PairGaps> gaps = {};
    // Depth of the wear of all worn flanks, [lane], m (times StiffnessNodes::tooth_wear); empty if
    // there is none.
    machine::AlignedVector wear = {};
};

// Kernel for one combination of integrator, model and width: integrates the gearboxes in `lanes`
// over one mesh period. `filter` holds the sensor's filter coefficients (sensor_filter.hpp).
template <class Lanes>
using IntegrationKernel = void(const IntegrationPlan& plan, const Lanes& lanes,
                               const machine::AlignedVector& filter, const MeshOverrides& overrides,
                               TileState& state, MeshRecord& record);

// Copy of the plan in double precision. Every build has kernels for eight double-precision lanes,
// but not always for so few single-precision ones.
IntegrationPlan in_double_precision(IntegrationPlan plan);

// Allocates a record of `lanes` lanes for the plan.
MeshRecord make_record(const IntegrationPlan& plan, int lanes, bool with_motion);
// Allocates the record's step states; kernels fill them if they are not empty.
void size_step_states(const IntegrationPlan& plan, int lanes, MeshRecord& record);

}  // namespace gearpod::lockstep
