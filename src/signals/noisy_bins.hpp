// The kernel behind add_sensor_noise; see sensor_noise.hpp.
#pragma once

namespace gearpod::signals {

// noisy[b] = (sigma along[b] + sqrt folded[b])^2 + sigma^2 across[b]
void noisy_bins(long bins, const double* folded, const double* along, const double* across,
                double sigma, double* noisy);

}  // namespace gearpod::signals
