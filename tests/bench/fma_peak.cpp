// Built with contraction: here the compiler is to fuse.
#include "fma_peak.hpp"

#include "machine/dispatch.hpp"
#include "mc/thread_clock.hpp"

namespace gearpod::bench {
namespace {

// Twelve chains keep the pipes busy: two begin in a cycle, and each takes 4 or 5. With the two
// constants they fit the sixteen registers of x86-64-v3.
constexpr int kChains = 12;
constexpr long kRounds = 60'000;

template <class Real, int kBytes>
GEARPOD_INLINE Real chains() {
    typedef Real Vector __attribute__((vector_size(kBytes)));
    Vector sum[kChains];
    Vector factor = Vector{} + Real(0.5), change = Vector{} + Real(0.25);
    asm("" : "+x"(factor), "+x"(change));  // no constants to the compiler
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
    return all[0];
}

#if defined(__x86_64__)
template <class Real>
__attribute__((target("arch=x86-64-v4,prefer-vector-width=512"))) Real chains_v4() {
    return chains<Real, 64>();
}
template <class Real>
__attribute__((target("arch=x86-64-v3"))) Real chains_v3() {
    return chains<Real, 32>();
}
#endif

template <class Real>
double fma_rate() {
#if defined(__x86_64__)
    const auto set = machine::active_instruction_set();
    if (set == machine::InstructionSet::baseline) {
        return 0.0;
    }
    const bool wide = set == machine::InstructionSet::x86_64_v4;
    const double start = mc::thread_processor_s();
    volatile Real result = wide ? chains_v4<Real>() : chains_v3<Real>();
    static_cast<void>(result);
    const double lanes = (wide ? 64.0 : 32.0) / sizeof(Real);
    return lanes * kChains * kRounds / (mc::thread_processor_s() - start);
#else
    return 0.0;
#endif
}

}  // namespace

double fma_rate_double() {
    return fma_rate<double>();
}
double fma_rate_float() {
    return fma_rate<float>();
}

}  // namespace gearpod::bench
