// Numerical settings of a study.
#pragma once

#include <optional>

#include "lockstep/plan/integrator.hpp"
#include "machine/dispatch.hpp"

namespace gearpod::mc {

using lockstep::Precision;
enum class StepGrid { uniform, graded };
// Strategy of time integration. `periodic`: the periodic orbit and a fault's passages are
// integrated. `superposed`: the effect of each gear's tooth errors is integrated separately, as
// long as no tooth pair loses contact. `full`: every mesh period is integrated.
enum class Horizon { periodic, superposed, full };

// Number of lanes that fill a 512-bit register.
constexpr int full_lanes(Precision precision) {
    return precision == Precision::single_precision ? 16 : 8;
}

// Fewest healthy and faulty gearboxes from which the error of the steps is fitted.
inline constexpr int kFewestPairs = 8;

struct Numerics {
    std::optional<lockstep::Integrator> integrator;  // empty: chosen by the program
    Precision precision = Precision::double_precision;
    StepGrid grid = StepGrid::uniform;
    double grid_tolerance = 1e-3;  // rms error of the signals on a graded grid
    int steps_per_mesh = 0;        // 0: chosen from pilot gearboxes of the ensemble
    // Relative tolerance of every feature, from which integrator, steps and convergence tolerance
    // are chosen; 0: they are not chosen.
    double tolerance = 0.0;
    // Error of every feature over its scatter between healthy gearboxes, for which the steps and
    // mass_scaling_Hz are chosen; 0: they are not chosen.
    double scatter_tolerance = 0.0;
    bool verify = false;  // repeat some gearboxes with finer steps; always with a tolerance
    int paired_gearboxes =
        0;  // healthy and faulty ones each that are repeated; 0: eight faulty ones
    // Natural frequency to which faster modes of the nominal gearbox are lowered by additional
    // inertia (lockstep/plan/mode_inertia.hpp); 0: none.
    double mass_scaling_Hz = 0.0;
    double convergence_tolerance = 1e-10;
    double stiffness_tolerance = 0.0;  // of the stiffness curves; 0: the smallest that is possible
    int face_slices = 0;               // slices across a face with varying gaps; 0: chosen
    int max_meshes = 0;                // 0: derived from the damping
    Horizon horizon = Horizon::periodic;
    int lanes = full_lanes(Precision::double_precision);     // 16 (single only), 8, 4 or 1
    int threads = 0;                                         // 0: all
    std::optional<machine::InstructionSet> instruction_set;  // empty: the processor's widest set

    bool operator==(const Numerics&) const = default;
};

}  // namespace gearpod::mc
