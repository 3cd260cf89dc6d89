// How a study is computed: the part of it that says nothing of gearboxes.
#pragma once

#include <optional>

#include "lockstep/plan/integrator.hpp"
#include "machine/dispatch.hpp"

namespace gearpod::mc {

using lockstep::Precision;
enum class StepGrid { uniform, graded };
// Mesh periods that are integrated: the periodic orbit and a fault's passages; the effect of each
// gear's tooth errors by itself, where no tooth pair loses contact; every mesh period.
enum class Horizon { reuse, superpose, march };

// Number of lanes that fill a 512-bit register.
constexpr int full_lanes(Precision precision) {
    return precision == Precision::single_precision ? 16 : 8;
}

struct Numerics {
    std::optional<lockstep::Integrator> integrator;  // empty: chosen for the gearbox
    Precision precision = Precision::double_precision;
    StepGrid grid = StepGrid::uniform;
    double step_tolerance = 1e-5;  // of a step of bs3, over the largest motion
    double grid_tolerance = 1e-3;  // of the signals on a graded grid of the others, rms
    int steps_per_mesh = 0;        // 0: chosen from a pilot of the ensemble
    // Relative tolerance of every feature, by which integrator, steps and settling are chosen; 0:
    // they are not chosen.
    double tolerance = 0.0;
    bool verify = false;  // some gearboxes by finer steps after a run; with a tolerance always
    double settle_tolerance = 1e-10;
    double stiffness_tolerance = 0.0;  // of the stiffness curves; 0: as close as they can be
    int face_slices = 0;               // across a face whose gaps vary; 0: chosen
    int max_meshes = 0;                // 0: from the damping
    Horizon horizon = Horizon::reuse;
    int lanes = full_lanes(Precision::double_precision);     // of its precision, 8, 4 or 1
    int threads = 0;                                         // 0: all
    std::optional<machine::InstructionSet> instruction_set;  // empty: the processor's widest

    bool operator==(const Numerics&) const = default;
};

}  // namespace gearpod::mc
