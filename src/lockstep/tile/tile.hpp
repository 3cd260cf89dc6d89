// Inputs and results of a tile, common to all solution strategies.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <span>
#include <vector>

#include "lockstep/plan/fault_schedule.hpp"
#include "lockstep/plan/integration_plan.hpp"
#include "machine/ids.hpp"

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

enum class LaneStatus { ok, diverged, not_converged };

// States of a tile before each mesh period of a run-in and a span, and after the last one.
struct SpanStates {
    int run_in_meshes = 0;
    std::vector<TileState> all;

    // State before mesh period k of the span; k is negative during the run-in.
    const TileState& before(int k) const {
        return all[static_cast<std::size_t>(k + run_in_meshes)];
    }
    TileState& before(int k) { return all[static_cast<std::size_t>(k + run_in_meshes)]; }
    int span_meshes() const { return static_cast<int>(all.size()) - 1 - run_in_meshes; }
};

// Content index without a record: the mesh period equals the healthy one to the tolerance, or its
// record went to RecordedSpan::on_record.
inline constexpr int kUnchanged = -1;

// Recorded mesh periods. Record 0 is the healthy one; mesh period k of the span has
// records[content[k mod L]]. Those of a fault perturbation are the changed mesh periods, without
// the healthy one; lanes that do not change in such a mesh period are NaN there. With
// RecordedSpan::on_record, only the healthy one is kept.
struct TileResult {
    std::vector<MeshRecord> records;
    std::vector<int> content;        // L = content.size()
    SpanStates states;               // empty unless RecordOptions::states is set
    std::vector<LaneStatus> status;  // per lane
    // Per lane of a superposed solution: true if its healthy mesh periods were superposed.
    std::vector<char> superposed;
    // [gear pair][lane]: contact loss ratio, averaged over the tooth pairs. It is the fraction of a
    // tooth pair's engagement, within the nominal path of contact, in which it carries no load.
    // Counted in the mesh periods of the span that RecordOptions::motion_meshes states, including
    // its faults (tooth_contact.hpp). If mesh periods repeat, it is counted in the healthy one.
    // Superposed mesh periods have no contact loss. Empty if teeth cannot separate, and for a fault
    // perturbation.
    machine::AlignedVector contact_loss;
    int integrated_meshes = 0;  // total number of mesh periods integrated or solved
};

// Access to single lanes of a tile's arrays, whose last index is the lane.
template <int W>
using LaneMask = std::array<bool, W>;

// Sets all values of a lane (indices lane, lane + W, ...).
template <int W>
void fill_lane(machine::AlignedVector& values, LaneId lane, double value) {
    for (auto i = static_cast<std::size_t>(lane); i < values.size(); i += W) {
        values[i] = value;
    }
}

template <int W>
double largest(const machine::AlignedVector& values, LaneId lane) {
    double result = 0.0;
    for (auto i = static_cast<std::size_t>(lane); i < values.size(); i += W) {
        result = std::isfinite(values[i]) ? std::max(result, std::abs(values[i])) : INFINITY;
    }
    return result;
}

template <int W>
double largest_difference(const machine::AlignedVector& a, const machine::AlignedVector& b,
                          LaneId lane) {
    double result = 0.0;
    for (auto i = static_cast<std::size_t>(lane); i < a.size(); i += W) {
        result = std::max(result, std::abs(a[i] - b[i]));
    }
    return result;
}

template <int W>
void copy_lanes(const machine::AlignedVector& from, machine::AlignedVector& to,
                const LaneMask<W>& lanes) {
    for (std::size_t row = 0; row < to.size(); row += W) {
        for (std::size_t l = 0; l < W; ++l) {
            to[row + l] = lanes[l] ? from[row + l] : to[row + l];
        }
    }
}

// Copies what `to` holds; `from` may hold the motion in addition.
template <int W>
void copy_lanes(const MeshRecord& from, MeshRecord& to, const LaneMask<W>& lanes) {
    copy_lanes<W>(from.acceleration, to.acceleration, lanes);
    copy_lanes<W>(from.te, to.te, lanes);
    copy_lanes<W>(from.motion, to.motion, lanes);
    copy_lanes<W>(from.mesh_force, to.mesh_force, lanes);
}

template <int W>
void copy_lanes(const TileState& from, TileState& to, const LaneMask<W>& lanes) {
    copy_lanes<W>(from.q, to.q, lanes);
    copy_lanes<W>(from.v, to.v, lanes);
    copy_lanes<W>(from.filter, to.filter, lanes);
}

}  // namespace gearpod::lockstep
