// How many fused multiply-adds a core does at most: independent chains that stay in registers.
#pragma once

namespace gearpod::bench {

// Fused multiply-adds a second of this thread's processor time with the active instruction set, on
// doubles or on floats, each lane counted; from one burst of about a quarter of a millisecond. 0
// for an instruction set without them.
double fma_rate_double();
double fma_rate_float();

}  // namespace gearpod::bench
