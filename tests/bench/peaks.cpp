// Measures peak rates. Built with contraction, so that the compiler
// fuses, and without vectorization, so that scalar chains stay scalar.
#include "peaks.hpp"

#include <cstring>

#include "machine/clocks.hpp"
#include "machine/instruction_sets.hpp"
#include "machine/lanes.hpp"

namespace gearpod::bench {
namespace {

// Twelve chains keep the pipelines busy: two begin in a cycle, and each takes 4 or 5. With the two
// constants they fit the sixteen registers of x86-64-v3.
constexpr int kChains = 12;
constexpr long kRounds = 60'000;

// Vector is a vector of so many Real, or one.
template <class Real, class Vector>
GEARPOD_INLINE Real chains() {
    Vector sum[kChains];
    Vector factor = Vector{} + Real(0.5), change = Vector{} + Real(0.25);
    asm("" : "+x"(factor), "+x"(change));  // hides the constants from the compiler
    for (int c = 0; c < kChains; ++c) {
        sum[c] = change + Real(c);
    }
    for (long i = 0; i < kRounds; ++i) {
#pragma GCC unroll 12
        for (int c = 0; c < kChains; ++c) {
            sum[c] = sum[c] * factor + change;
        }
    }
    Vector all{};
    for (const Vector& s : sum) {
        all += s;
    }
    Real first;
    std::memcpy(&first, &all, sizeof first);
    return first;
}

template <class Real, int kBytes>
struct VectorOf {
    typedef Real Type __attribute__((vector_size(kBytes)));
};

#if defined(__x86_64__)
template <class Real>
__attribute__((target("arch=x86-64-v4,prefer-vector-width=512"))) Real chains_512() {
    return chains<Real, typename VectorOf<Real, 64>::Type>();
}
template <class Real>
__attribute__((target("arch=x86-64-v3"))) Real chains_256() {
    return chains<Real, typename VectorOf<Real, 32>::Type>();
}
template <class Real>
__attribute__((target("arch=x86-64-v3"))) Real chains_scalar() {
    return chains<Real, Real>();
}

template <class Real>
double rate_of(Real (*chains_of_width)(), double lanes) {
    const double start = mc::thread_processor_s();
    volatile Real result = chains_of_width();
    static_cast<void>(result);
    return lanes * kChains * kRounds / (mc::thread_processor_s() - start);
}

template <class Real>
double fma_rate(Width width) {
    const auto set = machine::active_instruction_set();
    const bool has_512 = set == machine::InstructionSet::x86_64_v4;
    if (set == machine::InstructionSet::baseline || (width == Width::bits_512 && !has_512)) {
        return 0.0;
    }
    if (width == Width::scalar) {
        return rate_of(chains_scalar<Real>, 1.0);
    }
    return width == Width::bits_256 || !has_512 ? rate_of(chains_256<Real>, 32.0 / sizeof(Real))
                                                : rate_of(chains_512<Real>, 64.0 / sizeof(Real));
}
constexpr int kDoubles = 2048;
constexpr int kCacheRounds = 2000;

template <int kBytes>
struct Registers {
    typedef double Vector __attribute__((vector_size(kBytes)));
    static constexpr int kCount = kDoubles * 8 / kBytes;

    static GEARPOD_INLINE void load(const double* from) {
        const Vector* v = reinterpret_cast<const Vector*>(from);
        for (int round = 0; round < kCacheRounds; ++round) {
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
        for (int round = 0; round < kCacheRounds; ++round) {
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

double cache_rate_of(void (*go)(double*), double bytes) {
    machine::AlignedVector room(kDoubles, 0.0);
    const double start = mc::thread_processor_s();
    go(room.data());
    return 8.0 * kDoubles / bytes * kCacheRounds / (mc::thread_processor_s() - start);
}

double rate(Width width, void (*with_256)(double*), void (*with_512)(double*)) {
    using machine::InstructionSet;
    const InstructionSet set = machine::active_instruction_set();
    const bool has_512 = set == InstructionSet::x86_64_v4;
    if (set == InstructionSet::baseline || width == Width::scalar ||
        (width == Width::bits_512 && !has_512)) {
        return 0.0;
    }
    return width == Width::bits_256 || !has_512 ? cache_rate_of(with_256, 32.0)
                                                : cache_rate_of(with_512, 64.0);
}
#else
template <class Real>
double fma_rate(Width) {
    return 0.0;
}
#endif

}  // namespace

double fma_rate_double(Width width) {
    return fma_rate<double>(width);
}
double fma_rate_float() {
    return fma_rate<float>(Width::active);
}

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
