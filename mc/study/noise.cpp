#include "mc/study/noise.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "machine/contracts.hpp"

namespace gearpod::mc {

bool noise_by_density(const Study& study) {
    return study.sensor.noise_density_m_s2_per_sqrt_Hz.has_value() || has_background(study);
}

bool has_background(const Study& study) {
    return !study.sensor.background_Hz.empty();
}

bool has_range(const Study& study) {
    return study.sensor.range_m_s2 ||
           std::ranges::any_of(study.sensor.additional, [](const AdditionalSensor& sensor) {
               return sensor.range_m_s2.has_value();
           });
}

signals::NoiseSpectrum background_spectrum(const Study& study) {
    EXPECTS(has_background(study));
    return {study.sensor.background_Hz, study.sensor.background_density_m_s2_per_sqrt_Hz};
}

NoiseModel noise_model(const Study& study) {
    NoiseModel model{study.sensor.quantisation_m_s2, study.sensor.low_pass_Hz, {}};
    if (has_background(study)) {
        model.background_rms_m_s2 = background_spectrum(study).rms_m_s2(model.low_pass_Hz);
    }
    return model;
}

SensorNoise sensor_noise(const NoiseModel& model, const SensorNoiseInputs& inputs) {
    const double step_m_s2 = model.quantisation_m_s2;
    SensorNoise noise;
    noise.white_m_s2 = step_m_s2 > 0.0 ? std::hypot(inputs.rms_m_s2, step_m_s2 / std::sqrt(12.0))
                                       : inputs.rms_m_s2;
    const double filtered_m_s2 = inputs.density_m_s2_per_sqrt_Hz.value_or(0.0) *
                                 std::sqrt(signals::low_pass_noise_bandwidth_Hz(model.low_pass_Hz));
    noise.all_m_s2 = !inputs.density_m_s2_per_sqrt_Hz ? noise.white_m_s2
                     : noise.white_m_s2 == 0.0        ? filtered_m_s2
                                                      : std::hypot(filtered_m_s2, noise.white_m_s2);
    if (model.background_rms_m_s2) {
        noise.background_m_s2 = inputs.background_level * *model.background_rms_m_s2;
        noise.all_m_s2 = std::hypot(noise.all_m_s2, noise.background_m_s2);
    }
    return noise;
}

double sensor_noise_m_s2(const Study& study) {
    const Sensor& s = study.sensor;
    return sensor_noise(noise_model(study),
                        {s.noise_density_m_s2_per_sqrt_Hz, s.noise_m_s2, s.background_level})
        .all_m_s2;
}

std::string noise_text(const Study& study) {
    const Sensor& s = study.sensor;
    const bool filtered = s.noise_density_m_s2_per_sqrt_Hz.has_value();
    std::string text =
        fmt::format("{:.4g} m/s^2 rms times the noise level", sensor_noise_m_s2(study));
    if (s.quantisation_m_s2 == 0.0 && (!filtered || s.noise_m_s2 == 0.0) &&
        !has_background(study)) {
        return text + (filtered ? ", white noise, filtered by the low-pass"
                                : ", white noise, not filtered by the low-pass");
    }
    text += ", in quadrature:";
    if (filtered) {
        text += fmt::format(" {:.4g} filtered by the low-pass,",
                            *s.noise_density_m_s2_per_sqrt_Hz *
                                std::sqrt(signals::low_pass_noise_bandwidth_Hz(s.low_pass_Hz)));
    }
    if (has_background(study)) {
        text +=
            fmt::format(" {:.4g} of the background,",
                        s.background_level * background_spectrum(study).rms_m_s2(s.low_pass_Hz));
    }
    return text + fmt::format(" {:.4g} white, {:.4g} by quantisation", s.noise_m_s2,
                              s.quantisation_m_s2 / std::sqrt(12.0));
}

const char* noise_key(const Study& study) {
    return study.sensor.noise_density_m_s2_per_sqrt_Hz ? "sensor.noise_density_m_s2_per_sqrt_Hz"
                                                       : "sensor.noise_m_s2";
}

}  // namespace gearpod::mc
