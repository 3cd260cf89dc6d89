#include "mc/study/noise.hpp"

#include <cmath>

#include "signals/noise/low_pass_noise.hpp"

namespace gearpod::mc {

bool noise_by_density(const Study& study) {
    return study.sensor.noise_density_m_s2_per_sqrt_Hz.has_value();
}

double sensor_noise_m_s2(const Study& study) {
    const Sensor& s = study.sensor;
    return sensor_noise_m_s2(study, s.noise_density_m_s2_per_sqrt_Hz, s.noise_m_s2);
}

double sensor_noise_m_s2(const Study& study, std::optional<double> density_m_s2_per_sqrt_Hz,
                         double rms_m_s2) {
    return density_m_s2_per_sqrt_Hz
               ? *density_m_s2_per_sqrt_Hz *
                     std::sqrt(signals::low_pass_noise_bandwidth_Hz(study.sensor.low_pass_Hz))
               : rms_m_s2;
}

const char* noise_key(const Study& study) {
    return noise_by_density(study) ? "sensor.noise_density_m_s2_per_sqrt_Hz" : "sensor.noise_m_s2";
}

}  // namespace gearpod::mc
