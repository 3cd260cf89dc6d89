#include "lockstep/plan/integrator.hpp"

namespace gearpod::lockstep {

std::vector<double> stage_nodes(Integrator integrator) {
    switch (integrator) {
        case Integrator::newmark:
            return {0.0, 1.0};
        case Integrator::sdirk3:
            return {Alexander::kDiagonal, Alexander::kSecond, 1.0};
        case Integrator::generalized_alpha:
            return {0.0, 1.0 - ChungHulbert::kForce, 1.0};
        case Integrator::bs3:
            return {0.0, 0.5, 0.75};
        case Integrator::central_difference:
            return {0.5};
        case Integrator::rk4:
            break;
    }
    return {0.0, 0.5, 1.0};
}

ImplicitSpan implicit_span(Integrator integrator) {
    switch (integrator) {
        case Integrator::newmark:
            return {0.5, 0.25};
        case Integrator::sdirk3:
            return {Alexander::kDiagonal, Alexander::kDiagonal * Alexander::kDiagonal};
        case Integrator::generalized_alpha:
            return ChungHulbert::span();
        case Integrator::bs3:
        case Integrator::central_difference:
        case Integrator::rk4:
            break;
    }
    return {};
}

const char* name(Integrator integrator) {
    switch (integrator) {
        case Integrator::newmark:
            return "newmark";
        case Integrator::sdirk3:
            return "sdirk3";
        case Integrator::generalized_alpha:
            return "generalized-alpha";
        case Integrator::bs3:
            return "bs3";
        case Integrator::central_difference:
            return "central-difference";
        case Integrator::rk4:
            break;
    }
    return "rk4";
}

}  // namespace gearpod::lockstep
