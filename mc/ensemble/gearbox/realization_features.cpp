#include "mc/ensemble/gearbox/realization_features.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <mutex>
#include <nlohmann/json.hpp>
#include <numbers>
#include <numeric>
#include <set>
#include <utility>

#include "machine/no_value.hpp"
#include "machine/team.hpp"
#include "mc/files/input/terminal_text.hpp"
#include "mc/files/python/python_worker.hpp"
#include "mc/study/gears.hpp"

namespace gearpod::mc {

struct PythonFeatures::Request {
    std::vector<double> levels;
    nlohmann::json records = nlohmann::json::array();
};

namespace {

// Properties of a record that are the same at every noise level.
nlohmann::json properties(const RecordPlan& record, const FeaturePlan& features,
                          const InstanceInputs& inputs) {
    nlohmann::json teeth = nlohmann::json::object();
    for (const Member member : kAllMembers) {
        if (const int count = features.teeth[member]; count > 0) {
            teeth[std::string(member_name(member))] = count;
        }
    }
    const double mesh_Hz = 1.0 / record.mesh_period_s(inputs);
    return {{"gear_teeth", record.span.planet_teeth},
            {"teeth", teeth},
            {"planets", features.planets},
            {"samples_per_mesh", record.samples},
            {"te_samples_per_mesh", record.te_samples},
            {"carrier_meshes", record.path_meshes()},
            {"mesh_Hz", mesh_Hz},
            {"sampling_Hz", mesh_Hz * record.samples},
            {"torque_Nm", inputs.torque_N_m},
            {"speed_rpm", inputs.speed_rad_s * 30.0 / std::numbers::pi},
            {"noise_m_s2", inputs.noise_m_s2}};
}

double variance(std::span<const double> values) {
    const auto count = static_cast<double>(values.size());
    const double sum = std::accumulate(values.begin(), values.end(), 0.0);
    double squares = 0.0;
    for (const double value : values) {
        squares += (value - sum / count) * (value - sum / count);
    }
    return squares / count;
}

HealthyReference reference_of(const TilePlan& plan, const SensorPlan& sensor) {
    const int lanes = plan.solve->settings.numerics.lanes;
    RealizationSignals records(plan.record, plan.features, sensor,
                               features::SignalSet::of<features::SensorTurn>());
    const std::size_t levels = plan.record.noise_levels.size();
    HealthyRecordsMean mean(levels);
    for (int first = 0; first < HealthyReference::kRecords; first += lanes) {
        std::vector<GearboxId> ids;
        for (int i = first; i < std::min(first + lanes, HealthyReference::kRecords); ++i) {
            ids.push_back({Group::threshold, static_cast<std::uint64_t>(i)});
        }
        const GearboxTile tile =
            run_gearboxes(plan, ids, lanes, {.signal_meshes = records.meshes()});
        auto signals = all_lane_signals(plan, tile, records.meshes());
        for (LaneId lane{0}; lane < ids.size(); ++lane) {
            machine::throw_if_cancelled();
            if (tile.status[lane] == Status::ok) {
                const Realization realization = sensor.realization(tile.realizations[lane]);
                if (sensor.number > 0) {
                    signals[lane] = signals_of_sensor(sensor, signals[lane]).record;
                }
                const LaneSignals record =
                    drawn_record(plan.record, std::move(signals[lane]), realization);
                records.load(record, realization);
                for (std::size_t level = 0; level < levels; ++level) {
                    mean.add(level, records.at(level));
                }
            }
        }
    }
    return mean.mean();
}

const LaneSignals& baseline_of(const LaneSignals& gearbox, std::size_t k) {
    return gearbox.baseline[std::min(k, gearbox.baselines - 1)];
}

}  // namespace

PythonFeatures::PythonFeatures(const RecordPlan& record, const FeaturePlan& features,
                               std::span<const features::Feature* const> computed)
    : record_(record), features_(features) {
    for (const features::Feature* feature : computed) {
        for (const PythonFeature& function : features.python) {
            if (function.feature == feature) {
                used_.push_back(function);
                // starts Python early
                PythonWorker::of_thread().require(function.file, function.hashes);
            }
        }
    }
}

void PythonFeatures::add_record(const char* kind, const InstanceInputs& inputs,
                                const features::FeatureInput& input) {
    nlohmann::json arrays = nlohmann::json::array();
    const auto add_signal = [&](const char* name, std::span<const double> signal) {
        if (!signal.empty()) {
            arrays.push_back({name, signal.size()});
            values_.insert(values_.end(), signal.begin(), signal.end());
        }
    };
    add_signal("sensor", input.get<features::SensorSamples>().samples);
    add_signal("te", input.get<features::TeTurn>().turn);
    add_signal("tooth_rms", input.get<features::ToothRms<Member::planet>>().rms);
    if (request_->levels.size() == 1) {
        request_->records.push_back(
            {kind, properties(record_, features_, inputs), std::move(arrays)});
    }
}

void PythonFeatures::add(double noise_level, const InstanceInputs& inputs,
                         const features::FeatureInput& input) {
    if (!request_) {
        request_ = std::make_shared<Request>();
        values_.clear();
    }
    request_->levels.push_back(noise_level);
    add_record("record", inputs, input);
    for (int k = 0; input.baseline != nullptr && k < input.baselines; ++k) {
        add_record("baselines", inputs, input.baseline[k]);
    }
    if (input.change != nullptr) {
        add_record("change", inputs, *input.change);
    }
}

std::vector<double> PythonFeatures::compute(const std::string& work) {
    const auto request = std::exchange(request_, nullptr);
    PythonWorker& worker = PythonWorker::of_thread();
    nlohmann::json functions = nlohmann::json::array();
    for (const PythonFeature& function : used_) {
        worker.require(function.file, function.hashes);
        functions.push_back({function.file, std::string(function.feature->name)});
    }
    nlohmann::json reply;
    std::vector<double> values = worker.ask(
        {{"features", functions}, {"levels", request->levels}, {"records", request->records}},
        values_, work, reply);
    problems_.clear();
    for (const auto& error : reply.at("errors")) {
        problems_.push_back({error.at(0), error.at(1), error.at(2), error.at(3)});
    }
    values.resize(used_.size() * request->levels.size(), kNan);
    return values;
}

void print_python_problems(const std::vector<PythonProblem>& problems, const std::string& work) {
    static std::mutex mutex;
    static std::set<std::string> printed;
    const std::lock_guard lock(mutex);
    for (const PythonProblem& problem : problems) {
        if (printed.insert(problem.line + problem.feature).second) {
            fmt::print(stderr,
                       "{}: {} ({}, {}, noise x {:g}): it has no value there; further cases at "
                       "this line are only counted\n",
                       problem.line, printable(problem.what), problem.feature, work,
                       problem.noise_level);
        }
    }
}

HealthyRecordsMean::HealthyRecordsMean(std::size_t levels) : records_(levels, 0) {
    sum_.residual_variance.resize(levels, 0.0);
}

void HealthyRecordsMean::add(std::size_t level, const features::FeatureInput& input) {
    const auto& sensor = input.get<features::SensorTurn>();
    ++records_[level];
    sum_.residual_variance[level] += variance(sensor.residual);
}

HealthyReference HealthyRecordsMean::mean() const {
    HealthyReference mean = sum_;
    for (std::size_t level = 0; level < records_.size(); ++level) {
        mean.residual_variance[level] /= records_[level];
    }
    return mean;
}

HealthyReference healthy_reference(const TilePlan& plan, std::uint64_t sensor) {
    if (!plan.features.needs.all().has<features::HealthyRecords>()) {
        return {};
    }
    return reference_of(plan, (*plan.sensors)[sensor]);
}

HealthyReference simulated_reference(const TilePlan& plan) {
    return reference_of(plan, plan.sensors->front());
}

RealizationFeatures::RealizationFeatures(const TilePlan& plan, const HealthyReference* healthy,
                                         bool python, std::uint64_t sensor)
    : RealizationSignals(plan.record, plan.features, (*plan.sensors)[sensor],
                         plan.features.needs.record),
      plan_(plan.record),
      rows_(plan.draw().rows),
      features_(plan.features.used),
      python_(plan.record, plan.features,
              python ? features_ : std::vector<const features::Feature*>()),
      healthy_(healthy),
      levels_(plan.record.noise_levels.size()) {
    const ComparedNeeds& needs = plan.features.needs;
    const auto signals_with = [&](features::SignalSet with_needs) {
        return RealizationSignals(plan.record, plan.features, (*plan.sensors)[sensor], with_needs);
    };
    for (int k = 0; k < plan.features.baselines; ++k) {
        baselines_.push_back({signals_with(needs.baseline), {}, {}});
    }
    if (!needs.change.empty()) {
        change_ = std::make_unique<RealizationSignals>(signals_with(needs.change));
    }
}

void RealizationFeatures::load(const LaneSignals& gearbox, const Realization& realization) {
    RecordWindow window;
    if (plan_.length) {
        window = record_window(plan_, realization.id, plan_.turns(realization.inputs));
        record_ = cut_record(plan_, gearbox, window, keeps_samples());
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
            cut_record(plan_, signals, record_window(plan_, earlier.id, window.turns), samples);
        baseline.signals.load(baseline.cut, earlier);
        if (change_) {
            baseline.aligned = cut_record(plan_, signals, window, samples);
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
    changed_ = change_since_baseline(plan_, record(), before);
    change_->load(changed_, realization.inputs, noise_of_change(plan_, changed_, noise(), noises));
}

std::vector<double> RealizationFeatures::compute(const LaneSignals& gearbox,
                                                 const Realization& realization,
                                                 std::vector<LevelSignals>* signals) {
    std::vector<double> values(features_.size() * levels_, kNan);
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
        if (!healthy_->residual_variance.empty()) {
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
                {from_first_tooth(input.get<features::TeTurn>().turn, plan_.te_samples),
                 from_first_tooth(input.get<features::ToothRms<Member::planet>>().rms, 1)});
        }
        for (std::size_t f = 0; f < features_.size(); ++f) {
            if (!features_[f]->external) {
                values[f * levels_ + level] = features_[f]->value(input);
            }
        }
        if (!python_.empty()) {
            python_.add(plan_.noise_levels[level], realization.inputs, input);
        }
    }
    if (!python_.empty()) {
        add_python_values(realization, values);
    }
    for (double& value : values) {
        value = std::isfinite(value) ? value : kNan;
    }
    return values;
}

void RealizationFeatures::add_python_values(const Realization& realization,
                                            std::vector<double>& values) {
    const GearboxId& id = realization.id;
    const std::string work =
        fmt::format("{} gearbox {}, row {} of the results",
                    id.group == Group::threshold ? "healthy" : "test", id.index, rows_.row_of(id));
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
