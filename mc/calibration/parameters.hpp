// What calibrate looks for: random inputs of a study with their prior ranges.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "mc/input/problems.hpp"
#include "mc/scene/sampling.hpp"
#include "mc/study/study.hpp"

namespace gearpod::mc {

struct CalibratedInput {
    std::string key;           // "gearbox.tooth_quality"
    double low = 0, high = 1;  // of the prior, in the key's unit
    bool logarithmic = false;  // evenly in the logarithm
    double to_si = 1.0;

    // The value, in the key's unit, below which a share `unit` of the prior lies; and back.
    double at(double unit) const;
    double unit_of(double value) const;
    // Whether the march knows nothing of it: a value of its own costs no march.
    bool after_march() const;
    // As an override of the study, which checks it.
    std::string as_override() const;
};

// "gearbox.tooth_quality=3:10", "sensor.noise_m_s2=0.01:1:log". Problems are of `--prior`.
std::vector<CalibratedInput> read_priors(const std::vector<std::string>& texts, Problems& problems);

// Those of a study whose sensor measures `rms` m/s^2: tooth errors, background, level of the tones,
// gain and path exponent, whichever it may have.
std::vector<CalibratedInput> usual_inputs(const Study& study, double rms);

// By their places in the priors, `unit` one for each.
std::vector<GivenInput> given_at(std::span<const CalibratedInput> inputs,
                                 std::span<const double> unit);

}  // namespace gearpod::mc
