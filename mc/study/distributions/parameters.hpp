// Parameters of each distribution, as text for help.
#pragma once

#include <string>
#include <vector>

namespace gearpod::mc {

struct DistributionHelp {
    std::string name;
    std::string parameters;  // "low (number), count (integer >= 1), values (list of numbers)"
};

// All registered distributions, in their order.
std::vector<DistributionHelp> distribution_help();

}  // namespace gearpod::mc
