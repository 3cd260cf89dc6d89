// Peak rate at which a core loads registers from its first-level cache, or stores them into it.
#pragma once

#include "fma_peak.hpp"

namespace gearpod::bench {

// Registers of that width per second of this thread's processor time, over 16 KB repeatedly, in
// bursts as in fma_peak.hpp. Returns 0 for scalars and for a width that the processor or the active
// instruction set does not have.
double load_rate(Width width);
double store_rate(Width width);

}  // namespace gearpod::bench
