#include "mc/gearbox/realization_features.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "mc/gearbox/record_change.hpp"
#include "mc/scene/feature_needs.hpp"

namespace gearpod::mc {
namespace {

// Signals of baseline record k of a gearbox.
const LaneSignals& baseline_of(const LaneSignals& gearbox, std::size_t k) {
    return gearbox.baseline[std::min(k, gearbox.baselines - 1)];
}

}  // namespace

RealizationFeatures::RealizationFeatures(const Scene& scene, const HealthyReference* healthy,
                                         bool python)
    : RealizationSignals(scene, compared_needs(used_features(scene.study())).record),
      scene_(scene),
      features_(used_features(scene.study())),
      python_(scene, python ? features_ : std::vector<const features::Feature*>()),
      healthy_(healthy),
      levels_(scene.study().sensor.noise_levels.size()) {
    const ComparedNeeds needs = compared_needs(features_);
    if (!needs.baseline.empty()) {
        for (int k = 0; k < scene.study().features.baseline_records; ++k) {
            baselines_.push_back({RealizationSignals(scene, needs.baseline), {}, {}});
        }
    }
    if (!needs.change.empty()) {
        change_ = std::make_unique<RealizationSignals>(scene, needs.change);
    }
}

void RealizationFeatures::load(const LaneSignals& gearbox, const Realization& realization) {
    RecordWindow window;
    if (has_record_length(scene_.study())) {
        window = record_window(scene_, realization.id, record_turns(scene_, realization.inputs));
        record_ = cut_record(scene_, gearbox, window, keeps_samples());
        RealizationSignals::load(record_, realization);
    } else {
        RealizationSignals::load(gearbox, realization);
    }
    if (!baselines_.empty()) {
        load_baselines(gearbox, realization, window);
    }
    if (change_) {
        load_change(gearbox, realization);
    }
}

void RealizationFeatures::load_baselines(const LaneSignals& gearbox, const Realization& realization,
                                         const RecordWindow& window) {
    Realization earlier = realization;
    earlier.id.record = Record::baseline;
    earlier.id.noise_sampling = NoiseSampling::plain;
    for (std::size_t k = 0; k < baselines_.size(); ++k) {
        const LaneSignals& signals = baseline_of(gearbox, k);
        Baseline& baseline = baselines_[k];
        earlier.id.baseline = k;
        earlier.inputs.noise_m_s2 = baseline.noise_m_s2 = signals.noise.all_m_s2;
        if (window.turns == 0) {
            baseline.signals.load(signals, earlier);
            continue;
        }
        const bool samples = baseline.signals.keeps_samples();
        baseline.cut =
            cut_record(scene_, signals, record_window(scene_, earlier.id, window.turns), samples);
        baseline.signals.load(baseline.cut, earlier);
        if (change_) {
            baseline.aligned = cut_record(scene_, signals, window, samples);
        }
    }
}

void RealizationFeatures::load_change(const LaneSignals& gearbox, const Realization& realization) {
    const double noise_m_s2 = realization.inputs.noise_m_s2;
    std::vector<const LaneSignals*> before;
    std::vector<BaselineNoise> noises;
    for (std::size_t k = 0; k < baselines_.size(); ++k) {
        const Baseline& baseline = baselines_[k];
        before.push_back(record().turns > 0 ? &baseline.aligned : &baseline_of(gearbox, k));
        noises.push_back(
            {&baseline.signals.noise(), noise_m_s2 > 0.0 ? baseline.noise_m_s2 / noise_m_s2 : 1.0});
    }
    changed_ = change_since_baseline(scene_, record(), before);
    change_->load(changed_, realization.inputs, noise_of_change(scene_, changed_, noise(), noises));
}

std::vector<double> RealizationFeatures::compute(const LaneSignals& gearbox,
                                                 const Realization& realization,
                                                 std::vector<LevelSignals>* signals) {
    std::vector<double> values(features_.size() * levels_,
                               std::numeric_limits<double>::quiet_NaN());
    load(gearbox, realization);
    for (std::size_t level = 0; level < levels_; ++level) {
        features::FeatureInput input = at(level), change;
        std::vector<features::FeatureInput> before;
        for (Baseline& baseline : baselines_) {
            before.push_back(baseline.signals.at(level));
        }
        input.baseline = before.empty() ? nullptr : before.data();
        input.baselines = static_cast<int>(before.size());
        if (change_) {
            change = change_->at(level);
            input.change = &change;
        }
        if (!healthy_->amplitude.empty()) {
            input.get<features::HealthyRecords>() = healthy_->at(level);
            for (features::FeatureInput& of : before) {
                of.get<features::HealthyRecords>() = healthy_->at(level);
            }
        }
        if (signals != nullptr) {
            const auto from_first_tooth = [&](std::span<const double> turn, int per_mesh) {
                std::vector<double> copy(turn.begin(), turn.end());
                rotate_to_first_tooth(record(), per_mesh, copy);
                return copy;
            };
            signals->push_back(
                {from_first_tooth(input.get<features::TeTurn>().turn, scene_.te_samples_per_mesh()),
                 from_first_tooth(input.get<features::ToothRms<features::Gear::planet>>().rms, 1)});
        }
        for (std::size_t f = 0; f < features_.size(); ++f) {
            if (!features_[f]->external) {
                values[f * levels_ + level] = features_[f]->value(input);
            }
        }
        if (!python_.empty()) {
            python_.add(scene_.study().sensor.noise_levels[level], realization.inputs, input);
        }
    }
    if (!python_.empty()) {
        add_python_values(realization, values);
    }
    for (double& value : values) {
        value = std::isfinite(value) ? value : std::numeric_limits<double>::quiet_NaN();
    }
    return values;
}

void RealizationFeatures::add_python_values(const Realization& realization,
                                            std::vector<double>& values) {
    const GearboxId& id = realization.id;
    const std::string work = fmt::format("{} gearbox {}, row {} of the results",
                                         id.group == Group::threshold ? "healthy" : "test",
                                         id.index, row_of_id(scene_.study(), id));
    const std::vector<double> own = python_.compute(work);
    print_python_problems(python_.problems(), work);
    std::size_t next = 0;
    for (std::size_t f = 0; f < features_.size(); ++f) {
        if (features_[f]->external) {
            std::copy_n(own.begin() + static_cast<std::ptrdiff_t>(next), levels_,
                        values.begin() + static_cast<std::ptrdiff_t>(f * levels_));
            next += levels_;
        }
    }
}

}  // namespace gearpod::mc
