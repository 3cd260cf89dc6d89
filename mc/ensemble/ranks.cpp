#include "mc/ensemble/ranks.hpp"

#include <fmt/format.h>

#include "mc/results/provenance.hpp"

namespace gearpod::mc {

std::string rank_name(const Ranks& ranks) {
    return fmt::format("rank {} on {}", ranks.rank(), host_name());
}

}  // namespace gearpod::mc
