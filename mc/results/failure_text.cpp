#include "mc/results/failure_text.hpp"

namespace gearpod::mc {

const char* failure_text(Status status) {
    switch (status) {
        case Status::ok:
            return "worked";
        case Status::diverged:
            return "diverged without a known reason";
        case Status::not_converged:
            return "did not converge to a periodic steady state";
        case Status::supercritical:
            return "is unstable: above a critical speed of the carrier, the bearings do not hold "
                   "the rotating bodies";
        case Status::parametric:
            return "is unstable by parametric resonance: the varying mesh stiffness makes its "
                   "motion grow";
        case Status::step_too_long:
            return "is too stiff or too light for the study's time step: set "
                   "numerics.steps_per_mesh, or an implicit numerics.integrator";
        case Status::no_equilibrium:
            return "has no equilibrium: in some positions no tooth carries the load";
    }
    return "";
}

}  // namespace gearpod::mc
