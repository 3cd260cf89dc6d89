#include "mc/ensemble/gearbox/other_sources.hpp"

#include <algorithm>
#include <boost/random/uniform_01.hpp>
#include <cmath>
#include <functional>
#include <iterator>
#include <memory>
#include <numbers>
#include <string>

#include "machine/no_value.hpp"
#include "machine/team.hpp"
#include "mc/ensemble/coupling/neighbour_stages.hpp"
#include "mc/ensemble/gearbox/record_window.hpp"
#include "signals/spectra/resampling.hpp"

namespace gearpod::mc {
namespace {

using Bearings = std::vector<OtherSourcesStage::NumberedBearing>;

void add_bearings(const GearboxPlan& gearbox, const RecordPlan& plan, const Bearings& bearings,
                  double low_pass_Hz, const Realization& realization,
                  std::vector<double>& samples) {
    for (const auto& [number, bearing] : bearings) {
        machine::throw_if_cancelled();
        Philox engine =
            record_stream(plan.seed, realization.id,
                          with_suffix(StreamPurpose::bearing_impulses, std::to_string(number)));
        signals::add_bearing_vibration(bearing_impulses(gearbox, realization.inputs, bearing),
                                       low_pass_Hz, plan.sample_s(realization.inputs), engine,
                                       samples);
    }
}

// Interpolation of periods of that many samples. A thread keeps the one used last, because most
// stages have one length.
signals::PeriodicInterpolation& interpolation_of(std::size_t samples) {
    thread_local std::unique_ptr<signals::PeriodicInterpolation> last;
    if (!last || last->samples() != static_cast<int>(samples)) {
        last = std::make_unique<signals::PeriodicInterpolation>(static_cast<int>(samples));
    }
    return *last;
}

// Adds `factor` times a vibration to samples, the first of which lies at position `start` among its
// samples and the others each `step` further.
void add_vibration(const std::vector<double>& vibration, double factor, double start, double step,
                   std::vector<double>& samples) {
    const signals::PeriodicSpline signal = interpolation_of(vibration.size()).spline(vibration);
    for (std::size_t i = 0; i < samples.size(); ++i) {
        samples[i] += factor * signal(start + step * static_cast<double>(i));
    }
}

void add_coupled_stages(const RecordPlan& plan, std::span<const StagePlan> stages,
                        const CoupledSpan& span, const LaneSignals& record,
                        std::vector<double>& samples) {
    for (std::size_t i = 0; i < record.coupled.size(); ++i) {
        const StageSpan& stage = span.stages[i];
        std::vector<double> vibration = record.coupled[i];
        if (!std::ranges::all_of(vibration, [](double value) { return std::isfinite(value); })) {
            std::ranges::fill(samples, kNan);
            return;  // a gearbox of the train has failed
        }
        const int per_mesh = static_cast<int>(vibration.size()) / stage.meshes;
        // Both ends lie outside of the record. They fade out, so that the vibration can be
        // continued periodically.
        const auto fade = static_cast<std::size_t>(per_mesh);
        for (std::size_t k = 0; k < fade; ++k) {
            const double weight = 0.5 - 0.5 * std::cos(std::numbers::pi * static_cast<double>(k) /
                                                       static_cast<double>(fade));
            vibration[k] *= weight;
            vibration[vibration.size() - 1 - k] *= weight;
        }
        add_vibration(vibration, stages[stage.stage].gain, -stage.start / stage.period * per_mesh,
                      per_mesh / stage.period / plan.samples, samples);
    }
}

// Adds to samples of records what the fault of a coupled stage changes in them: vibration of that
// stage, and of the study's gearbox to which the shaft carries it. NaN if a gearbox fails.
void add_coupled_fault(const TilePlan& plan, std::size_t stage,
                       std::span<const Realization> realizations,
                       std::span<const LaneSignals> records,
                       std::vector<std::vector<double>>& samples) {
    const GearboxTile tile =
        run_realizations(plan, {realizations.begin(), realizations.end()},
                         plan.solve->settings.numerics.lanes, {.faulty_stage = stage});
    const std::vector<LaneSignals> faulty = all_lane_signals(plan, tile, plan.record.signal_meshes);
    for (std::size_t r = 0; r < samples.size(); ++r) {
        for (std::size_t i = 0; i < samples[r].size(); ++i) {
            samples[r][i] +=
                tile.status[r] == Status::ok ? faulty[r].sensor[i] - records[r].sensor[i] : kNan;
        }
    }
}

// Gearbox of a stage next to that of a record, and the record's samples to which `factor` times its
// vibration is added.
struct StageRecord {
    const Realization* record;
    Realization gearbox;
    double factor;
    std::vector<double>* samples;
};

// Adds the steady vibration of the gearboxes of a stage, each from a random position on. `record`:
// plan of the records to which it is added. Samples become NaN if the stage's gearbox fails.
void add_stage(const RecordPlan& record, const StagePlan& stage,
               std::span<const StageRecord> records) {
    const TilePlan& plan = *stage.tile;
    const auto lanes = static_cast<std::size_t>(plan.solve->settings.numerics.lanes);
    for (std::size_t first = 0; first < records.size(); first += lanes) {
        const auto part = records.subspan(first, std::min(lanes, records.size() - first));
        std::vector<Realization> gearboxes;
        std::ranges::transform(part, std::back_inserter(gearboxes), &StageRecord::gearbox);
        const GearboxTile tile =
            run_realizations(plan, gearboxes, static_cast<int>(part.size() > 1 ? lanes : 1));
        const std::vector<LaneSignals> signals =
            all_lane_signals(plan, tile, plan.record.span.meshes());
        for (std::size_t i = 0; i < part.size(); ++i) {
            machine::throw_if_cancelled();
            if (tile.status[i] != Status::ok) {
                std::ranges::fill(*part[i].samples, kNan);
                continue;
            }
            const std::vector<double>& vibration = signals[i].sensor;
            Philox engine = record_stream(record.seed, part[i].record->id,
                                          with_suffix(StreamPurpose::stage_start, stage.name));
            const double start =
                boost::random::uniform_01<double>()(engine) * static_cast<double>(vibration.size());
            const double step = record.sample_s(part[i].record->inputs) /
                                plan.record.sample_s(part[i].gearbox.inputs);
            add_vibration(vibration, part[i].factor, start, step, *part[i].samples);
        }
    }
}

}  // namespace

std::vector<std::vector<double>> background_vibration(const TilePlan& plan,
                                                      std::span<const Realization> realizations,
                                                      std::span<const LaneSignals> records,
                                                      int meshes) {
    const std::vector<StagePlan>& stages = plan.gearbox->stages;
    const auto* sources = plan.sensors->front().find<OtherSourcesStage>();
    std::vector<std::vector<double>> samples;
    if (sources == nullptr || (stages.empty() && sources->background.empty())) {
        return samples;
    }
    // Records of a coupled tile share it.
    CoupledSpan span;
    if (const auto* coupled = std::get_if<CoupledStages>(&plan.solve->strategy)) {
        span = coupled_span(plan.draw(), *plan.gearbox, plan.record, *coupled,
                            realizations.front().id);
    }
    for (std::size_t i = 0; i < records.size(); ++i) {
        samples.emplace_back(
            static_cast<std::size_t>(meshes) * static_cast<std::size_t>(plan.record.samples), 0.0);
        add_bearings(*plan.gearbox, plan.record, sources->background, sources->low_pass_Hz,
                     realizations[i], samples[i]);
        add_coupled_stages(plan.record, stages, span, records[i], samples[i]);
    }
    for (std::size_t stage = 0; stage < stages.size(); ++stage) {
        if (stages[stage].shaft) {
            continue;
        }
        std::vector<StageRecord> next;
        for (std::size_t i = 0; i < records.size(); ++i) {
            next.push_back({&realizations[i],
                            stage_gearbox(*plan.gearbox, stages[stage], realizations[i]),
                            stages[stage].gain, &samples[i]});
        }
        add_stage(plan.record, stages[stage], next);
    }
    return samples;
}

std::vector<LaneSignals> with_other_fault(const TilePlan& plan,
                                          std::span<const Realization> realizations,
                                          std::span<const LaneSignals> records) {
    const auto* sources = plan.sensors->front().find<OtherSourcesStage>();
    const std::vector<StagePlan>& stages = plan.gearbox->stages;
    if (sources == nullptr ||
        (sources->other_fault.empty() &&
         std::ranges::count(stages, SourceRole::other_fault, &StagePlan::role) == 0)) {
        return {};
    }
    std::vector<LaneSignals> other(records.begin(), records.end());
    if (records.front().sensor.empty()) {
        return other;
    }
    std::vector<std::vector<double>> samples;
    for (std::size_t i = 0; i < records.size(); ++i) {
        samples.emplace_back(records[i].sensor.size(), 0.0);
        add_bearings(*plan.gearbox, plan.record, sources->other_fault, sources->low_pass_Hz,
                     realizations[i], samples[i]);
    }
    for (std::size_t stage = 0; stage < stages.size(); ++stage) {
        if (stages[stage].role != SourceRole::other_fault) {
            continue;
        }
        if (stages[stage].shaft) {
            add_coupled_fault(plan, stage, realizations, records, samples);
            continue;
        }
        std::vector<StageRecord> next;  // the faulty stage in place of the healthy one
        for (std::size_t i = 0; i < records.size(); ++i) {
            const double gain = stages[stage].gain;
            next.push_back({&realizations[i],
                            stage_gearbox(*plan.gearbox, stages[stage], realizations[i], true),
                            gain, &samples[i]});
            next.push_back({&realizations[i],
                            stage_gearbox(*plan.gearbox, stages[stage], realizations[i]), -gain,
                            &samples[i]});
        }
        add_stage(plan.record, stages[stage], next);
    }
    for (std::size_t i = 0; i < records.size(); ++i) {
        std::vector<double>& sensor = other[i].sensor;
        std::ranges::transform(sensor, samples[i], sensor.begin(), std::plus<>());
        fold_again(plan.record, other[i]);
    }
    return other;
}

}  // namespace gearpod::mc
