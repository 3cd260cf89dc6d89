// Inputs that solution strategies share.
#pragma once

#include <functional>
#include <span>

#include "lockstep/plan/fault_schedule.hpp"
#include "lockstep/plan/integration_plan.hpp"

namespace gearpod::lockstep {

// The gearboxes of a tile. `gearboxes` and each of `faults.curve` hold W lanes; unused lanes of the
// last tile repeat its last gearbox.
struct TileInputs {
    const IntegrationPlan& plan;
    std::span<const dynamics::GearboxInputs> gearboxes;
    const FaultCurves& faults;
};

struct Convergence {
    double tolerance = 1e-10;  // relative, of the state; criterion for convergence and decay
    int max_meshes = 200;      // limit for convergence to the periodic orbit, or for one decay
};

// Optional records of a span.
struct RecordOptions {
    // Number of mesh periods, from the first, whose motions and mesh forces are recorded and in
    // which contact loss is counted. With 0, contact loss is counted in one of kContactMeshes.
    int motion_meshes = 0;
    bool states = false;  // also keeps TileResult::states
};

// Mesh periods [first, end) of a span.
struct SpanPart {
    int first = 0, end = 0;

    bool operator==(const SpanPart&) const = default;
};

// Mesh periods that are integrated and recorded one by one.
struct RecordedSpan {
    int meshes = 1;
    // Mesh periods integrated before the recorded ones. With tooth errors, or an excitation that
    // does not repeat, no periodic orbit exists to start from. The run-in then starts from the
    // periodic orbit without them.
    int run_in_meshes = 0;
    RecordOptions options = {};
    // Receives the record of each mesh period k in order, instead of keeping it. Empty: all records
    // are kept.
    std::function<void(int k, const MeshRecord&)> on_record = {};
    // The only mesh periods that FullSolution integrates and records, ascending and disjoint, each
    // part after a run-in. Empty: all. In TileResult::content the others refer to the first
    // recorded one if records are kept.
    std::vector<SpanPart> parts = {};
};

}  // namespace gearpod::lockstep
