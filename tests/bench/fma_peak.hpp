// Peak rate of a core's fused multiply-adds: independent chains that stay in registers.
#pragma once

namespace gearpod::bench {

// Registers of the chains. `active` is the widest of the active instruction set.
enum class Width { scalar, bits_256, bits_512, active };

// Fused multiply-adds per second of this thread's processor time, on doubles or on floats, each
// lane counted, from one burst of about a quarter of a millisecond. Returns 0 for a width that the
// processor or the active instruction set does not have.
double fma_rate_double(Width width = Width::active);
double fma_rate_float();

}  // namespace gearpod::bench
