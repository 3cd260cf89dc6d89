// Kernel of normals_from_words; see normals.hpp.
#pragma once

#include <cstdint>

namespace gearpod::signals {

// Converts blocks of kNormalBlock words into as many normal variates.
void normal_blocks(long blocks, const std::uint64_t* words, double* normals);

}  // namespace gearpod::signals
