// The accelerometer's noise, whichever way a study gives it.
#pragma once

#include "mc/study/study.hpp"

namespace gearpod::mc {

// Whether it is given by its density before the low-pass, be it random, instead of its rms.
bool noise_by_density(const Study& study);

// Of every sample, m/s^2 rms.
double sensor_noise_m_s2(const Study& study);

// "sensor.noise_m_s2", or the density's.
const char* noise_key(const Study& study);

}  // namespace gearpod::mc
