// The kernel behind normals_from_words; see normals.hpp.
#pragma once

#include <cstdint>

namespace gearpod::signals {

// Of blocks of kNormalBlock words and values.
void normal_blocks(long blocks, const std::uint64_t* words, double* normals);

}  // namespace gearpod::signals
