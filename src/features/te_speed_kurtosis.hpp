// Kurtosis, normal = 3, of the speed error: signals/spectra/speed_error.hpp. At constant mean speed
// it is the jitter of the instantaneous angular speed that encoders show: Y. Li et al., Mech. Syst.
// Signal Process. 19 (2005) 786-805. A tooth fault changes the speed where the load passes to and
// from the tooth; the derivative weights these short changes more than te_kurtosis.hpp. NaN for a
// constant transmission error.
#pragma once

#include "features/signals.hpp"
#include "features/statistics/standardised_moment.hpp"
#include "signals/spectra/speed_error.hpp"

namespace gearpod::features {

inline double te_speed_kurtosis(const TeParts& te) {
    return standardised_moment(signals::speed_error(te.turn), 4);
}

}  // namespace gearpod::features
