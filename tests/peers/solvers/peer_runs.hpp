// Integrates one realization after another, or eight in parallel, through the fault's pattern by
// other solvers.
#pragma once

#include <iterator>
#include <limits>
#include <vector>

#include "gearbox.hpp"
#include "lockstep/plan/integration_plan.hpp"
#include "stiffness_tables.hpp"

namespace gearpod::peers {

// Problem that all solvers integrate.
struct Task {
    const mc::Scene& scene;
    const GearboxInputs8& gearboxes;
    const StiffnessTables& steps;  // for fixed steps
    const StiffnessTables& fine;   // for solvers that choose their steps
    lockstep::TileState start;     // of all eight, near the periodic orbit, at an integer phase
    double mesh_period_s = 0.0;    // the same in all gearboxes
    // Scales of the states: an adaptive solver's tolerance is relative to them where a state is
    // small.
    double scale[kSensing] = {};
};

// Part of the task: mesh periods before the record, and recorded ones from mesh 0 of the pattern
// on. The pattern repeats, so those before are its last.
struct Extent {
    int run_in = 2, recorded = 1;
    // Processor time after which a solver with adaptive steps gives up a realization.
    double most_s = std::numeric_limits<double>::infinity();
};

struct PeerRun {
    // Records with eight lanes, of which only the integrated ones are filled.
    std::vector<lockstep::MeshRecord> records;
    double integration_s = 0.0;         // of processor time, over all integrated mesh periods
    double steps = 0.0;                 // per mesh period and realization
    bool late = false, failed = false;  // stopped by the time limit, or by the solver
};

// Realizations first to last - 1 are integrated one by one, wide ones all eight together.
// Classical Runge-Kutta on the steps of the task's grid. With `motion_only` it runs without the
// sensor's low-pass and leaves the records' accelerations zero. The first namespace has the options
// of a release build, whose compiler vectorizes over one realization's states where it can; the
// second disables this.
namespace vectorized {
PeerRun odeint_rk4(const Task& task, const Extent& extent, int first, int last, bool motion_only);
PeerRun odeint_wide_rk4(const Task& task, const Extent& extent, bool motion_only);
}  // namespace vectorized
namespace scalar {
PeerRun odeint_rk4(const Task& task, const Extent& extent, int first, int last, bool motion_only);
}  // namespace scalar

// Dormand and Prince's pair with dense output. With `stops` it restarts at every transition of the
// stiffness, instead of finding it by rejected steps.
PeerRun odeint_dopri5(const Task& task, const Extent& extent, int first, int last, double tolerance,
                      bool stops);

// CVODE with Newton iteration and the exact Jacobian (BDF), dense or sparse (KLU), or with
// fixed-point iteration (Adams).
enum class Multistep { bdf, sparse_bdf, adams };
PeerRun cvode(const Task& task, const Extent& extent, int first, int last, Multistep method,
              double tolerance, bool stops);

// Helpers of the runs.
Gearbox<double> gearbox_of(const Task& task, int gearbox);
template <class T>
Gearbox<T> all_gearboxes(const Task& task);  // T has x[8]
// One realization's part of the start: displacements, velocities, filter.
void copy_start(const Task& task, int gearbox, double* y);
// Copies one realization's state into its lane of a record.
void record_sample(const Task& task, const double* y, bool sensing, int lane, int sample,
                   lockstep::MeshRecord& record);
std::vector<lockstep::MeshRecord> empty_records(const Task& task, int meshes);
// Mesh of the pattern for mesh k of an integration; k may be negative.
int pattern_mesh(const Task& task, int k);

template <class T>
Gearbox<T> all_gearboxes(const Task& task) {
    Gearbox<T> all{};
    static_cast<Directions&>(all) = gearbox_of(task, 0);
    for (int l = 0; l < kGearboxes; ++l) {
        const Gearbox<double> one = gearbox_of(task, l);
        const auto fill = [l](auto& to, const auto& from) {
            for (std::size_t i = 0; i < std::size(from); ++i) {
                to[i].x[l] = from[i];
            }
        };
        fill(all.inverse_mass, one.inverse_mass);
        fill(all.inverse_inertia, one.inverse_inertia);
        fill(all.bearing_stiffness, one.bearing_stiffness);
        fill(all.bearing_damping, one.bearing_damping);
        fill(all.support_stiffness, one.support_stiffness);
        fill(all.support_damping, one.support_damping);
        fill(all.force, one.force);
        all.speed.x[l] = one.speed;
        all.pull.x[l] = one.pull;
    }
    return all;
}

}  // namespace gearpod::peers
