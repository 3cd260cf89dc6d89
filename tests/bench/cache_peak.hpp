// How many registers a core loads from its first-level cache, or stores into it, at most.
#pragma once

#include "fma_peak.hpp"

namespace gearpod::bench {

// Registers of that width a second of this thread's processor time, going over 16 KB again and
// again; bursts as fma_peak.hpp has them. 0 for a width that the processor or the active
// instruction set does not have, and for scalars.
double load_rate(Width width);
double store_rate(Width width);

}  // namespace gearpod::bench
