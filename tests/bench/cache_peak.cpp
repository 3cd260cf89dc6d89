#include "cache_peak.hpp"

#include "machine/clocks.hpp"
#include "machine/instruction_sets.hpp"
#include "machine/lanes.hpp"

namespace gearpod::bench {
namespace {

#if defined(__x86_64__)
constexpr int kDoubles = 2048;
constexpr int kRounds = 2000;

template <int kBytes>
struct Registers {
    typedef double Vector __attribute__((vector_size(kBytes)));
    static constexpr int kCount = kDoubles * 8 / kBytes;

    static GEARPOD_INLINE void load(const double* from) {
        const Vector* v = reinterpret_cast<const Vector*>(from);
        for (int round = 0; round < kRounds; ++round) {
#    pragma GCC unroll 16
            for (int i = 0; i < kCount; ++i) {
                const Vector one = v[i];
                asm volatile("" : : "x"(one));
            }
            asm volatile("" : : : "memory");
        }
    }
    static GEARPOD_INLINE void store(double* to) {
        Vector* v = reinterpret_cast<Vector*>(to);
        const Vector zero{};
        for (int round = 0; round < kRounds; ++round) {
#    pragma GCC unroll 16
            for (int i = 0; i < kCount; ++i) {
                v[i] = zero;
                asm volatile("" : : : "memory");
            }
        }
    }
};

__attribute__((target("arch=x86-64-v4,prefer-vector-width=512"))) void load_512(double* p) {
    Registers<64>::load(p);
}
__attribute__((target("arch=x86-64-v4,prefer-vector-width=512"))) void store_512(double* p) {
    Registers<64>::store(p);
}
__attribute__((target("arch=x86-64-v3"))) void load_256(double* p) {
    Registers<32>::load(p);
}
__attribute__((target("arch=x86-64-v3"))) void store_256(double* p) {
    Registers<32>::store(p);
}

double rate_of(void (*go)(double*), double bytes) {
    machine::AlignedVector room(kDoubles, 0.0);
    const double start = mc::thread_processor_s();
    go(room.data());
    return 8.0 * kDoubles / bytes * kRounds / (mc::thread_processor_s() - start);
}

double rate(Width width, void (*with_256)(double*), void (*with_512)(double*)) {
    using machine::InstructionSet;
    const InstructionSet set = machine::active_instruction_set();
    const bool has_512 = set == InstructionSet::x86_64_v4;
    if (set == InstructionSet::baseline || width == Width::scalar ||
        (width == Width::bits_512 && !has_512)) {
        return 0.0;
    }
    return width == Width::bits_256 || !has_512 ? rate_of(with_256, 32.0) : rate_of(with_512, 64.0);
}
#endif

}  // namespace

#if defined(__x86_64__)
double load_rate(Width width) {
    return rate(width, load_256, load_512);
}
double store_rate(Width width) {
    return rate(width, store_256, store_512);
}
#else
double load_rate(Width) {
    return 0.0;
}
double store_rate(Width) {
    return 0.0;
}
#endif

}  // namespace gearpod::bench
