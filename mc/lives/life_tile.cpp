#include "mc/lives/life_tile.hpp"

#include <algorithm>
#include <cmath>

#include "machine/stop.hpp"
#include "machine/thread_clock.hpp"
#include "mc/gearbox/instance_signals.hpp"
#include "mc/lives/composed_signals.hpp"
#include "mc/scene/feature_needs.hpp"
#include "mc/scene/scene_error.hpp"
#include "mc/study/fluctuations.hpp"
#include "signals/noise/normals.hpp"

namespace gearpod::mc {
namespace {

using LaneFeatures = std::vector<const features::Feature*>;

bool compares_change(const LaneFeatures& features) {
    return std::ranges::any_of(features, [](const features::Feature* one) {
        return one->compared == features::Compared::change;
    });
}

void check_composable(const Study& study) {
    const auto reject = [](const char* key, const std::string& what, const char* remedy) {
        throw SceneError(key, what, remedy);
    };
    if (!study.life.interval_h) {
        reject("life.interval_h", "missing: how often a gearbox is measured", "add [life]");
    }
    for (const features::Feature* feature : used_features(study)) {
        const bool own = feature->compared == features::Compared::baseline;
        if (own || (feature->needs & ~features::kChange) != 0) {
            reject("features.use",
                   "\"" + std::string(feature->name) +
                       (own ? "\": a life has its own baseline (monitoring.baseline_records)"
                            : "\" looks at samples, and records are composed of folded squares"),
                   "use te_..., sensor_rms, window_ratio, window_z, change_window_ratio or "
                   "change_window_z");
        }
    }
    if (study.effects.quasi_static()) {
        reject("effects.motion", "without inertia there is no sensor to compose records for",
               "use motion = \"translational-torsional\" or \"torsional\"");
    }
    if (study.sensor.noise_levels.size() != 1) {
        reject("sensor.noise_levels", "a life has one noise", "use noise_levels = [1]");
    }
    if (draws_fluctuations(study) || !study.sensor.tones.empty()) {
        reject("life.interval_h",
               "records are composed of steady signals, and the study has fluctuations, gravity or "
               "tones that begin anew in each",
               "leave them out");
    }
}

// Rms of signal - (a share_a + b share_b).
double rms_apart(std::span<const double> signal, std::span<const double> a, double share_a,
                 std::span<const double> b, double share_b) {
    double sum = 0.0;
    for (std::size_t i = 0; i < signal.size(); ++i) {
        const double miss = signal[i] - share_a * a[i] - share_b * b[i];
        sum += miss * miss;
    }
    return std::sqrt(sum / static_cast<double>(signal.size()));
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
          record_(tiles.scene_, 0),
          change_(tiles.scene_, 0) {
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
    // first one, each at its torque, averaged.
    void learn(const std::vector<LaneSignals>& healthy) {
        if (!compares_) {
            return;
        }
        const Study& study = tiles_.scene_.study();
        const auto records = static_cast<double>(std::max(1, study.monitoring.baseline_records));
        noise_.sensor.resize(healthy.front().sensor.size());
        noise_.te_turn.assign(healthy.front().te_turn.size(), 0.0);
        Philox engine = gearbox_stream(study, id_, "life.pattern.noise");
        signals::draw_normals(engine, std::span(noise_.sensor));
        const double sigma = inputs_.noise_m_s2 * study.sensor.noise_levels.front() /
                             std::sqrt(records) *
                             std::exp(study.life.noise_scatter * study.life.noise_scatter);
        for (double& value : noise_.sensor) {
            value *= sigma;
        }
        Philox torques = gearbox_stream(study, id_, "life.pattern.torque");
        std::vector<double> unit(static_cast<std::size_t>(records));
        signals::draw_normals(torques, std::span(unit));
        pattern_.assign(healthy.size(), 0.0);
        for (const double one : unit) {
            const auto shares = tiles_.shares(std::exp(study.life.torque_scatter * one));
            for (std::size_t t = 0; t < shares.size(); ++t) {
                pattern_[t] += inputs_.gain * shares[t] / records;
            }
        }
    }

    // Records whose depth lies in (low, high], with `low` 0 those without a crack too. Signals by
    // torque at no depth, at low and at high; those at high may be empty if none lies above low.
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
        const ComposedSignals composed(basis, bins);
        for (const std::size_t r : here) {
            machine::leave_if_stopped();
            add_record(r, low, high, composed, basis.size());
        }
    }

  private:
    void add_record(std::size_t r, double low, double high, const ComposedSignals& composed,
                    std::size_t parts) {
        const LifeRecord& record = life_.history.records[r];
        const std::vector<double> shares = tiles_.shares(record.torque);
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
        LaneSignals own = composed.at(coefficients);
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
            changed = composed.at(coefficients);
            change_.load(changed, inputs, record_id(id_, r, true));
            change = change_.at(0);
            input.change = &change;
        }
        for (std::size_t f = 0; f < features_.size(); ++f) {
            const double value = features_[f]->value(input);
            life_.values[f][r] = std::isfinite(value) ? value : std::nan("");
        }
    }

    const LifeTiles& tiles_;
    const GearboxId id_;
    const InstanceInputs inputs_;
    const LaneFeatures features_;
    const bool compares_;
    InstanceSignals record_, change_;
    GearboxLife life_;
    LaneSignals noise_;            // of the pattern
    std::vector<double> pattern_;  // coefficients of the healthy signals
};

LifeTiles::LifeTiles(const Scene& scene)
    : scene_((check_composable(scene.study()), scene)),
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

std::vector<double> LifeTiles::torques() const {
    const double scatter = scene_.study().life.torque_scatter;
    if (scatter == 0.0) {
        return {1.0};
    }
    return {std::exp(-1.5 * scatter), std::exp(1.5 * scatter)};
}

std::vector<double> LifeTiles::shares(double torque) const {
    const std::vector<double> marched = torques();
    if (marched.size() == 1) {
        return {1.0};
    }
    const double high = (torque - marched[0]) / (marched[1] - marched[0]);
    return {1.0 - high, high};
}

std::vector<LaneSignals> LifeTiles::march(std::span<const GearboxId> ids, double depth_m,
                                          double torque, std::vector<Status>& status) const {
    std::vector<InstanceInputs> all;
    for (const GearboxId& id : ids) {
        all.push_back(inputs(id));
        all.back().fault_size = depth_m;
        all.back().torque_N_m *= torque;
        all.back().fixed_shaft.load_torque_N_m *= torque;
        all.back().gain = 1.0;  // each record has its own
    }
    const GearboxTile tile = run_given(scene_, path_, ids, all, static_cast<int>(lanes()));
    auto signals = all_lane_signals(scene_, path_, tile, scene_.span_meshes());
    for (std::size_t lane = 0; lane < ids.size(); ++lane) {
        if (tile.status[lane] != Status::ok) {
            status[lane] = tile.status[lane];
            signals[lane] = {};
        }
    }
    return signals;
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
    std::vector<Status> status(ids.size(), Status::ok);
    // [lane][torque]
    const auto at_depth = [&](double depth_m) {
        std::vector<std::vector<LaneSignals>> all(ids.size());
        for (const double torque : torques()) {
            auto marched = march(ids, depth_m, torque, status);
            for (std::size_t lane = 0; lane < ids.size(); ++lane) {
                all[lane].push_back(std::move(marched[lane]));
            }
        }
        for (std::size_t lane = 0; lane < ids.size(); ++lane) {
            if (status[lane] != Status::ok && !lanes[lane].failed()) {
                lanes[lane].fail(status[lane]);
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

InterpolationErrors LifeTiles::interpolation_errors(std::span<const GearboxId> ids) const {
    const int last = scene_.study().life.depth_steps - 1;
    const std::vector<double> torque = torques();
    InterpolationErrors errors;
    errors.first_m = 0.5 * depth(1);
    errors.last_m = 0.5 * (depth(last) + depth(last + 1));
    std::vector<Status> status(ids.size(), Status::ok);
    const auto healthy = march(ids, 0.0, torque[0], status);
    const auto first = march(ids, depth(1), torque[0], status);
    const auto before = march(ids, depth(last), torque[0], status);
    const auto behind = march(ids, depth(last + 1), torque[0], status);
    const auto in_first = march(ids, errors.first_m, torque[0], status);
    const auto in_last = march(ids, errors.last_m, torque[0], status);
    const auto between = march(ids, 0.0, 1.0, status);
    const auto loaded = torque.size() > 1 ? march(ids, 0.0, torque[1], status) : between;
    const std::vector<double> share = shares(1.0);
    for (std::size_t lane = 0; lane < ids.size(); ++lane) {
        if (status[lane] != Status::ok) {
            continue;
        }
        const auto& none = healthy[lane].sensor;
        const auto take = [](double& largest, double error) { largest = std::max(largest, error); };
        take(errors.first, rms_apart(in_first[lane].sensor, none, 0.5, first[lane].sensor, 0.5) /
                               rms_apart(in_first[lane].sensor, none, 1.0, none, 0.0));
        take(errors.last,
             rms_apart(in_last[lane].sensor, before[lane].sensor, 0.5, behind[lane].sensor, 0.5) /
                 rms_apart(in_last[lane].sensor, none, 1.0, none, 0.0));
        if (torque.size() > 1) {
            take(errors.torque,
                 rms_apart(between[lane].sensor, none, share[0], loaded[lane].sensor, share[1]) /
                     rms_apart(between[lane].sensor, none, 0.0, none, 0.0));
        }
    }
    return errors;
}

}  // namespace gearpod::mc
