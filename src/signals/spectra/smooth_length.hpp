// Length of a Fourier transform that is fast.
#pragma once

#include <algorithm>

namespace gearpod::signals {

// Smallest number >= least, and >= 1, whose only prime factors are 2, 3 and 5.
inline int smooth_length(int least) {
    for (int n = std::max(least, 1);; ++n) {
        int rest = n;
        for (const int prime : {2, 3, 5}) {
            while (rest % prime == 0) {
                rest /= prime;
            }
        }
        if (rest == 1) {
            return n;
        }
    }
}

}  // namespace gearpod::signals
