#include "mc/results/failure_text.hpp"

namespace gearpod::mc {

const char* failure_text(Status status) {
    switch (status) {
        case Status::ok:
            return "worked";
        case Status::diverged:
            return "diverged without a known reason";
        case Status::not_settled:
            return "did not settle";
        case Status::supercritical:
            return "is unstable: above a critical speed of the carrier its bearings do not hold "
                   "what turns with it";
        case Status::parametric:
            return "is unstable by parametric resonance: the changing mesh stiffness makes its "
                   "motion grow";
        case Status::step_too_long:
            return "is too stiff or too light for the study's step: set numerics.steps_per_mesh, "
                   "or an implicit numerics.integrator";
        case Status::no_equilibrium:
            return "has no equilibrium: where its teeth are gone nothing carries the load";
    }
    return "";
}

}  // namespace gearpod::mc
