#include "mc/gearbox/realization_features.hpp"

#include <cmath>
#include <limits>

#include "mc/gearbox/record_change.hpp"
#include "mc/scene/feature_needs.hpp"

namespace gearpod::mc {
namespace {

// Rms of the sensor noise in the baseline record of the gearbox, m/s^2.
double earlier_noise(const Study& study, const InstanceInputs& inputs, const GearboxId& earlier) {
    const RandomInput* drawn = study.find_random("sensor.noise_m_s2");
    return drawn != nullptr && drawn->distribution.per_record()
               ? Sampler(study).sample(earlier).noise_m_s2
               : inputs.noise_m_s2;
}

}  // namespace

RealizationFeatures::RealizationFeatures(const Scene& scene, const HealthyReference* healthy)
    : RealizationSignals(scene, compared_needs(used_features(scene.study())).record),
      scene_(scene),
      features_(used_features(scene.study())),
      healthy_(healthy),
      levels_(scene.study().sensor.noise_levels.size()) {
    const ComparedNeeds needs = compared_needs(features_);
    if (!needs.baseline.empty()) {
        baseline_ = std::make_unique<RealizationSignals>(scene, needs.baseline);
    }
    if (!needs.change.empty()) {
        change_ = std::make_unique<RealizationSignals>(scene, needs.change);
    }
}

void RealizationFeatures::load(const LaneSignals& gearbox, const InstanceInputs& inputs,
                               const GearboxId& id) {
    RealizationSignals::load(gearbox, inputs, id);
    InstanceInputs before = inputs;
    if (baseline_) {
        GearboxId earlier = id;
        earlier.record = Record::baseline;
        earlier.noise_sampling = NoiseSampling::plain;
        before.noise_m_s2 = earlier_noise(scene_.study(), inputs, earlier);
        baseline_->load(*gearbox.baseline, before, earlier);
    }
    if (change_) {
        const double rms = inputs.noise_m_s2 > 0.0 ? before.noise_m_s2 / inputs.noise_m_s2 : 1.0;
        changed_ = change_since_baseline(scene_, gearbox);
        change_->load(changed_, inputs,
                      noise_of_change(scene_, changed_, noise(), baseline_->noise(), rms));
    }
}

std::vector<double> RealizationFeatures::compute(const LaneSignals& gearbox,
                                                 const InstanceInputs& inputs, const GearboxId& id,
                                                 std::vector<LevelSignals>* signals) {
    std::vector<double> values(features_.size() * levels_);
    load(gearbox, inputs, id);
    for (std::size_t level = 0; level < levels_; ++level) {
        features::FeatureInput input = at(level), before, change;
        if (baseline_) {
            before = baseline_->at(level);
            input.baseline = &before;
        }
        if (change_) {
            change = change_->at(level);
            input.change = &change;
        }
        for (features::FeatureInput* of : {&input, &before}) {
            if (!healthy_->amplitude.empty()) {
                of->get<features::HealthyRecords>() = healthy_->at(level);
            }
        }
        if (signals != nullptr) {
            const auto copy_of = [](std::span<const double> signal) {
                return std::vector<double>(signal.begin(), signal.end());
            };
            signals->push_back(
                {copy_of(input.get<features::TeTurn>().turn),
                 copy_of(input.get<features::ToothRms<features::Gear::planet>>().rms)});
        }
        for (std::size_t f = 0; f < features_.size(); ++f) {
            const double value = features_[f]->value(input);
            values[f * levels_ + level] =
                std::isfinite(value) ? value : std::numeric_limits<double>::quiet_NaN();
        }
    }
    return values;
}

}  // namespace gearpod::mc
