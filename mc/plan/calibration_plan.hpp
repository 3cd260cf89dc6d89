// Calibration of a study: its inputs, which are random within prior ranges, and what it cannot
// simulate.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "mc/files/input/problems.hpp"
#include "mc/plan/sampling.hpp"
#include "mc/study/study.hpp"

namespace gearpod::mc {

struct CalibratedInput {
    std::string key;           // "gearbox.tooth_quality"
    double low = 0, high = 1;  // range of the prior, in the unit of the key
    bool logarithmic = false;  // uniform in the logarithm
    double to_si = 1.0;

    // Quantile of the prior, in the unit of the key.
    double at(double unit) const;
    // True if the motion does not depend on this input, so that another value needs no integration.
    bool independent_of_motion() const;
    // The prior as an override of the study.
    std::string as_override() const;
};

// Parses texts such as "gearbox.tooth_quality=3:10" and "sensor.noise_m_s2=0.01:1:log". Problems
// refer to `--prior`.
std::vector<CalibratedInput> read_priors(const std::vector<std::string>& texts, Problems& problems);

struct CalibrationPlan {
    Problems unsupported;  // what the study has, but calibration does not simulate
    // Default inputs, as far as the study allows them: tooth errors, noise, level of the tones,
    // gain and path exponent. The prior of the noise is relative to the rms of the recordings.
    std::vector<CalibratedInput> inputs;
    std::string noise_key;
    double noise_unit = 1.0;  // amplitude in the unit of noise_key that has an rms of 1 m/s^2

    // Default inputs of recordings with this rms, m/s^2.
    std::vector<CalibratedInput> default_inputs(double rms) const;
};
// `path` names the study's file in problems.
CalibrationPlan make_calibration_plan(const Study& study, const std::string& path);

// Text of the study with all defaults in which these inputs are uncertain and not random.
std::string text_without_distributions(Study study, std::span<const CalibratedInput> inputs);

// Inputs at the given quantiles of their priors; `unit` has one value per input.
std::vector<GivenInput> given_at(std::span<const CalibratedInput> inputs,
                                 std::span<const double> unit);

}  // namespace gearpod::mc
