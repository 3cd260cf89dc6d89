#include "lockstep/integrator.hpp"

namespace gearpod::lockstep {

std::vector<double> stage_nodes(Integrator integrator) {
    switch (integrator) {
        case Integrator::newmark:
            return {0.0, 1.0};
        case Integrator::sdirk3:
            return {Alexander::kDiagonal, Alexander::kSecond, 1.0};
        case Integrator::bs3:
            return {0.0, 0.5, 0.75};
        case Integrator::rk4:
            break;
    }
    return {0.0, 0.5, 1.0};
}

}  // namespace gearpod::lockstep
