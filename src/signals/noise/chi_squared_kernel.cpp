#include <cmath>

#include "machine/elementary_functions.hpp"
#include "machine/instruction_sets.hpp"
#include "signals/noise/chi_squared.hpp"

namespace gearpod::signals {
namespace {

static_assert(kChiPowers == 6);

// Evaluates value by value: a piece is one cache line, which a gather over lanes would access six
// times.
GEARPOD_INLINE void all_values(long values, const double* __restrict pieces,
                               double* __restrict value) {
    constexpr double kScale = 0.5 * kChiPieces / kChiRange;
    for (long b = 0; b < values; ++b) {
        double z = value[b];
        z = z > kChiRange ? kChiRange : z;
        z = z < -kChiRange ? -kChiRange : z;
        const double position = std::fma(z, kScale, 0.5 * kChiPieces);
        int piece = static_cast<int>(position);
        piece = piece < kChiPieces ? piece : kChiPieces - 1;
        const double t = std::fma(2.0, position - piece, -1.0);
        const double* c = pieces + static_cast<long>(piece) * kChiStride;
        value[b] = machine::horner(t, c[5], c[4], c[3], c[2], c[1], c[0]);
    }
}

}  // namespace

void chi_squared_values(long values, const double* pieces, double* value) {
    machine::run_kernel<all_values>(values, pieces, value);
}

}  // namespace gearpod::signals
