// One gearbox after another, or eight abreast, through the fault's pattern by other solvers.
#pragma once

#include <iterator>
#include <limits>
#include <vector>

#include "gearbox.hpp"
#include "lockstep/plan/march.hpp"
#include "stiffness_tables.hpp"

namespace gearpod::peers {

// What all solvers march.
struct Task {
    const mc::Scene& scene;
    const Boxes& boxes;
    const StiffnessTables& steps;  // of the fixed steps
    const StiffnessTables& fine;   // for solvers that choose their steps
    lockstep::TileState start;     // of all eight, near the orbit, at an integer phase
    double mesh_period_s = 0.0;    // the same in all gearboxes
    // Sizes of the states: an adaptive solver's tolerance is relative to them where a state is
    // small.
    double scale[kSensing] = {};
};

// How much of the task: mesh periods before the record, and recorded ones from mesh 0 of the
// pattern on. The pattern repeats, so those before are its last.
struct Extent {
    int run_in = 2, recorded = 1;
    // Processor time after which a solver that chooses its steps gives up a gearbox.
    double most_s = std::numeric_limits<double>::infinity();
};

struct PeerRun {
    std::vector<lockstep::MeshRecord> records;  // of eight lanes; only the marched ones are filled
    double march_s = 0.0;                       // of processor time, over all mesh periods marched
    double steps = 0.0;                         // a mesh period and gearbox
    bool late = false, failed = false;          // gave up; or the solver did
};

// Gearboxes first to last - 1 march one by one, wide ones all eight together.

// Classical Runge-Kutta on the steps of the task's grid. `motion_only`: without the sensor's
// low-pass, which leaves the records' accelerations zero. Of a release build, whose compiler makes
// vectors of one gearbox's states where it can; and without that.
namespace vectorized {
PeerRun odeint_rk4(const Task& task, const Extent& extent, int first, int last, bool motion_only);
PeerRun odeint_wide_rk4(const Task& task, const Extent& extent, bool motion_only);
}  // namespace vectorized
namespace scalar {
PeerRun odeint_rk4(const Task& task, const Extent& extent, int first, int last, bool motion_only);
}  // namespace scalar

// Dormand and Prince's pair with dense output. `stops`: starts anew at every transition of the
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
// A gearbox's share of the start: motion, velocity, filter.
void copy_start(const Task& task, int gearbox, double* y);
// From one gearbox's state into its lane of a record.
void record_sample(const Task& task, const double* y, bool sensing, int lane, int sample,
                   lockstep::MeshRecord& record);
std::vector<lockstep::MeshRecord> empty_records(const Task& task, int meshes);
// The mesh of the pattern that mesh k of a march shows; k may be negative.
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
