#include "mc/plan/sensor_plan.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "mc/study/sensor_signal.hpp"

namespace gearpod::mc {
namespace {

// Numbers of nodal diameters of the ring's modes, each once, ascending.
std::set<int> ring_modes(const Study& study) {
    std::set<int> numbers;
    for (const HousingMode& mode : study.sensor.housing_modes) {
        if (mode.nodal_diameters) {
            numbers.insert(*mode.nodal_diameters);
        }
    }
    return numbers;
}

// Measured response by gain and phase in units of `unit_rad`; 0 where no values are given.
signals::MeasuredResponse measured_response(const Sensor& sensor, const std::vector<double>& gain,
                                            const std::vector<double>& phase, double unit_rad) {
    signals::MeasuredResponse measured{sensor.response_Hz, {}};
    for (std::size_t i = 0; i < gain.size(); ++i) {
        measured.value.push_back(std::polar(gain[i], phase[i] * unit_rad));
    }
    measured.value.resize(sensor.response_Hz.size());
    return measured;
}

constexpr double kRadPerDegree = std::numbers::pi / 180.0;

// Makes the plan of a sensor: the first one, or an additional one.
class SensorPlanner {
  public:
    SensorPlanner(const Study& study, const Drivetrain& drivetrain, int samples_per_mesh,
                  const AdditionalSensor* additional)
        : study_(study),
          first_(study.sensor),
          additional_(additional),
          drivetrain_(drivetrain),
          samples_(samples_per_mesh),
          chain_(measuring_chain()) {}

    SensorPlan make(std::uint64_t number) && {
        plan_.number = number;
        plan_.name = additional_ != nullptr ? additional_->name : "";
        add_paths();
        if (has_housing(study_) || chain_) {
            plan_.stages.emplace_back(response());
            if (!first_.tones.empty()) {
                plan_.stages.emplace_back(TonesStage{first_.tones, chain_});
            }
        } else {
            plan_.stages.emplace_back(PathStage{first_.tones});
        }
        if (!first_.bearings.empty() || !first_.stages.empty()) {
            plan_.stages.emplace_back(other_sources());
        }
        plan_.stages.emplace_back(noise_stage(study_, additional_));
        const std::optional<double> range_m_s2 = additional_ != nullptr && additional_->range_m_s2
                                                     ? additional_->range_m_s2
                                                     : first_.range_m_s2;
        if (range_m_s2) {
            plan_.stages.emplace_back(RangeStage{*range_m_s2});
        }
        return std::move(plan_);
    }

  private:
    // Measuring chain of an additional sensor if it differs from that of the first one.
    std::optional<signals::MeasuringChain> measuring_chain() const {
        if (additional_ == nullptr) {
            return std::nullopt;
        }
        signals::MeasuringChain chain{{}, {}, additional_->delay_s, additional_->sampling_Hz};
        if (additional_->low_pass_Hz) {
            chain.low_pass = {*additional_->low_pass_Hz, first_.low_pass_Hz};
        }
        if (additional_->mounting_Hz) {
            chain.mounting = {*additional_->mounting_Hz, additional_->mounting_damping};
        }
        const bool differs =
            chain.low_pass || chain.mounting || chain.delay_s != 0.0 || chain.sampling_Hz;
        return differs ? std::optional(chain) : std::nullopt;
    }

    void add_paths() {
        const auto* planetary = dynamic_cast<const PlanetaryDrivetrain*>(&drivetrain_);
        if (planetary == nullptr || study_.effects.path == nullptr) {
            // A sensor on the housing: one window with constant weight.
            plan_.paths.emplace_back(signals::path_window("rectangular"), 1, samples_,
                                     drivetrain_.span());
            return;
        }
        signals::SensorPosition position;
        if (additional_ != nullptr) {
            position = {additional_->angle_deg, additional_->tangential, additional_->gain};
        }
        position.cross_axis = first_.cross_axis_percent.value_or(0.0) / 100.0;
        const auto sense = planetary->carrier_turns_backwards() ? signals::CarrierSense::negative
                                                                : signals::CarrierSense::positive;
        const auto add = [&](const auto& kind) {
            plan_.paths.emplace_back(kind, gears::planet_positions(planetary->train()), samples_,
                                     drivetrain_.span(), sense, position);
        };
        add(*study_.effects.path);
        for (const int nodal_diameters : ring_modes(study_)) {
            add(signals::RingLoad{nodal_diameters, signals::RingLoad::Axis::x});
            add(signals::RingLoad{nodal_diameters, signals::RingLoad::Axis::y});
        }
        for (const HousingBearing& bearing : housing_bearings(study_)) {
            const int after_planets = bearing.shaft == Member::sun ? 0 : 1;
            plan_.paths.emplace_back(
                signals::BearingSource{planetary->train().planets + after_planets}, samples_,
                drivetrain_.span(), sense, position);
        }
    }

    // Modes with these nodal diameters, or without any statement of them.
    std::vector<signals::NaturalMode> modes(std::optional<int> nodal_diameters) const {
        std::vector<signals::NaturalMode> modes;
        for (std::size_t k = 0; k < first_.housing_modes.size(); ++k) {
            const HousingMode& mode = first_.housing_modes[k];
            if (mode.nodal_diameters == nodal_diameters) {
                const bool differs = additional_ != nullptr && !additional_->participation.empty();
                modes.push_back({mode.frequency_Hz, mode.damping,
                                 differs ? additional_->participation[k] : mode.participation});
            }
        }
        return modes;
    }

    // Response to the vibration through the window, to the load of the planets on the ring's modes,
    // and to the forces in bearings.
    ResponseStage response() const {
        ResponseStage stage{{}, chain_};
        signals::HousingResponse& through_window =
            stage.parts.emplace_back(PathResponse{0, 1, {}, {}}).response;
        through_window.modes = modes(std::nullopt);
        through_window.chain = chain_;
        if (!first_.response_Hz.empty()) {
            through_window.measured =
                additional_ != nullptr && !additional_->response_gain.empty()
                    ? measured_response(first_, additional_->response_gain,
                                        additional_->response_phase_deg, kRadPerDegree)
                    : measured_response(first_, first_.response_gain, first_.response_phase_rad,
                                        1.0);
        }
        std::size_t path = 1;
        for (const int nodal_diameters : ring_modes(study_)) {
            stage.parts.push_back({path,
                                   2,
                                   {.stiff_path = false,
                                    .modes = modes(nodal_diameters),
                                    .measured = {},
                                    .chain = chain_},
                                   {}});
            path += 2;
        }
        for (const HousingBearing& bearing : housing_bearings(study_)) {
            stage.parts.push_back({path, 1, bearing_response(bearing), bearing.shaft});
            ++path;
        }
        return stage;
    }

    // Response to the acceleration of the shaft in a bearing.
    signals::HousingResponse bearing_response(const HousingBearing& bearing) const {
        signals::HousingResponse response{
            .stiff_path = false, .modes = {}, .measured = {}, .chain = chain_};
        if (!first_.response_Hz.empty()) {
            response.measured =
                additional_ != nullptr && !(additional_->*bearing.own_gain).empty()
                    ? measured_response(first_, additional_->*bearing.own_gain,
                                        additional_->*bearing.own_phase_deg, kRadPerDegree)
                    : measured_response(first_, first_.*bearing.gain, first_.*bearing.phase_rad,
                                        1.0);
            return response;
        }
        const bool differs = additional_ != nullptr && !(additional_->*bearing.own_per_kg).empty();
        for (std::size_t k = 0; k < first_.housing_modes.size(); ++k) {
            const HousingMode& mode = first_.housing_modes[k];
            response.modes.push_back(
                {mode.frequency_Hz, mode.damping,
                 differs ? (additional_->*bearing.own_per_kg)[k] : mode.*bearing.per_kg});
        }
        return response;
    }

    OtherSourcesStage other_sources() const {
        OtherSourcesStage stage{{}, {}, first_.low_pass_Hz, chain_};
        for (std::size_t i = 0; i < first_.bearings.size(); ++i) {
            const Bearing& bearing = first_.bearings[i];
            (bearing.role == SourceRole::background ? stage.background : stage.other_fault)
                .push_back({i, bearing});
        }
        return stage;
    }

    const Study& study_;
    const Sensor& first_;
    const AdditionalSensor* const additional_;  // null for the first sensor
    const Drivetrain& drivetrain_;
    const int samples_;
    const std::optional<signals::MeasuringChain> chain_;
    SensorPlan plan_;
};

double square(double x) {
    return x * x;
}

}  // namespace

signals::HousingResponse PathResponse::of(const InstanceInputs& inputs) const {
    signals::HousingResponse scaled = response;
    for (signals::NaturalMode& mode : scaled.modes) {
        mode.frequency_Hz *= inputs.housing_frequency_factor;
    }
    if (bearing) {
        const BodyInstance& body = inputs.bodies[*bearing];
        scaled.bearing = {body.bearing_stiffness_N_m, body.bearing_damping_N_s_m};
    }
    return scaled;
}

NoiseStage noise_stage(const Study& study, const AdditionalSensor* additional) {
    NoiseStage stage;
    stage.filtered = study.sensor.noise_density_m_s2_per_sqrt_Hz.has_value();
    if (has_background(study)) {
        stage.background = background_spectrum(study);
    }
    stage.first_low_pass_Hz = study.sensor.low_pass_Hz;
    stage.first_quantisation_m_s2 = study.sensor.quantisation_m_s2;
    if (additional != nullptr) {
        stage.factor = additional->noise;
        stage.own_low_pass_Hz = additional->low_pass_Hz;
        stage.own_quantisation_m_s2 = additional->quantisation_m_s2;
        stage.sampling_Hz = additional->sampling_Hz;
    }
    return stage;
}

SensorNoise NoiseStage::of(const SensorNoise& first) const {
    if (!own_low_pass_Hz && !own_quantisation_m_s2) {
        return {factor * first.all_m_s2, factor * first.white_m_s2, factor * first.background_m_s2};
    }
    SensorNoise noise{0.0, factor * first.white_m_s2, factor * first.background_m_s2};
    double variance = 0.0;  // of the filtered noise
    if (filtered) {
        variance = square(factor) * low_pass_Hz() / first_low_pass_Hz *
                   std::max(0.0, square(first.all_m_s2) - square(first.white_m_s2) -
                                     square(first.background_m_s2));
    }
    if (background && own_low_pass_Hz) {
        noise.background_m_s2 *=
            background->rms_m_s2(low_pass_Hz()) / background->rms_m_s2(first_low_pass_Hz);
    }
    if (own_quantisation_m_s2) {
        const double rms =
            std::max(0.0, square(first.white_m_s2) - square(first_quantisation_m_s2) / 12.0);
        noise.white_m_s2 = std::sqrt(square(factor) * rms + square(*own_quantisation_m_s2) / 12.0);
    }
    noise.all_m_s2 = std::sqrt(variance + square(noise.white_m_s2) + square(noise.background_m_s2));
    return noise;
}

SensorNoise NoiseStage::with_rms_factor(const SensorNoise& first, double rms_factor) const {
    const double rounding = first_quantisation_m_s2 / std::sqrt(12.0);
    if (rounding == 0.0 && first.all_m_s2 == first.white_m_s2) {
        return {first.all_m_s2 * rms_factor, first.white_m_s2 * rms_factor, 0.0};
    }
    const double other = first.all_m_s2 * first.all_m_s2 - first.white_m_s2 * first.white_m_s2,
                 rms = first.white_m_s2 * first.white_m_s2 - rounding * rounding,
                 white = rms * rms_factor * rms_factor + rounding * rounding;
    return {std::sqrt(std::max(0.0, other) + white), std::sqrt(white), first.background_m_s2};
}

void RangeStage::clip(std::span<double> samples) const {
    for (double& sample : samples) {
        sample = std::clamp(sample, -range_m_s2, range_m_s2);
    }
}

SampleNeed SensorPlan::samples() const {
    SampleNeed most = SampleNeed::none;
    for (const SensorStage& stage : stages) {
        most = std::max(most, std::visit([](const auto& each) { return each.samples(); }, stage));
    }
    return most;
}

SampleNeed samples_of(std::span<const SensorPlan> sensors) {
    SampleNeed most = SampleNeed::none;
    for (const SensorPlan& sensor : sensors) {
        most = std::max(most, sensor.samples());
    }
    return most;
}

std::span<const Tone> SensorPlan::tones() const {
    if (const auto* path = find<PathStage>()) {
        return path->tones;
    }
    const auto* stage = find<TonesStage>();
    return stage != nullptr ? std::span<const Tone>(stage->tones) : std::span<const Tone>();
}

Realization SensorPlan::realization(const Realization& of_gearbox) const {
    Realization here = of_gearbox;
    here.id.sensor = number;
    const SensorNoise of_sensor = noise().of(noise_of(here.inputs));
    here.inputs.noise_m_s2 = of_sensor.all_m_s2;
    here.inputs.white_noise_m_s2 = of_sensor.white_m_s2;
    here.inputs.background_noise_m_s2 = of_sensor.background_m_s2;
    return here;
}

std::vector<SensorPlan> make_sensor_plans(const Study& study, const Drivetrain& drivetrain,
                                          int samples_per_mesh) {
    std::vector<SensorPlan> plans{
        SensorPlanner(study, drivetrain, samples_per_mesh, nullptr).make(0)};
    for (const AdditionalSensor& additional : study.sensor.additional) {
        plans.push_back(
            SensorPlanner(study, drivetrain, samples_per_mesh, &additional).make(plans.size()));
    }
    return plans;
}

}  // namespace gearpod::mc
