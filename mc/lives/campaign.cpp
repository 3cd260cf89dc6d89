#include "mc/lives/campaign.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <stdexcept>
#include <tuple>

#include "analysis/detection/feature_alarm.hpp"
#include "analysis/monitoring/own_baseline.hpp"
#include "mc/lives/life_rows.hpp"
#include "mc/scene/feature_needs.hpp"

namespace gearpod::mc {
namespace {

// Where a lives file says what its rows took.
constexpr const char *kGearboxTime = "gearboxes_processor_s", *kRecordTime = "records_processor_s",
                     *kGearboxCount = "gearboxes_computed", *kRecordCount = "records_computed",
                     *kRecordText = "record";

long count_in(const Results& frame, const char* name) {
    const std::string text = frame.provenance_value(name);
    long count = 0;
    std::from_chars(text.data(), text.data() + text.size(), count);
    return count;
}

BatchRows life_rows(const LifeTiles& tiles, const Sampler& sampler, const Batch& batch,
                    Seconds& seconds) {
    std::vector<GearboxId> ids;
    for (std::size_t i = 0; i < batch.gearboxes; ++i) {
        ids.push_back({batch.group, batch.first_index + i});
    }
    BatchRows rows;
    LifeCosts costs;
    for (std::size_t first = 0; first < ids.size(); first += tiles.lanes()) {
        const auto part =
            std::span(ids).subspan(first, std::min(tiles.lanes(), ids.size() - first));
        const auto lives = tiles.run(part, batch.group == Group::graded, costs);
        const auto looked = static_cast<std::size_t>(std::ranges::count_if(part, looked_at));
        std::vector<InterpolationErrors> errors(part.size());
        if (looked > 0) {
            std::ranges::copy(tiles.interpolation_errors(part.first(looked)), errors.begin());
        }
        for (std::size_t lane = 0; lane < part.size(); ++lane) {
            add_life(tiles.scene().study(), sampler.row(part[lane].group, part[lane].index),
                     lives[lane], errors[lane], rows);
        }
    }
    seconds.march += costs.gearboxes;
    seconds.features += costs.records;
    seconds.gearboxes += costs.gearbox_count;
    seconds.records += costs.record_count;
    return rows;
}

// A feature of all lives, or several as one.
class Watched {
  public:
    Watched(const Study& study, const Campaign& campaign, std::vector<std::size_t> features)
        : study_(study), features_(std::move(features)) {
        for (const features::Feature* feature : used_features(study)) {
            alarms_.push_back(analysis::alarm_of(*feature));
        }
        setting_ = healthy(campaign.setting);
        healthy_ = healthy(campaign.healthy);
        cracked_ = cracked(campaign.cracked);
    }

    analysis::LifeAnswers by(const analysis::Detector& detector, double per_1000_h) const {
        return analysis::answer(detector, setting_, healthy_, cracked_, per_1000_h,
                                study_.detection.confidence);
    }

    FeatureFan fan(const std::string& name) const {
        constexpr std::size_t kDrawn = 32;
        FeatureFan fan{name, {}, {}, {}, {}};
        for (std::size_t r = 0; r < static_cast<std::size_t>(study_.life.records); ++r) {
            std::vector<double> all;
            for (const analysis::HealthyLife& life : healthy_) {
                if (!std::isnan(life.values[r])) {
                    all.push_back(life.values[r]);
                }
            }
            std::ranges::sort(all);
            for (const auto& [share, into] :
                 {std::pair{0.05, &fan.low}, {0.5, &fan.median}, {0.95, &fan.high}}) {
                into->push_back(all.empty() ? std::nan("")
                                            : all[static_cast<std::size_t>(
                                                  share * static_cast<double>(all.size() - 1))]);
            }
        }
        for (std::size_t g = 0; g < std::min(kDrawn, cracked_.size()); ++g) {
            fan.lives.push_back(cracked_[g].values);
        }
        return fan;
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

    std::vector<analysis::CrackedLife> cracked(const std::vector<GearboxLife>& lives) const {
        std::vector<analysis::CrackedLife> all;
        for (const GearboxLife& life : lives) {
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
    const std::vector<std::size_t> features_;
    std::vector<analysis::Alarm> alarms_;
    std::vector<analysis::HealthyLife> setting_, healthy_;
    std::vector<analysis::CrackedLife> cracked_;
};

// Every feature, and what they say together, where that is more.
void for_each_watched(const Study& study, const Campaign& campaign,
                      const std::function<void(const std::string&, const Watched&)>& use) {
    std::vector<std::size_t> all;
    for (std::size_t f = 0; f < study.features.use.size(); ++f) {
        use(study.features.use[f], Watched(study, campaign, {f}));
        all.push_back(f);
    }
    if (all.size() > 1 && study.monitoring.baseline_records > 0) {
        use("fused", Watched(study, campaign, all));
    }
}

// The first is the better one: more found, then shallower.
bool better(const analysis::LifeAnswers& a, const analysis::LifeAnswers& b) {
    const auto key = [](const analysis::LifeAnswers& one) {
        const auto depth = [](double value) {
            return std::isnan(value) ? std::numeric_limits<double>::infinity() : value;
        };
        return std::tuple(-one.found, depth(one.size_90.value), depth(one.size_50.value));
    };
    return key(a) < key(b);
}

}  // namespace

EnsembleOutcome run_lives(const LifeTiles& tiles, const BatchPlan& plan, const EnsembleRun& run) {
    const Study& study = tiles.scene().study();
    const auto sampler = std::make_shared<const Sampler>(study);
    const BatchComputer compute = [&tiles, sampler](const Batch& batch, Seconds& seconds) {
        return life_rows(tiles, *sampler, batch, seconds);
    };
    return run_batches(study, plan, run,
                       [&]() -> BatchComputers { return [compute] { return compute; }; });
}

void note_run(const Scene& scene, const EnsembleOutcome& outcome, Results& frame) {
    frame.provenance.emplace_back(kRecordText, record_text(scene));
    const Seconds work = outcome.work();
    frame.timing.push_back({kGearboxTime, work.march});
    frame.timing.push_back({kRecordTime, work.features});
    frame.timing.push_back({"lives_s", outcome.wall_s});
    frame.provenance.emplace_back(kGearboxCount, std::to_string(work.gearboxes));
    frame.provenance.emplace_back(kRecordCount, std::to_string(work.records));
}

Campaign campaign_of(const Study& study, const Results& frame, const RowSource& rows) {
    Campaign campaign;
    const auto setting = static_cast<std::size_t>(study.ensemble.threshold_instances);
    rows.visit([&](const RowBlock& block) {
        for (std::size_t row = 0; row < block.count(); ++row) {
            LifeRow read = life_of_row(study, frame, block, row);
            campaign.interpolation.take(read.interpolation);
            campaign.failed += read.life.status == Status::ok ? 0 : 1;
            auto& lives = block.group[row] == static_cast<int>(Group::graded) ? campaign.cracked
                          : block.first + row < setting                       ? campaign.setting
                                                                              : campaign.healthy;
            lives.push_back(std::move(read.life));
        }
    });
    for (const Timing& timing : frame.timing) {
        campaign.costs.gearboxes += timing.name == kGearboxTime ? timing.seconds : 0.0;
        campaign.costs.records += timing.name == kRecordTime ? timing.seconds : 0.0;
    }
    campaign.record = frame.provenance_value(kRecordText);
    campaign.costs.gearbox_count = count_in(frame, kGearboxCount);
    campaign.costs.record_count = count_in(frame, kRecordCount);
    return campaign;
}

Campaign run_campaign(const Scene& scene) {
    const Study& study = scene.study();
    const LifeTiles tiles(scene);
    const BatchPlan plan = lives_plan(study);
    MemoryRows store(plan.batches());
    const Ranks alone;
    Progress silent(1, true);
    const EnsembleOutcome outcome =
        run_lives(tiles, plan, {.ranks = alone, .store = store, .progress = silent});
    if (!outcome.failure.empty()) {
        throw std::runtime_error(outcome.failure);
    }
    Results frame = lives_frame(study);
    note_run(scene, outcome, frame);
    return campaign_of(study, frame, StoredRows(store, plan, outcome.batches));
}

std::vector<MonitoredFeature> monitor(const Study& study, const Campaign& campaign) {
    std::vector<MonitoredFeature> monitored;
    for_each_watched(study, campaign, [&](const std::string& name, const Watched& watched) {
        for (const std::string& text : study.monitoring.detectors) {
            monitored.push_back({name, text,
                                 watched.by(*analysis::parse_detector(text),
                                            study.monitoring.false_alarms_per_1000_h)});
        }
    });
    return monitored;
}

std::vector<TradeOff> trade_offs(const Study& study, const Campaign& campaign,
                                 const std::vector<MonitoredFeature>& monitored) {
    std::vector<TradeOff> all;
    for_each_watched(study, campaign, [&](const std::string& name, const Watched& watched) {
        const MonitoredFeature* best = nullptr;
        for (const MonitoredFeature& one : monitored) {
            if (one.feature == name && (best == nullptr || better(one.answers, best->answers))) {
                best = &one;
            }
        }
        TradeOff trade{name, best->detector, {}};
        for (const double factor : {0.25, 0.5, 1.0, 2.0, 5.0, 10.0, 20.0}) {
            const double rate = factor * study.monitoring.false_alarms_per_1000_h;
            const auto answers = watched.by(*analysis::parse_detector(best->detector), rate);
            if (!std::isnan(answers.threshold.value)) {
                trade.points.push_back({rate, answers.false_alarms.per_1000_h, answers.share,
                                        answers.size_50.value, answers.size_90.value});
            }
        }
        all.push_back(std::move(trade));
    });
    return all;
}

std::vector<FeatureFan> fans(const Study& study, const Campaign& campaign) {
    std::vector<FeatureFan> all;
    for_each_watched(study, campaign, [&](const std::string& name, const Watched& watched) {
        all.push_back(watched.fan(name));
    });
    return all;
}

}  // namespace gearpod::mc
