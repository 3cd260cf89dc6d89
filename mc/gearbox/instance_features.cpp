#include "mc/gearbox/instance_features.hpp"

#include <cmath>
#include <limits>

#include "mc/scene/feature_needs.hpp"

namespace gearpod::mc {

InstanceFeatures::InstanceFeatures(const Scene& scene, const HealthyReference* healthy)
    : InstanceSignals(scene, needs_of(used_features(scene.study()))),
      features_(used_features(scene.study())),
      healthy_(healthy),
      levels_(scene.study().sensor.noise_levels.size()) {}

std::vector<double> InstanceFeatures::compute(const LaneSignals& gearbox,
                                              const InstanceInputs& inputs, const GearboxId& id,
                                              std::vector<LevelSignals>* signals) {
    std::vector<double> values(features_.size() * levels_);
    each_level(gearbox, inputs, id, [&](std::size_t level, features::FeatureInput input) {
        if (!healthy_->amplitude.empty()) {
            input.healthy = healthy_->at(level);
        }
        if (signals != nullptr) {
            const auto own = [](std::span<const double> signal) {
                return std::vector<double>(signal.begin(), signal.end());
            };
            signals->push_back({own(input.te_turn), gearbox.folded.empty() ? std::vector<double>{}
                                                                           : own(input.tooth_rms)});
        }
        for (std::size_t f = 0; f < features_.size(); ++f) {
            const double value = features_[f]->compute(input);
            values[f * levels_ + level] =
                std::isfinite(value) ? value : std::numeric_limits<double>::quiet_NaN();
        }
    });
    return values;
}

}  // namespace gearpod::mc
