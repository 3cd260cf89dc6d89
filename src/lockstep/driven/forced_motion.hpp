// Models under forces that vary with time (driven_forces.hpp): each is another model and those.
#pragma once

#include "lockstep/driven/driven_forces.hpp"
#include "lockstep/integrators/implicit_lanes.hpp"

namespace gearpod::lockstep {

// A model's lanes and the forces on them.
template <class ModelLanes, int W>
struct DrivenLanes : ModelLanes {
    DrivenForces<W> drive;
};

// Of a model that explicit methods march (dynamics/*_motion.hpp), in double precision.
template <class Model>
struct Forced : Model {
    using Lanes = DrivenLanes<typename Model::Lanes, Model::kWidth>;  // patterns over the mass
    // Filled for a stage node together with the meshes (load_pairs).
    struct Pairs : Model::Pairs {
        const double* row;
    };

    static GEARPOD_INLINE void accelerations(const Lanes& p, const double* __restrict q,
                                             const double* __restrict v, const Pairs& pairs,
                                             double* __restrict a) {
        Model::accelerations(p, q, v, pairs, a);
        p.drive.add(pairs.row, a);
    }
};

// Of the model that implicit methods march (implicit_stage.hpp).
template <class Model>
struct ForcedMatrixMotion : Model {
    using Lanes = DrivenLanes<ImplicitLanes<Model::kWidth>, Model::kWidth>;  // patterns in N
    struct Pairs : Model::Pairs {
        const double* row;
    };
    // To the forces of a stage that no mesh gives, N.
    static GEARPOD_INLINE void add_forces(const Lanes& p, const Pairs& pairs,
                                          double* __restrict forces) {
        p.drive.add(pairs.row, forces);
    }
};

}  // namespace gearpod::lockstep
