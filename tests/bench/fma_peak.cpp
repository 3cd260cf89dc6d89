// Measures the peak rate of fused multiply-adds. Built with contraction, so that the compiler
// fuses, and without vectorization, so that scalar chains stay scalar.
#include "fma_peak.hpp"

#include <cstring>

#include "machine/clocks.hpp"
#include "machine/instruction_sets.hpp"

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

}  // namespace gearpod::bench
