// Numerics that were chosen on pilot gearboxes, and the error with which they were.
#pragma once

#include <string>

#include "mc/numerics/solver_setting.hpp"

namespace gearpod::mc {

struct NumericsChoice {
    SolverSetting setting;
    // Relative error of the pilot's worst feature, or its error over the feature's scatter.
    double error = 0.0;
    bool of_scatter = false;    // true for the latter
    std::string worst_feature;  // name of that feature
    double cost = 0.0;  // of integrating the pilot by the cost model, in rk4 steps per gearbox
    int gearboxes = 0;  // number of pilot gearboxes

    std::string text() const;
};

}  // namespace gearpod::mc
