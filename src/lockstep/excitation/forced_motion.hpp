// Models under time-varying forces (excitation_forces.hpp): a base model plus these forces.
#pragma once

#include "lockstep/excitation/excitation_forces.hpp"
#include "lockstep/integrators/implicit_lanes.hpp"

namespace gearpod::lockstep {

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
