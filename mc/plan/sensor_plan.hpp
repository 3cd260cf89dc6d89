// Chain of a sensor: stages in order, from the motion of a gearbox to the samples of its records.
// The stages before the noise make the samples of a signal (lane_signals.cpp), the others act on
// each record at each noise level (realization_signals.cpp).
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "mc/plan/drivetrain.hpp"
#include "mc/plan/feature_plan.hpp"
#include "mc/plan/sampling.hpp"
#include "mc/study/sensor_signal.hpp"
#include "signals/noise/coloured_noise.hpp"
#include "signals/path/frequency_response.hpp"
#include "signals/path/transmission_path.hpp"

namespace gearpod::mc {

// Vibration through the window of the transmission path (SensorPlan::paths[0]) times the gain, and
// tones.
struct PathStage {
    std::vector<Tone> tones;

    SampleNeed samples() const { return SampleNeed::none; }
};

// Response to the sum of the vibrations along successive paths of the sensor.
struct PathResponse {
    std::size_t first_path = 0, paths = 1;
    signals::HousingResponse response;  // of the nominal housing
    std::optional<Member> bearing;      // shaft in whose bearing the force acts

    signals::HousingResponse of(const InstanceInputs& inputs) const;
};
// Takes the place of PathStage where the housing or the measuring chain change the vibration on its
// way: sum of the responses along all paths, through the measuring chain.
struct ResponseStage {
    std::vector<PathResponse> parts;
    std::optional<signals::MeasuringChain> chain;

    SampleNeed samples() const { return SampleNeed::signal; }
};

// Tones that pass a sensor's measuring chain but not the housing.
struct TonesStage {
    std::vector<Tone> tones;
    std::optional<signals::MeasuringChain> chain;

    SampleNeed samples() const { return SampleNeed::none; }
};

// Vibration of faulty bearings and neighbouring stages, which passes the measuring chain.
struct OtherSourcesStage {
    struct NumberedBearing {
        std::size_t number = 0;  // in the study
        Bearing bearing;
    };
    std::vector<NumberedBearing> background, other_fault;  // by role
    double low_pass_Hz = 0.0;
    std::optional<signals::MeasuringChain> chain;

    SampleNeed samples() const { return SampleNeed::span; }
};

// Noise: white, filtered by the low-pass, and the machine's background. Its rms values are those of
// the gearbox (InstanceInputs), which are stated for the first sensor.
struct NoiseStage {
    bool filtered = false;
    std::optional<signals::NoiseSpectrum> background;
    double first_low_pass_Hz = 0.0, first_quantisation_m_s2 = 0.0;  // of the first sensor
    double factor = 1.0;  // on the noise of the first sensor
    // Values of this sensor; each is empty if it is that of the first one.
    std::optional<double> own_low_pass_Hz, own_quantisation_m_s2, sampling_Hz;

    // Noise of this sensor in a gearbox whose first one has `first`: times the factor, after its
    // low-pass and with its converter.
    SensorNoise of(const SensorNoise& first) const;
    // Noise of the first sensor with a factor on the rms of its white part without the
    // quantisation.
    SensorNoise with_rms_factor(const SensorNoise& first, double rms_factor) const;
    double low_pass_Hz() const { return own_low_pass_Hz.value_or(first_low_pass_Hz); }
    // True if a part is given by its density, so that the noise is not white.
    bool by_density() const { return filtered || background; }
    // True if the noise is drawn sample by sample.
    bool by_samples() const { return by_density() || sampling_Hz; }
    SampleNeed samples() const { return by_samples() ? SampleNeed::span : SampleNeed::none; }
};

// Noise of the first sensor of a study, or of an additional one.
NoiseStage noise_stage(const Study& study, const AdditionalSensor* additional = nullptr);

// Clips samples at the measuring range of the converter.
struct RangeStage {
    double range_m_s2 = 0.0;

    void clip(std::span<double> samples) const;
    SampleNeed samples() const { return SampleNeed::span; }
};

using SensorStage =
    std::variant<PathStage, ResponseStage, TonesStage, OtherSourcesStage, NoiseStage, RangeStage>;

struct SensorPlan {
    std::uint64_t number = 0;  // GearboxId::sensor: 0 for the first one
    std::string name;          // empty for the first one
    // Through the window, then the loads along x and y for each number of nodal diameters of the
    // ring's modes, then those of bearings in the housing.
    std::vector<signals::PathGrid> paths;
    std::vector<SensorStage> stages;

    // The stage of that kind, or nullptr.
    template <class Stage>
    const Stage* find() const {
        for (const SensorStage& stage : stages) {
            if (const auto* found = std::get_if<Stage>(&stage)) {
                return found;
            }
        }
        return nullptr;
    }
    const NoiseStage& noise() const { return *find<NoiseStage>(); }
    // The most samples that a stage needs.
    SampleNeed samples() const;
    // Tones that reach the sensor.
    std::span<const Tone> tones() const;

    // A record of a gearbox at this sensor: it has noise of its own.
    Realization realization(const Realization& of_gearbox) const;
};

// The most samples that a stage of any sensor needs.
SampleNeed samples_of(std::span<const SensorPlan> sensors);

// Plans of the first sensor and of the additional ones.
std::vector<SensorPlan> make_sensor_plans(const Study& study, const Drivetrain& drivetrain,
                                          int samples_per_mesh);

}  // namespace gearpod::mc
