#include "mc/lives/life_tile.hpp"

#include <algorithm>
#include <boost/random/uniform_int_distribution.hpp>
#include <cmath>

#include "machine/stop.hpp"
#include "machine/thread_clock.hpp"
#include "mc/gearbox/instance_signals.hpp"
#include "mc/lives/composed_signals.hpp"
#include "mc/scene/feature_needs.hpp"
#include "signals/noise/normals.hpp"

namespace gearpod::mc {
namespace {

using LaneFeatures = std::vector<const features::Feature*>;

bool compares_change(const LaneFeatures& features) {
    return std::ranges::any_of(features, [](const features::Feature* one) {
        return one->compared == features::Compared::change;
    });
}

// How much of each of factors_about() makes up another factor.
std::vector<double> shares_of(const std::vector<double>& factors, double factor) {
    if (factors.size() == 1) {
        return {1.0};
    }
    const double high = (factor - factors[0]) / (factors[1] - factors[0]);
    return {1.0 - high, high};
}

// Streams of a record's own, far behind those of all gearboxes. The first record's are the
// gearbox's: a life of one record is the record of a run.
GearboxId record_id(const GearboxId& id, std::size_t record, bool change) {
    constexpr int kRecordShift = 40;
    return {id.group, id.index + ((2 * record + (change ? 1 : 0)) << kRecordShift)};
}

}  // namespace

// One gearbox on its way through the steps of depth.
class LifeTiles::Lane {
  public:
    Lane(const LifeTiles& tiles, const GearboxId& id, bool cracked)
        : tiles_(tiles),
          id_(id),
          inputs_(tiles.inputs(id)),
          features_(used_features(tiles.scene_.study())),
          compares_(compares_change(features_)),
          span_(record_span(tiles.scene_, inputs_.speed_rad_s)),
          record_(tiles.scene_, 0, span_.turns * span_.recordings),
          change_(tiles.scene_, 0, span_.turns * span_.recordings) {
        life_.history = tiles.crack_.history(id, inputs_, cracked);
        life_.values.assign(features_.size(),
                            std::vector<double>(life_.history.records.size(), 0.0));
    }

    const InstanceInputs& inputs() const { return inputs_; }
    GearboxLife take() && { return std::move(life_); }
    void fail(Status status) {
        life_.status = status;
        life_.values.clear();
    }
    bool failed() const { return life_.status != Status::ok; }

    // The pattern that changes are counted from: as many records as the baseline has, before the
    // first one, each at its torque and speed, averaged. Recordings that are short count as many
    // as make up the span, which is heard once at least.
    void learn(const std::vector<LaneSignals>& healthy) {
        if (!compares_) {
            return;
        }
        const Study& study = tiles_.scene_.study();
        const auto records = static_cast<double>(std::max(1, study.monitoring.baseline_records));
        const double spans = static_cast<double>(span_.turns) * span_.recordings / span_.all_turns;
        noise_.sensor.resize(healthy.front().sensor.size());
        noise_.te_turn.assign(healthy.front().te_turn.size(), 0.0);
        Philox engine = gearbox_stream(study, id_, "life.pattern.noise");
        signals::draw_normals(engine, std::span(noise_.sensor));
        const double sigma = inputs_.noise_m_s2 * study.sensor.noise_levels.front() /
                             std::sqrt(std::max(1.0, records * spans)) *
                             std::exp(study.life.noise_scatter * study.life.noise_scatter);
        for (double& value : noise_.sensor) {
            value *= sigma;
        }
        const auto draws = [&](const char* purpose) {
            Philox own = gearbox_stream(study, id_, purpose);
            std::vector<double> unit(static_cast<std::size_t>(records));
            signals::draw_normals(own, std::span(unit));
            return unit;
        };
        const auto torques = draws("life.pattern.torque"), speeds = draws("life.pattern.speed");
        pattern_.assign(healthy.size(), 0.0);
        for (std::size_t i = 0; i < torques.size(); ++i) {
            const auto shares = tiles_.shares({std::exp(study.life.torque_scatter * torques[i]),
                                               std::exp(study.life.speed_scatter * speeds[i])});
            for (std::size_t t = 0; t < shares.size(); ++t) {
                pattern_[t] += inputs_.gain * shares[t] / records;
            }
        }
    }

    // Records whose depth lies in (low, high], with `low` 0 those without a crack too. Signals by
    // load at no depth, at low and at high; those at high may be empty if none lies above low.
    void listen(double low, double high, const std::vector<LaneSignals>& healthy,
                const std::vector<LaneSignals>& at_low, const std::vector<LaneSignals>& at_high) {
        std::vector<std::size_t> here;
        for (std::size_t r = 0; r < life_.history.records.size(); ++r) {
            const double depth = life_.history.records[r].depth_m;
            if ((depth > low && depth <= high) || (low == 0.0 && depth == 0.0)) {
                here.push_back(r);
            }
        }
        if (here.empty()) {
            return;
        }
        std::vector<const LaneSignals*> basis;
        const auto add = [&](const std::vector<LaneSignals>& all) {
            for (const LaneSignals& one : all) {
                basis.push_back(&one);
            }
        };
        add(healthy);
        if (low > 0.0) {
            add(at_low);
        }
        add(at_high);
        if (compares_) {
            basis.push_back(&noise_);
        }
        const std::size_t bins = static_cast<std::size_t>(tiles_.scene_.span().planet_teeth) *
                                 static_cast<std::size_t>(tiles_.scene_.samples_per_mesh());
        const ComposedSignals composed(basis, bins, span_.turns >= span_.all_turns);
        for (const std::size_t r : here) {
            machine::leave_if_stopped();
            add_record(r, low, high, composed, basis.size());
        }
    }

  private:
    void add_record(std::size_t r, double low, double high, const ComposedSignals& composed,
                    std::size_t parts) {
        const LifeRecord& record = life_.history.records[r];
        const std::vector<double> shares = tiles_.shares({record.torque, record.speed});
        const double deep = record.depth_m > 0.0 ? (record.depth_m - low) / (high - low) : 0.0;
        std::vector<double> coefficients(parts, 0.0);
        const std::size_t n = shares.size();
        for (std::size_t t = 0; t < n; ++t) {
            const double one = inputs_.gain * record.gain * shares[t];
            coefficients[(low > 0.0 ? n : 0) + t] += (1.0 - deep) * one;
            if (deep > 0.0) {
                coefficients[(low > 0.0 ? 2 * n : n) + t] += deep * one;
            }
        }
        InstanceInputs inputs = inputs_;
        inputs.noise_m_s2 *= record.noise;
        inputs.encoder_noise_rad *= record.noise;
        const std::vector<std::size_t> starts = starts_of(r);
        LaneSignals own = heard(composed, coefficients, starts);
        for (double& value : own.te_turn) {
            value /= inputs_.gain * record.gain;  // of the sensor alone
        }
        record_.load(own, inputs, record_id(id_, r, false));
        features::FeatureInput input = record_.at(0), change;
        LaneSignals changed;
        if (compares_) {
            for (std::size_t t = 0; t < n; ++t) {
                coefficients[t] -= pattern_[t];
            }
            coefficients.back() = -1.0;
            changed = heard(composed, coefficients, starts);
            change_.load(changed, inputs, record_id(id_, r, true));
            change = change_.at(0);
            input.change = &change;
        }
        for (std::size_t f = 0; f < features_.size(); ++f) {
            const double value = features_[f]->value(input);
            life_.values[f][r] = std::isfinite(value) ? value : std::nan("");
        }
    }

    // The turns with which a record's recordings begin; none where they hold all turns.
    std::vector<std::size_t> starts_of(std::size_t r) const {
        std::vector<std::size_t> starts;
        if (!span_.whole()) {
            Philox engine =
                gearbox_stream(tiles_.scene_.study(), record_id(id_, r, false), "life.starts");
            boost::random::uniform_int_distribution<std::size_t> turn(
                0, static_cast<std::size_t>(span_.all_turns) - 1);
            for (int i = 0; i < span_.recordings; ++i) {
                starts.push_back(turn(engine));
            }
        }
        return starts;
    }

    // Folded over all that a record's recordings take in.
    LaneSignals heard(const ComposedSignals& composed, std::span<const double> coefficients,
                      const std::vector<std::size_t>& starts) const {
        const int spans = span_.turns / span_.all_turns * span_.recordings;
        LaneSignals sum = composed.at(coefficients);
        for (double& value : sum.folded) {
            value *= spans;
        }
        for (const std::size_t start : starts) {
            composed.add_turns(coefficients, start,
                               static_cast<std::size_t>(span_.turns % span_.all_turns), sum.folded);
        }
        return sum;
    }

    const LifeTiles& tiles_;
    const GearboxId id_;
    const InstanceInputs inputs_;
    const LaneFeatures features_;
    const bool compares_;
    const RecordSpan span_;
    InstanceSignals record_, change_;
    GearboxLife life_;
    LaneSignals noise_;            // of the pattern
    std::vector<double> pattern_;  // coefficients of the healthy signals
};

std::vector<double> factors_about(double scatter) {
    return scatter == 0.0 ? std::vector<double>{1.0}
                          : std::vector<double>{std::exp(-1.5 * scatter), std::exp(1.5 * scatter)};
}

LifeTiles::LifeTiles(const Scene& scene)
    : scene_((check_composable(scene), scene)),
      sampler_(scene.study()),
      path_(path_grid(scene)),
      crack_(scene) {}

std::size_t LifeTiles::lanes() const {
    return static_cast<std::size_t>(scene_.study().numerics.lanes);
}

InstanceInputs LifeTiles::inputs(const GearboxId& id) const {
    InstanceInputs inputs = sampler_.sample(id.group, id.index);
    inputs.fault_size = 0.0;
    return inputs;
}

double LifeTiles::depth(int step) const {
    return *scene_.study().life.last_depth_m * step / scene_.study().life.depth_steps;
}

std::vector<LifeTiles::Load> LifeTiles::loads() const {
    std::vector<Load> all;
    for (const double torque : factors_about(scene_.study().life.torque_scatter)) {
        for (const double speed : factors_about(scene_.study().life.speed_scatter)) {
            all.push_back({torque, speed});
        }
    }
    return all;
}

std::vector<double> LifeTiles::shares(const Load& load) const {
    const Life& life = scene_.study().life;
    std::vector<double> all;
    for (const double torque : shares_of(factors_about(life.torque_scatter), load.torque)) {
        for (const double speed : shares_of(factors_about(life.speed_scatter), load.speed)) {
            all.push_back(torque * speed);
        }
    }
    return all;
}

HealthyMarch LifeTiles::march(std::span<const GearboxId> ids, const Load& load) const {
    std::vector<InstanceInputs> all;
    for (const GearboxId& id : ids) {
        all.push_back(inputs(id));
        all.back().torque_N_m *= load.torque;
        all.back().fixed_shaft.load_torque_N_m *= load.torque;
        all.back().speed_rad_s *= load.speed;
    }
    return {scene_, path_, ids, std::move(all), static_cast<int>(lanes())};
}

std::vector<GearboxLife> LifeTiles::run(std::span<const GearboxId> ids, bool cracked,
                                        LifeCosts& costs) const {
    std::vector<Lane> lanes;
    double start = thread_processor_s();
    const auto lap = [&](double& sum) {
        const double now = thread_processor_s();
        sum += now - start;
        start = now;
    };
    for (const GearboxId& id : ids) {
        lanes.emplace_back(*this, id, cracked);
    }
    std::vector<HealthyMarch> marches;
    for (const Load& load : loads()) {
        marches.push_back(march(ids, load));
    }
    // [lane][load]
    const auto at_depth = [&](double depth_m) {
        std::vector<std::vector<LaneSignals>> all(ids.size());
        for (const HealthyMarch& one : marches) {
            HealthyMarch::Signals marched = depth_m > 0.0 ? one.with_fault(depth_m) : one.healthy();
            for (std::size_t lane = 0; lane < ids.size(); ++lane) {
                all[lane].push_back(std::move(marched.lane[lane]));
                if (marched.status[lane] != Status::ok && !lanes[lane].failed()) {
                    lanes[lane].fail(marched.status[lane]);
                }
            }
        }
        return all;
    };
    const auto healthy = at_depth(0.0);
    auto low = healthy;
    for (int step = 0; step < (cracked ? scene_.study().life.depth_steps : 1); ++step) {
        auto high =
            cracked ? at_depth(depth(step + 1)) : std::vector<std::vector<LaneSignals>>(ids.size());
        for (std::size_t lane = 0; lane < ids.size(); ++lane) {
            if (lanes[lane].failed()) {
                continue;
            }
            if (step == 0) {
                lanes[lane].learn(healthy[lane]);
            }
            lap(costs.gearboxes);
            lanes[lane].listen(depth(step), depth(step + 1), healthy[lane], low[lane], high[lane]);
            lap(costs.records);
        }
        low = std::move(high);
    }
    std::vector<GearboxLife> lives;
    for (Lane& lane : lanes) {
        lives.push_back(std::move(lane).take());
        costs.record_count += static_cast<long>(lives.back().history.records.size());
    }
    costs.gearbox_count += static_cast<long>(ids.size());
    lap(costs.gearboxes);
    return lives;
}

}  // namespace gearpod::mc
