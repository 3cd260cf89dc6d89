// Accelerometer noise of a study, given by its rms or by its density.
#pragma once

#include <optional>

#include "mc/study/study.hpp"

namespace gearpod::mc {

// True if the noise is given by its density before the low-pass, nominal or random, and not by its
// rms.
bool noise_by_density(const Study& study);

// Standard deviation of every sample, m/s^2: nominal, or of a gearbox with these values.
double sensor_noise_m_s2(const Study& study);
double sensor_noise_m_s2(const Study& study, std::optional<double> density_m_s2_per_sqrt_Hz,
                         double rms_m_s2);

// Key that gives the noise: "sensor.noise_m_s2", or that of the density.
const char* noise_key(const Study& study);

}  // namespace gearpod::mc
