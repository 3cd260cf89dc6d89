// Choices and values given in addition to a REXS model.
#pragma once

#include <optional>
#include <string>

namespace gearpod::mc {

// Loads replace the model's.
struct RexsChoices {
    std::string stage, load_case;  // ids; empty: the only one
    std::optional<std::string> input;
    std::optional<int> planets;
    std::optional<double> face_width_mm, addendum, quality;
    std::optional<double> torque_N_m, speed_rpm, power_kW;
};

}  // namespace gearpod::mc
