#include "mc/lives/campaign.hpp"

#include <algorithm>
#include <cmath>
#include <mutex>

#include "analysis/detection/feature_alarm.hpp"
#include "analysis/monitoring/own_baseline.hpp"
#include "machine/team.hpp"
#include "mc/scene/feature_needs.hpp"

namespace gearpod::mc {
namespace {

// Gearboxes that go through their lives together.
struct Part {
    std::vector<GearboxId> ids;
    bool cracked;
    std::vector<GearboxLife>* into;
    std::size_t first;  // place there
};

void add_parts(Group group, std::uint64_t first, std::size_t count, bool cracked, std::size_t lanes,
               std::vector<GearboxLife>& into, std::vector<Part>& parts) {
    into.resize(count);
    for (std::size_t i = 0; i < count; i += lanes) {
        Part part{{}, cracked, &into, i};
        for (std::size_t k = i; k < std::min(count, i + lanes); ++k) {
            part.ids.push_back({group, first + k});
        }
        parts.push_back(std::move(part));
    }
}

// A feature of all lives, or several as one.
class Watched {
  public:
    Watched(const Study& study, const Campaign& campaign, std::vector<std::size_t> features)
        : study_(study), campaign_(campaign), features_(std::move(features)) {
        for (const features::Feature* feature : used_features(study)) {
            alarms_.push_back(analysis::alarm_of(*feature));
        }
    }

    analysis::LifeAnswers by(const analysis::Detector& detector) const {
        return analysis::answer(detector, healthy(campaign_.setting), healthy(campaign_.healthy),
                                cracked(), study_.monitoring.false_alarms_per_1000_h,
                                study_.detection.confidence);
    }

  private:
    std::vector<double> deviations(const GearboxLife& life) const {
        std::vector<double> torque;
        if (study_.monitoring.torque_regression) {
            for (const LifeRecord& record : life.history.records) {
                torque.push_back(record.torque);
            }
        }
        const auto baseline = static_cast<std::size_t>(study_.monitoring.baseline_records);
        if (features_.size() == 1) {
            return analysis::own_deviations(life.values[features_[0]], torque, baseline,
                                            alarms_[features_[0]]);
        }
        return analysis::fused_deviations(life.values, torque, baseline, alarms_);
    }

    std::vector<analysis::HealthyLife> healthy(const std::vector<GearboxLife>& lives) const {
        std::vector<analysis::HealthyLife> all;
        for (const GearboxLife& life : lives) {
            if (life.status == Status::ok) {
                analysis::HealthyLife one{deviations(life), 0.0};
                one.hours = *study_.life.interval_h *
                            static_cast<double>(std::ranges::count_if(
                                one.values, [](double value) { return !std::isnan(value); }));
                all.push_back(std::move(one));
            }
        }
        return all;
    }

    std::vector<analysis::CrackedLife> cracked() const {
        std::vector<analysis::CrackedLife> all;
        for (const GearboxLife& life : campaign_.cracked) {
            if (life.status != Status::ok) {
                continue;
            }
            analysis::CrackedLife one;
            one.values = deviations(life);
            for (const LifeRecord& record : life.history.records) {
                one.hours.push_back(record.hours);
                one.sizes.push_back(record.depth_m);
            }
            one.first = life.history.first_cracked;
            one.end_hours = life.history.end_hours;
            all.push_back(std::move(one));
        }
        return all;
    }

    const Study& study_;
    const Campaign& campaign_;
    const std::vector<std::size_t> features_;
    std::vector<analysis::Alarm> alarms_;
};

}  // namespace

Campaign run_campaign(const Scene& scene, int threads, const std::function<void(long)>& done) {
    const Study& study = scene.study();
    const LifeTiles tiles(scene);
    Campaign campaign;
    std::vector<Part> parts;
    const auto lanes = tiles.lanes();
    const auto cracked = static_cast<std::size_t>(study.ensemble.instances);
    // The longest first.
    add_parts(Group::graded, 0, cracked, true, lanes, campaign.cracked, parts);
    add_parts(Group::threshold, 0, static_cast<std::size_t>(study.ensemble.threshold_instances),
              false, lanes, campaign.setting, parts);
    add_parts(Group::graded, cracked, static_cast<std::size_t>(study.life.healthy_lives), false,
              lanes, campaign.healthy, parts);
    std::mutex one_at_a_time;
    machine::for_each_index(parts.size(), threads, [&](std::size_t p) {
        Part& part = parts[p];
        LifeCosts costs;
        auto lives = tiles.run(part.ids, part.cracked, costs);
        const auto interpolation =
            p == 0 ? tiles.interpolation_errors(part.ids) : InterpolationErrors();
        const std::lock_guard lock(one_at_a_time);
        std::move(lives.begin(), lives.end(),
                  part.into->begin() + static_cast<std::ptrdiff_t>(part.first));
        if (p == 0) {
            campaign.interpolation = interpolation;
        }
        campaign.costs.gearboxes += costs.gearboxes;
        campaign.costs.records += costs.records;
        campaign.costs.gearbox_count += costs.gearbox_count;
        campaign.costs.record_count += costs.record_count;
        done(static_cast<long>(part.ids.size()));
    });
    for (const auto* lives : {&campaign.setting, &campaign.healthy, &campaign.cracked}) {
        campaign.failed += std::ranges::count_if(
            *lives, [](const GearboxLife& one) { return one.status != Status::ok; });
    }
    return campaign;
}

std::vector<MonitoredFeature> monitor(const Study& study, const Campaign& campaign) {
    std::vector<MonitoredFeature> monitored;
    const auto add = [&](const std::string& name, const std::vector<std::size_t>& features) {
        const Watched watched(study, campaign, features);
        for (const std::string& text : study.monitoring.detectors) {
            monitored.push_back({name, text, watched.by(*analysis::parse_detector(text))});
        }
    };
    std::vector<std::size_t> all;
    for (std::size_t f = 0; f < study.features.use.size(); ++f) {
        add(study.features.use[f], {f});
        all.push_back(f);
    }
    if (all.size() > 1 && study.monitoring.baseline_records > 0) {
        add("fused", all);
    }
    return monitored;
}

}  // namespace gearpod::mc
