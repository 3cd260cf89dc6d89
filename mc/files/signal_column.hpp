// Signal with a name and one value per sample.
#pragma once

#include <string>
#include <vector>

namespace gearpod::mc {

struct SignalColumn {
    std::string name;
    std::string unit;  // may be empty
    std::vector<double> values;
};

}  // namespace gearpod::mc
