// Peak rates of a core: fused multiply-adds in independent chains that stay in registers, and
// registers loaded from its first-level cache or stored into it.
#pragma once

namespace gearpod::bench {

// Registers of the chains. `active` is the widest of the active instruction set.
enum class Width { scalar, bits_256, bits_512, active };

// Fused multiply-adds per second of this thread's processor time, on doubles or on floats, each
// lane counted, from one burst of about a quarter of a millisecond. Returns 0 for a width that the
// processor or the active instruction set does not have.
double fma_rate_double(Width width = Width::active);
double fma_rate_float();

// Registers of that width per second of this thread's processor time, over 16 KB repeatedly, in
// bursts as for multiply-adds. Returns 0 for scalars and for a width that the processor or the
// active instruction set does not have.
double load_rate(Width width);
double store_rate(Width width);

}  // namespace gearpod::bench
