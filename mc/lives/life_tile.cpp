#include "mc/lives/life_tile.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <boost/random/uniform_int_distribution.hpp>
#include <cmath>

#include "machine/clocks.hpp"
#include "machine/team.hpp"
#include "mc/ensemble/gearbox/realization_features.hpp"
#include "mc/ensemble/gearbox/realization_signals.hpp"
#include "mc/plan/record_plan.hpp"
#include "mc/study/sensor_signal.hpp"
#include "signals/noise/normals.hpp"

namespace gearpod::mc {

void InterpolationErrors::take(const InterpolationErrors& other) {
    first = std::fmax(first, other.first);
    last = std::fmax(last, other.last);
    load = std::fmax(load, other.load);
}

LifeTiles::LifeTiles(const TilePlan& tile, LifePlan plan)
    : tile_(tile.of_span()),
      plan_(std::move(plan)),
      torques_(plan_.distributions.torque, plan_.torques),
      speeds_(plan_.distributions.speed, plan_.speeds),
      crack_(plan_) {}

std::size_t LifeTiles::lanes() const {
    return static_cast<std::size_t>(plan_.campaign.ensemble.lanes);
}

std::size_t LifeTiles::gap_count() const {
    const bool interpolates = torques_.interpolates() || speeds_.interpolates();
    return load_count() == 1 || !interpolates
               ? 0
               : torques_.between().size() * speeds_.between().size();
}

Realization LifeTiles::draw(const GearboxId& id) const {
    Realization gearbox = plan_.sampler->draw(id);
    gearbox.inputs.fault_size = 0.0;
    return gearbox;
}

std::vector<LifeTiles::Load> LifeTiles::loads() const {
    std::vector<Load> all;
    for (const double torque : torques_.factors()) {
        for (const double speed : speeds_.factors()) {
            all.push_back({torque, speed});
        }
    }
    return all;
}

std::vector<double> LifeTiles::load_weights(const Load& load) const {
    std::vector<double> all;
    for (const double torque : torques_.weights(load.torque)) {
        for (const double speed : speeds_.weights(load.speed)) {
            all.push_back(torque * speed);
        }
    }
    return all;
}

HealthySolution LifeTiles::healthy_solution(std::span<const Realization> gearboxes,
                                            const Load& load) const {
    std::vector<Realization> all(gearboxes.begin(), gearboxes.end());
    for (Realization& gearbox : all) {
        gearbox.inputs.torque_N_m *= load.torque;
        gearbox.inputs.fixed_shaft.load_torque_N_m *= load.torque;
        gearbox.inputs.speed_rad_s *= load.speed;
    }
    return {tile_, std::move(all), static_cast<int>(lanes())};
}

class LifeTiles::Lane {
  public:
    using LaneFeatures = std::vector<const features::Feature*>;

    Lane(const LifeTiles& tiles, const Realization& gearbox, bool cracked)
        : tiles_(tiles),
          id_(gearbox.id),
          inputs_(gearbox.inputs),
          features_(tiles.tile_.features.used),
          needs_(compared_needs(features_, /*superposed=*/true)),
          span_(tiles.plan_.record_span(inputs_.speed_rad_s)),
          record_(signals_with(needs_.record)),
          change_(signals_with(needs_.change)),
          reference_(signals_with(needs_.baseline)),
          python_(tiles.tile_.record, tiles.tile_.features, features_) {
        life_.history = tiles.crack_.history(gearbox, cracked);
        life_.values.assign(features_.size(),
                            std::vector<double>(life_.history.records.size(), 0.0));
    }

    const InstanceInputs& inputs() const { return inputs_; }
    const LifeHistory& history() const { return life_.history; }
    GearboxLife take() && { return std::move(life_); }
    void fail(Status status) {
        life_.status = status;
        life_.values.clear();
    }
    bool failed() const { return life_.status != Status::ok; }

    // Computes the reference pattern from which changes are measured: the average of as many
    // records as the baseline has, taken before the first record, each at its own torque and speed.
    // Recordings shorter than the span count in proportion, with at least one span in total.
    void compute_reference_pattern(const std::vector<LaneSignals>& healthy) {
        if (!compares()) {
            return;
        }
        const LifePlan& plan = tiles_.plan_;
        const auto records = static_cast<double>(std::max(1, plan.campaign.baseline_records));
        const double spans = static_cast<double>(span_.turns) * span_.recordings / span_.all_turns;
        noise_.sensor.resize(healthy.front().sensor.size());
        noise_.te_turn.assign(healthy.front().te_turn.size(), 0.0);
        Philox engine = gearbox_stream(plan.seed, id_, StreamPurpose::reference_noise);
        if (noise_stage().by_density()) {
            draw_unit_noise(noise_stage(), noise_of(inputs_), tiles_.tile_.record.sample_s(inputs_),
                            NoiseEngines<Philox>{engine, engine, engine}, std::span(noise_.sensor));
        } else {
            signals::draw_normals(engine, std::span(noise_.sensor));
        }
        const double sigma = inputs_.noise_m_s2 * plan.noise_level /
                             std::sqrt(std::max(1.0, records * spans)) *
                             plan.distributions.noise.rms();
        for (double& value : noise_.sensor) {
            value *= sigma;
        }
        const auto normals = [&](StreamPurpose purpose) {
            Philox stream = gearbox_stream(plan.seed, id_, purpose);
            std::vector<double> unit(static_cast<std::size_t>(records));
            signals::draw_normals(stream, std::span(unit));
            return unit;
        };
        const auto torques = normals(StreamPurpose::reference_torques),
                   speeds = normals(StreamPurpose::reference_speeds);
        pattern_.assign(healthy.size(), 0.0);
        for (std::size_t i = 0; i < torques.size(); ++i) {
            const auto load_weights =
                tiles_.load_weights({tiles_.plan_.distributions.torque.factor(torques[i]),
                                     tiles_.plan_.distributions.speed.factor(speeds[i])});
            for (std::size_t t = 0; t < load_weights.size(); ++t) {
                pattern_[t] += inputs_.gain * load_weights[t] / records;
            }
        }
    }

    // Computes the records whose depth lies in (low, high]; for `low` = 0 also those without a
    // crack. The signals are given by load for zero depth, `low` and `high`. Those at `high` may be
    // empty if no record is deeper than `low`.
    void compute_records(double low, double high, const std::vector<LaneSignals>& healthy,
                         const std::vector<LaneSignals>& at_low,
                         const std::vector<LaneSignals>& at_high) {
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
        const std::vector<LaneSignals> none;
        const auto basis = basis_of(healthy, low > 0.0 ? at_low : none, at_high);
        const SuperposedSignals superposed = superpose(basis);
        for (const std::size_t r : here) {
            machine::throw_if_cancelled();
            add_record(r, low, high, superposed, basis.size());
        }
    }

    // Basis signals of which records are linear combinations.
    std::vector<const LaneSignals*> basis_of(const std::vector<LaneSignals>& healthy,
                                             const std::vector<LaneSignals>& at_low,
                                             const std::vector<LaneSignals>& at_high) const {
        std::vector<const LaneSignals*> basis;
        for (const auto* all : {&healthy, &at_low, &at_high}) {
            for (const LaneSignals& signals : *all) {
                basis.push_back(&signals);
            }
        }
        if (compares()) {
            basis.push_back(&noise_);
        }
        return basis;
    }

    SuperposedSignals superpose(const std::vector<const LaneSignals*>& basis) const {
        const std::size_t bins = static_cast<std::size_t>(tiles_.tile_.record.span.planet_teeth) *
                                 static_cast<std::size_t>(tiles_.tile_.record.samples);
        return {basis, bins, span_.turns >= span_.all_turns};
    }

  private:
    // Random streams of single records, far beyond those of all gearboxes. The first record uses
    // the stream of the gearbox, so that a life of one record equals a record of `run`.
    static GearboxId record_id(const GearboxId& id, std::size_t record, bool change) {
        constexpr int kRecordShift = 40;
        return {id.group, id.index + ((2 * record + (change ? 1 : 0)) << kRecordShift)};
    }

    std::vector<double> coefficients_of(const LifeRecord& record, double low, double high,
                                        std::size_t parts) const {
        const std::vector<double> load_weights = tiles_.load_weights({record.torque, record.speed});
        const double depth_fraction =
            record.depth_m > 0.0 ? (record.depth_m - low) / (high - low) : 0.0;
        std::vector<double> coefficients(parts, 0.0);
        const std::size_t n = load_weights.size();
        for (std::size_t t = 0; t < n; ++t) {
            const double factor = inputs_.gain * record.gain * load_weights[t];
            coefficients[(low > 0.0 ? n : 0) + t] += (1.0 - depth_fraction) * factor;
            if (depth_fraction > 0.0) {
                coefficients[(low > 0.0 ? 2 * n : n) + t] += depth_fraction * factor;
            }
        }
        return coefficients;
    }

    InstanceInputs inputs_of(const LifeRecord& record) const {
        InstanceInputs inputs = inputs_;
        if (tiles_.plan_.distributions.sensor_noise_only) {
            const SensorNoise noise = noise_stage().with_rms_factor(noise_of(inputs), record.noise);
            inputs.noise_m_s2 = noise.all_m_s2;
            inputs.white_noise_m_s2 = noise.white_m_s2;
        } else {
            inputs.noise_m_s2 *= record.noise;
            inputs.white_noise_m_s2 *= record.noise;
            inputs.background_noise_m_s2 *= record.noise;
            inputs.encoder_noise_rad *= record.noise;
        }
        return inputs;
    }

    void add_record(std::size_t r, double low, double high, const SuperposedSignals& superposed,
                    std::size_t parts) {
        const LifeRecord& record = life_.history.records[r];
        std::vector<double> coefficients = coefficients_of(record, low, high, parts);
        Realization realization{record_id(id_, r, false), inputs_of(record)};
        const std::vector<std::size_t> starts = starts_of(r);
        LaneSignals folded = fold_record(superposed, coefficients, starts);
        for (double& value : folded.te_turn) {
            value /= inputs_.gain * record.gain;  // the gain belongs to the sensor only
        }
        record_.load(folded, realization);
        features::FeatureInput input = record_.at(0), change, reference;
        LaneSignals changed, before;
        if (!needs_.baseline.empty()) {
            std::vector<double> pattern(parts, 0.0);
            std::ranges::copy(pattern_, pattern.begin());
            pattern.back() = 1.0;
            before = fold_record(superposed, pattern, starts);
            for (double& value : before.te_turn) {
                value /= inputs_.gain;
            }
            reference_.load(before, realization.inputs, no_noise(before));
            reference = reference_.at(0);
            input.baseline = &reference;
        }
        if (!needs_.change.empty()) {
            for (std::size_t t = 0; t < pattern_.size(); ++t) {
                coefficients[t] -= pattern_[t];
            }
            coefficients.back() = -1.0;
            changed = fold_record(superposed, coefficients, starts);
            if (uses_samples()) {
                change_.load(changed, realization.inputs,
                             noise_of_change(tiles_.tile_.record, changed, record_.noise(), {}));
            } else {
                realization.id = record_id(id_, r, true);
                change_.load(changed, realization);
            }
            change = change_.at(0);
            input.change = &change;
        }
        set_values(r, realization.inputs, input);
    }

    // Noise of signals that already contain theirs.
    static RealizationNoise no_noise(const LaneSignals& signals) {
        const std::vector<double> bins(signals.folded.size(), 0.0);
        return {{bins, bins},
                std::vector<double>(signals.sensor.size(), 0.0),
                std::vector<double>(signals.te_turn.size(), 0.0)};
    }

    // Computes the features of a record. The transmission error is averaged over the whole span, so
    // that those in Python do not get it if records have another length.
    void set_values(std::size_t r, InstanceInputs inputs, features::FeatureInput& input) {
        const LifeRecord& record = life_.history.records[r];
        for (std::size_t f = 0; f < features_.size(); ++f) {
            if (!features_[f]->external) {
                set_value(f, r, features_[f]->value(input));
            }
        }
        if (python_.empty()) {
            return;
        }
        inputs.torque_N_m *= record.torque;
        inputs.speed_rad_s *= record.speed;
        if (tiles_.plan_.length.given()) {
            input.get<features::TeTurn>() = {};
        }
        python_.add(tiles_.plan_.noise_level, inputs, input);
        const std::string work =
            fmt::format("{} gearbox {}, record {} of its life",
                        id_.group == Group::threshold ? "healthy" : "cracked", id_.index, r + 1);
        const std::vector<double> values = python_.compute(work);
        print_python_problems(python_.problems(), work);
        for (std::size_t f = 0, next = 0; f < features_.size(); ++f) {
            if (features_[f]->external) {
                set_value(f, r, values[next++]);
            }
        }
    }

    void set_value(std::size_t feature, std::size_t r, double value) {
        life_.values[feature][r] = std::isfinite(value) ? value : std::nan("");
    }

    // True if records are compared with the reference pattern.
    bool compares() const { return !needs_.change.empty() || !needs_.baseline.empty(); }
    bool uses_samples() const {
        return needs_samples(needs_.record) || needs_samples(needs_.change);
    }

    // First turns of the recordings of a record; empty if each recording contains all turns.
    std::vector<std::size_t> starts_of(std::size_t r) const {
        std::vector<std::size_t> starts;
        if (!span_.whole()) {
            Philox engine = gearbox_stream(tiles_.plan_.seed, record_id(id_, r, false),
                                           StreamPurpose::life_recording_starts);
            boost::random::uniform_int_distribution<std::size_t> turn(
                0, static_cast<std::size_t>(span_.all_turns) - 1);
            for (int i = 0; i < span_.recordings; ++i) {
                starts.push_back(turn(engine));
            }
        }
        return starts;
    }

    LaneSignals fold_record(const SuperposedSignals& superposed,
                            std::span<const double> coefficients,
                            const std::vector<std::size_t>& starts) const {
        const int spans = span_.turns / span_.all_turns * span_.recordings;
        LaneSignals sum = superposed.at(coefficients);
        for (double& value : sum.folded) {
            value *= spans;
        }
        for (const std::size_t start : starts) {
            superposed.add_turns(coefficients, start,
                                 static_cast<std::size_t>(span_.turns % span_.all_turns),
                                 sum.folded);
        }
        if (uses_samples() || noise_stage().by_density()) {
            sum.turns = span_.turns * span_.recordings;
            add_samples(superposed, coefficients, starts, sum.sensor);
        }
        return sum;
    }

    void add_samples(const SuperposedSignals& superposed, std::span<const double> coefficients,
                     const std::vector<std::size_t>& starts, std::vector<double>& samples) const {
        for (int i = 0; i < span_.recordings; ++i) {
            superposed.append_turns(coefficients,
                                    starts.empty() ? 0 : starts[static_cast<std::size_t>(i)],
                                    static_cast<std::size_t>(span_.turns), samples);
        }
    }

    RealizationSignals signals_with(features::SignalSet needs) const {
        const TilePlan& plan = tiles_.tile_;
        return {plan.record, plan.features, plan.sensors->front(), needs,
                span_.turns * span_.recordings};
    }
    const NoiseStage& noise_stage() const { return tiles_.tile_.sensors->front().noise(); }

    const LifeTiles& tiles_;
    const GearboxId id_;
    const InstanceInputs inputs_;
    const LaneFeatures features_;
    const ComparedNeeds needs_;
    const RecordSpan span_;
    RealizationSignals record_, change_, reference_;
    PythonFeatures python_;
    GearboxLife life_;
    LaneSignals noise_;            // noise of the reference pattern
    std::vector<double> pattern_;  // coefficients of the healthy signals
};

// Measures interpolation errors of gearboxes while they are integrated.
class LifeTiles::InterpolationCheck {
  public:
    // `solution` holds these gearboxes at the first load. All arguments must outlive the object.
    InterpolationCheck(const LifeTiles& tiles, std::span<const Realization> gearboxes,
                       const HealthySolution& solution, std::span<InterpolationErrors> errors)
        : tiles_(tiles), gearboxes_(gearboxes), solution_(solution), errors_(errors) {}

    // Computes the largest error halfway between neighbouring loads.
    void between_loads(const SignalsByLoad& healthy) {
        if (errors_.empty() || tiles_.gap_count() == 0) {
            for (InterpolationErrors& errors : errors_) {
                errors.load = 0.0;
            }
            return;
        }
        for (const double torque : tiles_.torques_.between()) {
            for (const double speed : tiles_.speeds_.between()) {
                at_load({torque, speed}, healthy);
            }
        }
    }

    // Computes the error at the middle of a depth step at the first load. Only the step in which
    // the crack begins to grow and the last step are evaluated.
    void between_depths(int step, const SignalsByLoad& healthy, const SignalsByLoad& low,
                        const SignalsByLoad& high) {
        const CampaignPlan& campaign = tiles_.plan_.campaign;
        const bool first = step == campaign.first_step, last = step + 1 == campaign.depth_steps;
        if (errors_.empty() || !(first || last)) {
            return;
        }
        const HealthySolution::Signals middle = solution_.with_fault(campaign.middle_m(step));
        for (LaneId lane{0}; lane < errors_.size(); ++lane) {
            const auto& none = healthy[lane][0].sensor;
            const auto& between = middle.lane[lane].sensor;
            const auto &below = low[lane][0].sensor, &above = high[lane][0].sensor;
            if (between.empty() || none.empty() || below.empty() || above.empty()) {
                errors_[lane] = {};
                continue;
            }
            const double error = rms_apart(between, below, 0.5, above, 0.5) /
                                 rms_apart(between, none, 1.0, none, 0.0);
            if (first) {
                errors_[lane].first = error;
            }
            if (last) {
                errors_[lane].last = error;
            }
        }
    }

  private:
    void at_load(const Load& load, const SignalsByLoad& healthy) {
        const HealthySolution there = tiles_.healthy_solution(gearboxes_, load);
        const std::vector<double> load_weights = tiles_.load_weights(load);
        for (LaneId lane{0}; lane < errors_.size(); ++lane) {
            const auto& integrated = there.healthy().lane[lane].sensor;
            const bool failed = integrated.empty() ||
                                std::ranges::any_of(healthy[lane], [](const LaneSignals& signals) {
                                    return signals.sensor.empty();
                                });
            if (failed) {
                continue;
            }
            std::vector<double> superposed(integrated.size(), 0.0);
            for (std::size_t l = 0; l < load_weights.size(); ++l) {
                for (std::size_t i = 0; i < superposed.size() && load_weights[l] != 0.0; ++i) {
                    superposed[i] += load_weights[l] * healthy[lane][l].sensor[i];
                }
            }
            errors_[lane].load = std::fmax(
                errors_[lane].load, rms_apart(integrated, superposed, 1.0, integrated, 0.0) /
                                        rms_apart(integrated, integrated, 0.0, integrated, 0.0));
        }
    }

    // Rms of signal - (share_a a + share_b b).
    static double rms_apart(std::span<const double> signal, std::span<const double> a,
                            double share_a, std::span<const double> b, double share_b) {
        double sum = 0.0;
        for (std::size_t i = 0; i < signal.size(); ++i) {
            const double miss = signal[i] - share_a * a[i] - share_b * b[i];
            sum += miss * miss;
        }
        return std::sqrt(sum / static_cast<double>(signal.size()));
    }

    const LifeTiles& tiles_;
    const std::span<const Realization> gearboxes_;
    const HealthySolution& solution_;
    const std::span<InterpolationErrors> errors_;
};

std::vector<bool> LifeTiles::integrated_depths(std::span<const LifeHistory* const> histories,
                                               bool tested) const {
    const CampaignPlan& campaign = plan_.campaign;
    std::vector<bool> depths(static_cast<std::size_t>(campaign.depth_steps) + 1, false);
    for (int step = 0; step < campaign.depth_steps; ++step) {
        const auto lies_in_step = [&](const LifeRecord& record) {
            return record.depth_m > campaign.depth_m(step) &&
                   record.depth_m <= campaign.depth_m(step + 1);
        };
        const bool measured =
            tested && (step == campaign.first_step || step == campaign.depth_steps - 1);
        if (measured || std::ranges::any_of(histories, [&](const LifeHistory* history) {
                return std::ranges::any_of(history->records, lies_in_step);
            })) {
            depths[static_cast<std::size_t>(step)] = true;
            depths[static_cast<std::size_t>(step) + 1] = true;
        }
    }
    return depths;
}

std::vector<GearboxLife> LifeTiles::run(std::span<const Realization> gearboxes, bool cracked,
                                        LifeCosts& costs,
                                        std::span<InterpolationErrors> errors) const {
    std::vector<Lane> lanes;
    double start = thread_processor_s(), check_s = 0.0;
    const auto lap = [&](double& sum) {
        const double now = thread_processor_s();
        sum += now - start;
        start = now;
    };
    for (const Realization& gearbox : gearboxes) {
        lanes.emplace_back(*this, gearbox, cracked);
    }
    std::vector<HealthySolution> solutions;
    for (const Load& load : loads()) {
        solutions.push_back(healthy_solution(gearboxes, load));
    }
    const auto at_depth = [&](double depth_m) {
        SignalsByLoad all(gearboxes.size());
        for (const HealthySolution& solution : solutions) {
            HealthySolution::Signals signals =
                depth_m > 0.0 ? solution.with_fault(depth_m) : solution.healthy();
            for (LaneId lane{0}; lane < gearboxes.size(); ++lane) {
                all[lane].push_back(std::move(signals.lane[lane]));
                if (signals.status[lane] != Status::ok && !lanes[lane].failed()) {
                    lanes[lane].fail(signals.status[lane]);
                }
            }
        }
        return all;
    };
    const SignalsByLoad healthy = at_depth(0.0);
    lap(costs.gearboxes);
    InterpolationCheck check(*this, gearboxes, solutions.front(), errors);
    check.between_loads(healthy);
    lap(check_s);
    std::vector<const LifeHistory*> histories;
    for (const Lane& lane : lanes) {
        histories.push_back(&lane.history());
    }
    const std::vector<bool> depths = integrated_depths(histories, !errors.empty());
    SignalsByLoad low = healthy;
    for (int step = 0; step < (cracked ? plan_.campaign.depth_steps : 1); ++step) {
        SignalsByLoad high = cracked && depths[static_cast<std::size_t>(step) + 1]
                                 ? at_depth(plan_.campaign.depth_m(step + 1))
                                 : SignalsByLoad(gearboxes.size());
        lap(costs.gearboxes);
        if (cracked) {
            check.between_depths(step, healthy, low, high);
            lap(check_s);
        }
        for (LaneId lane{0}; lane < gearboxes.size(); ++lane) {
            if (lanes[lane].failed()) {
                continue;
            }
            if (step == 0) {
                lanes[lane].compute_reference_pattern(healthy[lane]);
            }
            lap(costs.gearboxes);
            lanes[lane].compute_records(plan_.campaign.depth_m(step),
                                        plan_.campaign.depth_m(step + 1), healthy[lane], low[lane],
                                        high[lane]);
            lap(costs.records);
        }
        low = std::move(high);
    }
    std::vector<GearboxLife> lives;
    for (Lane& lane : lanes) {
        lives.push_back(std::move(lane).take());
        costs.record_count += static_cast<long>(lives.back().history.records.size());
    }
    costs.gearbox_count += static_cast<long>(gearboxes.size());
    lap(costs.gearboxes);
    return lives;
}

// Measures the time for computing records, for forecasts.

LaneSignals LifeTiles::synthetic_signals(std::uint64_t number) const {
    const auto samples = [&](int of_mesh, int meshes) {
        return static_cast<std::size_t>(of_mesh) * static_cast<std::size_t>(meshes);
    };
    LaneSignals all;
    Philox engine =
        gearbox_stream(plan_.seed, {Group::test, number}, StreamPurpose::forecast_signals);
    all.sensor.resize(samples(tile_.record.samples, tile_.record.span.meshes()));
    signals::draw_normals(engine, std::span(all.sensor));
    all.te_turn.resize(samples(tile_.record.te_samples, tile_.record.span.planet_teeth));
    signals::draw_normals(engine, std::span(all.te_turn));
    return all;
}

RecordTimes LifeTiles::time_records() const {
    const std::vector<LaneSignals> none, healthy(load_count(), synthetic_signals(0)),
        low(load_count(), synthetic_signals(1)), high(load_count(), synthetic_signals(2));
    Lane lane(*this, draw({Group::test, 0}), false);
    lane.compute_reference_pattern(healthy);
    const auto seconds = [](const auto& work) {
        const double start = thread_processor_s();
        work();
        return thread_processor_s() - start;
    };
    const double first_s = seconds([&] { lane.superpose(lane.basis_of(healthy, none, high)); });
    const double step_s = seconds([&] { lane.superpose(lane.basis_of(healthy, low, high)); });
    const double all_s =
        seconds([&] { lane.compute_records(0.0, plan_.campaign.depth_m(1), healthy, none, high); });
    return {step_s, std::max(0.0, all_s - first_s) / plan_.campaign.records};
}

LifeHistory LifeTiles::history(const GearboxId& id) const {
    return crack_.history(draw(id), true);
}

}  // namespace gearpod::mc
