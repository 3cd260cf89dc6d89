// Models under time-varying forces: a base model with patterns of force.
#pragma once

#include <cmath>
#include <span>

#include "lockstep/excitation/excitation_rows.hpp"
#include "lockstep/integrators/implicit_lanes.hpp"
#include "lockstep/plan/excitation.hpp"
#include "lockstep/plan/integration_plan.hpp"
#include "machine/instruction_sets.hpp"

namespace gearpod::lockstep {

// Forces of a time-varying excitation on W gearboxes. Each is a pattern over the degrees of
// freedom, constant for a tile, times a value at every stage node of a mesh period
// (excitation_rows.hpp).
template <int W>
struct ExcitationForces {
    // torque, gravity along x and y, angular acceleration, shafts
    static constexpr int kMaxColumns = 4 + kMostShafts;
    static constexpr int kMaxEntries = 4 * (9 + 3 * dynamics::kMaxPlanets) + kMostShafts;

    int columns = 0;
    int first[kMaxColumns + 1] = {};  // entries of column c: first[c] <= e < first[c + 1]
    int degree[kMaxEntries] = {};
    alignas(64) double pattern[kMaxEntries][W] = {};

    // Rows of values, [distinct stage node][value][lane]. A node shared by two steps has one row.
    const double* rows = nullptr;
    int nodes_per_step = 0, values = 0;

    GEARPOD_INLINE const double* row(int step, int node) const {
        return rows + (step * nodes_per_step + node) * values * W;
    }
    GEARPOD_INLINE const double* speed_value(const double* row, SpeedValue value) const {
        return row + (columns + value) * W;
    }

    // sums[degree of freedom][lane] += sum over the columns of pattern times value.
    GEARPOD_INLINE void add(const double* row, double* __restrict sums) const {
        for (int c = 0; c < columns; ++c) {
            const double* __restrict value = row + c * W;
            for (int e = first[c]; e < first[c + 1]; ++e) {
                const double* __restrict part = pattern[e];
                double* __restrict sum = sums + degree[e] * W;
#pragma omp simd
                for (int l = 0; l < W; ++l) {
                    sum[l] = std::fma(part[l], value[l], sum[l]);
                }
            }
        }
    }
};

// Computes the patterns in N, or in m/s^2 if `over_mass`. Leaves `rows` null. `inputs` holds W
// gearboxes.
template <int W>
ExcitationForces<W> make_excitation_forces(const IntegrationPlan& plan,
                                           const Excitation& excitation,
                                           std::span<const dynamics::GearboxInputs> inputs,
                                           bool over_mass);

// Steps of a mesh period that one call of a kernel integrates, [first, last); by default all. The
// first call must begin with step 0. It makes a workspace, which it keeps for the next calls;
// whoever makes the calls must release it at the end.
struct MeshPart {
    int first = 0, last = 0;  // 0: all
    mutable void* workspace = nullptr;
    mutable void (*release)(void*) = nullptr;
};

// Lanes of a model together with the forces on them.
template <class ModelLanes, int W>
struct ForcedLanes : ModelLanes {
    ExcitationForces<W> excitation_forces;
    MeshPart part = {};
};

// Explicitly integrated model (dynamics/*_motion.hpp) with time-varying forces, in double
// precision.
template <class Model>
struct Forced : Model {
    using Lanes = ForcedLanes<typename Model::Lanes, Model::kWidth>;  // patterns divided by mass
    // Loaded for a stage node together with the meshes (load_pairs).
    struct Pairs : Model::Pairs {
        const double* row;
    };

    static GEARPOD_INLINE void accelerations(const Lanes& p, const double* __restrict q,
                                             const double* __restrict v, const Pairs& pairs,
                                             double* __restrict a) {
        Model::accelerations(p, q, v, pairs, a);
        p.excitation_forces.add(pairs.row, a);
    }
};

// Implicitly integrated model (implicit_stage.hpp) with time-varying forces.
template <class Model>
struct ForcedMatrixMotion : Model {
    using Lanes = ForcedLanes<ImplicitLanes<Model::kWidth>, Model::kWidth>;  // patterns in N
    struct Pairs : Model::Pairs {
        const double* row;
    };
    // Adds the forces that no mesh exerts to those of a stage, N.
    static GEARPOD_INLINE void add_forces(const Lanes& p, const Pairs& pairs,
                                          double* __restrict forces) {
        p.excitation_forces.add(pairs.row, forces);
    }
};

}  // namespace gearpod::lockstep
