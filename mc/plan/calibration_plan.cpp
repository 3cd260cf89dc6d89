#include "mc/plan/calibration_plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "mc/files/input/document.hpp"
#include "mc/files/input/spelling.hpp"
#include "mc/files/text/text_table.hpp"
#include "mc/study/schema/former_keys.hpp"
#include "mc/study/schema/schema.hpp"
#include "mc/study/sensor_signal.hpp"
#include "signals/noise/coloured_noise.hpp"

namespace gearpod::mc {
namespace {

std::vector<std::string> random_keys() {
    std::vector<std::string> names;
    for (const Key& key : schema()) {
        if (key.may_be_random() && key.section != "fault") {
            names.push_back(key.path());
        }
    }
    return names;
}

class ParameterReader {
  public:
    explicit ParameterReader(Problems& problems) : problems_(problems) {}

    void read(const std::string& text, std::vector<CalibratedInput>& inputs) {
        const std::size_t equals = text.find('=');
        const std::string name = text.substr(0, equals);
        const auto reject = [&](const std::string& what, const std::string& remedy) {
            problems_.push_back({"--prior", 0, name, what, remedy});
        };
        if (equals == std::string::npos) {
            return reject("no range", "write KEY=LOW:HIGH or KEY=LOW:HIGH:log");
        }
        const Key* key = find_key(current_path(name));
        if (key == nullptr || !key->may_be_random() || key->section == "fault") {
            const std::vector<std::string> known = random_keys();
            return reject(key == nullptr            ? "unknown key"
                          : key->section == "fault" ? "healthy gearboxes have no fault"
                                                    : "may not be random",
                          suggest(name, {known.begin(), known.end()}));
        }
        CalibratedInput input{key->path(), 0.0, 0.0, false, key->unit.to_si};
        const std::vector<std::string> parts = split(text.substr(equals + 1), ':');
        const auto low = number_of(parts.front());
        const auto high = parts.size() > 1 ? number_of(parts[1]) : std::nullopt;
        input.logarithmic = parts.size() == 3 && parts[2] == "log";
        if (!low || !high || parts.size() > 3 || (parts.size() == 3 && !input.logarithmic)) {
            return reject("\"" + text.substr(equals + 1) + "\" is not a range",
                          "write LOW:HIGH or LOW:HIGH:log");
        }
        if (!std::isfinite(*low) || !std::isfinite(*high) || *low >= *high) {
            return reject("LOW must be below HIGH, both finite", "");
        }
        if (input.logarithmic && *low <= 0.0) {
            return reject("LOW must be > 0 on a logarithmic scale", "");
        }
        if (std::ranges::any_of(inputs,
                                [&](const auto& other) { return other.key == key->path(); })) {
            return reject("is given twice", "");
        }
        input.low = *low;
        input.high = *high;
        inputs.push_back(input);
    }

  private:
    Problems& problems_;
};

// Parts of a study that calibration does not simulate.
Problems unsupported_parts(const Study& study, const std::string& path) {
    if (study.effects.quasi_static()) {
        return {{path, 0, "effects.motion",
                 "a quasi-static study has no acceleration signal to calibrate",
                 "choose a motion with inertia, e.g. \"translational-torsional\""}};
    }
    Problems problems;
    if (!study.sensor.additional.empty()) {
        problems.push_back(
            {path, 0, "sensor.additional", "calibration has one sensor", "remove them"});
    }
    if (has_housing(study)) {
        problems.push_back({path, 0, "sensor.housing_modes",
                            "calibration does not simulate the housing",
                            "remove them, and a measured response (sensor.response_Hz)"});
    }
    if (has_range(study)) {
        problems.push_back(
            {path, 0, "sensor.range_m_s2", "calibration does not clip the samples", "remove it"});
    }
    if (has_other_sources(study)) {
        problems.push_back({path, 0, "sensor.bearings",
                            "calibration simulates neither faulty bearings nor neighbouring "
                            "stages (sensor.stages)",
                            "use recordings without them, and remove the keys"});
    }
    return problems;
}

}  // namespace

double CalibratedInput::at(double unit) const {
    return logarithmic ? low * std::pow(high / low, unit) : low + unit * (high - low);
}

bool CalibratedInput::independent_of_motion() const {
    constexpr std::array kSensor{"sensor.path_exponent", "sensor.gain",
                                 "sensor.tone_level",    "sensor.background_level",
                                 "sensor.noise_m_s2",    "sensor.noise_density_m_s2_per_sqrt_Hz"};
    return std::ranges::find(kSensor, key) != kSensor.end();
}

std::string CalibratedInput::as_override() const {
    return fmt::format("random.{}={{distribution='uniform',low={},high={}}}", key, low, high);
}

std::vector<CalibratedInput> read_priors(const std::vector<std::string>& texts,
                                         Problems& problems) {
    std::vector<CalibratedInput> inputs;
    ParameterReader reader(problems);
    for (const std::string& text : texts) {
        reader.read(text, inputs);
    }
    return inputs;
}

std::string text_without_distributions(Study study, std::span<const CalibratedInput> inputs) {
    study.detection.uncertain_inputs.clear();
    for (const CalibratedInput& input : inputs) {
        study.detection.uncertain_inputs.push_back(input.key);
        std::erase(study.detection.chosen_values, input.key);
    }
    std::erase_if(study.random, [&](const RandomInput& random) {
        return std::ranges::count(inputs, random.key, &CalibratedInput::key) > 0;
    });
    return resolved_text(study);
}

CalibrationPlan make_calibration_plan(const Study& study, const std::string& path) {
    CalibrationPlan plan;
    plan.unsupported = unsupported_parts(study, path);
    plan.noise_key = noise_key(study);
    if (noise_by_density(study)) {
        plan.noise_unit =
            1.0 / std::sqrt(signals::low_pass_noise_bandwidth_Hz(study.sensor.low_pass_Hz));
    }
    const bool pitch =
        study.errors.pitch_error_m > 0.0 || study.find_random("gearbox.pitch_error_um") != nullptr;
    if (pitch) {
        plan.inputs.push_back({"gearbox.pitch_error_um", 0.2, 100.0, true, 1e-6});
    } else {
        plan.inputs.push_back({"gearbox.tooth_quality", 2.0, 11.0, false, 1.0});
    }
    plan.inputs.push_back({plan.noise_key, 0.01, 1.05, true, 1.0});
    plan.inputs.push_back({"sensor.gain", 0.05, 20.0, true, 1.0});
    plan.inputs.push_back({"sensor.path_exponent", -0.2, 0.4, false, 1.0});
    plan.inputs.push_back({"sensor.tone_level", 0.01, 20.0, true, 1.0});
    std::erase_if(plan.inputs, [&](const CalibratedInput& input) {
        const bool forbidden = find_key(input.key)->presence(study).need == Need::forbidden;
        const bool no_path = input.key == "sensor.path_exponent" && study.effects.path == nullptr;
        return forbidden || no_path;
    });
    return plan;
}

std::vector<CalibratedInput> CalibrationPlan::default_inputs(double rms) const {
    std::vector<CalibratedInput> scaled = inputs;
    for (CalibratedInput& input : scaled) {
        if (input.key == noise_key) {
            input.low = input.low * rms * noise_unit;
            input.high = input.high * rms * noise_unit;
        }
    }
    return scaled;
}

std::vector<GivenInput> given_at(std::span<const CalibratedInput> inputs,
                                 std::span<const double> unit) {
    std::vector<GivenInput> given;
    for (std::size_t p = 0; p < inputs.size(); ++p) {
        given.push_back({input_id(inputs[p].key), inputs[p].at(unit[p]) * inputs[p].to_si});
    }
    return given;
}

}  // namespace gearpod::mc
