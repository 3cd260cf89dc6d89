// What each distribution is written with, for help.
#pragma once

#include <string>
#include <vector>

namespace gearpod::mc {

struct DistributionHelp {
    std::string name;
    std::string parameters;  // "low (number), count (integer >= 1), values (list of numbers)"
};

// All registered ones, in their order.
std::vector<DistributionHelp> distribution_help();

}  // namespace gearpod::mc
