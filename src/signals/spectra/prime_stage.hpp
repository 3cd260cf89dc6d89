// Kernel of FourierTransform; see fourier_transform.hpp.
#pragma once

namespace gearpod::signals {

inline constexpr int kColumns = 8;

// Transforms of q points, q an odd prime, in every column k < row:
//
//     out[s][k] = sum over r < q of in[r][k] exp(i a r s),
//
// where a is 2 pi / q or -2 pi / q. Terms r and q - r, and results s and q - s, share their
// products.
struct PrimeStageArguments {
    int prime = 0;
    long row = 0;                    // columns, a multiple of kColumns
    const double* cosine = nullptr;  // [s - 1][r - 1], 1 <= r, s <= (q - 1) / 2: cos(a r s)
    const double* sine = nullptr;
    double* real = nullptr;  // [r][k], overwritten
    double* imaginary = nullptr;
    double* out_real = nullptr;  // [s][k]
    double* out_imaginary = nullptr;
};

void prime_stage(const PrimeStageArguments& a);

}  // namespace gearpod::signals
