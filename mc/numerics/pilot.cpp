#include "mc/numerics/pilot.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "lockstep/kernels/kernel_table.hpp"
#include "lockstep/steps/graded_grid.hpp"
#include "machine/clocks.hpp"
#include "mc/ensemble/gearbox/gearbox_tile.hpp"
#include "mc/ensemble/gearbox/realization_features.hpp"
#include "signals/sensor/sensor_signal.hpp"

namespace gearpod::mc {
namespace {

constexpr double kUnbounded = std::numeric_limits<double>::infinity();

// Sums over all gearboxes of the squared differences and of the squared reference.
struct Sums {
    double difference = 0.0, reference = 0.0;
    void add(std::span<const double> a, std::span<const double> b) {
        for (std::size_t i = 0; i < b.size(); ++i) {
            difference += (a[i] - b[i]) * (a[i] - b[i]);
            reference += b[i] * b[i];
        }
    }
    double relative() const {
        return reference > 0.0 ? std::sqrt(difference / reference)
                               : (difference > 0.0 ? kUnbounded : 0.0);
    }
};

// Adds the error of one feature at one noise level over the gearboxes that the reference has.
void add_feature(const PilotRecord& record, const PilotRecord& reference, std::size_t value,
                 PilotError& error) {
    Sums sums;
    double largest = 0.0;
    int compared = 0;
    for (std::size_t g = 0; g < reference.ok.size(); ++g) {
        if (!reference.ok[g] || !std::isfinite(reference.features[g][value])) {
            continue;
        }
        const double here = record.ok[g] ? record.features[g][value] : kUnbounded;
        const double there = reference.features[g][value];
        const double difference = std::isfinite(here) ? std::abs(here - there) : kUnbounded;
        sums.difference += difference * difference;
        sums.reference += there * there;
        largest = std::max(largest, difference);
        ++compared;
    }
    error.relative.push_back(sums.relative());
    error.rms.push_back(std::sqrt(sums.difference / std::max(1, compared)));
    error.largest.push_back(largest);
}

// Repeats the gearboxes until a tile is full, so that with sixteen lanes the time per gearbox is
// that of a run.
std::vector<GearboxId> filled(std::span<const GearboxId> ids, int lanes) {
    std::vector<GearboxId> all;
    for (LaneId lane{0}; lane < lanes; ++lane) {
        all.push_back(ids[lane % ids.size()]);
    }
    return all;
}

}  // namespace

double PilotRecord::meshes_per_tile() const {
    return tile_meshes * lockstep::kPilotLanes /
           static_cast<double>(std::max<std::size_t>(1, ok.size()));
}

double PilotRecord::mesh_s() const {
    return tile_meshes > 0.0 ? integration_s / meshes_per_tile() : 0.0;
}

double PilotError::feature(int f, int levels) const {
    const auto first = relative.begin() + f * levels;
    return *std::max_element(first, first + levels);
}

double PilotError::largest_feature() const {
    return relative.empty() ? 0.0 : *std::max_element(relative.begin(), relative.end());
}

int PilotError::worst_feature(int levels) const {
    const auto worst = std::max_element(relative.begin(), relative.end()) - relative.begin();
    return static_cast<int>(worst) / levels;
}

double PilotError::signals() const {
    return std::max(sensor, te);
}

std::vector<GearboxId> pilot_gearboxes(std::uint64_t first, std::uint64_t stride) {
    std::vector<GearboxId> ids;
    for (int i = 0; i < lockstep::kPilotLanes; ++i) {
        ids.push_back({Group::test, first + static_cast<std::uint64_t>(i) * stride});
    }
    return ids;
}

Pilot::Pilot(Planner planner, std::vector<GearboxId> ids)
    : planner_(std::move(planner)), ids_(std::move(ids)) {
    constexpr int kMostSignalMeshes = 200;
    const TilePlan plan = planner_.tile(without_tolerance(planner_.facts().numerics));
    signal_meshes_ = std::clamp(plan.gearbox->fault().pattern().length, 1, kMostSignalMeshes);
}

PilotRecord Pilot::run(const Numerics& numerics) const {
    const TilePlan plan = planner_.tile(numerics);
    const int lanes = lockstep::lanes_for(numerics.precision, full_lanes(numerics.precision));
    return record(plan, lanes, [&](std::span<const GearboxId> some) {
        return run_gearboxes(plan, filled(some, lanes), lanes,
                             {.records = lockstep::RecordOptions{}});
    });
}

PilotRecord Pilot::record_of_integration(const ForeignIntegrator& integrate) const {
    const TilePlan plan = planner_.tile(planner_.facts().numerics);
    return record(plan, lockstep::kPilotLanes, [&](std::span<const GearboxId> some) {
        return complete_tile(plan, some, integrate(some));
    });
}

PilotRecord Pilot::record(const TilePlan& plan, int lanes, const Tile& tile_of) const {
    PilotRecord record;
    record.features_used = static_cast<int>(planner_.facts().features.size());
    record.levels = static_cast<int>(planner_.facts().noise_levels.size());
    record.steps = static_cast<int>(plan.solve->integration().grid.steps.size());
    const HealthyReference healthy = healthy_reference(plan);
    RealizationFeatures features(plan, &healthy);
    double tiles_s = 0.0, features_s = 0.0, lanes_run = 0.0;
    for (std::size_t first = 0; first < ids_.size(); first += lockstep::kPilotLanes) {
        const auto some = std::span(ids_).subspan(
            first, std::min<std::size_t>(lockstep::kPilotLanes, ids_.size() - first));
        const double start = thread_processor_s();
        const GearboxTile tile = tile_of(some);
        tiles_s += thread_processor_s() - start;
        lanes_run += lanes;
        record.tile_meshes += tile.integration.integrated_meshes;
        record.integration_s += tile.integration_cpu_s;
        for (std::size_t g = 0; g < some.size(); ++g) {
            const LaneId lane{g};
            const Realization& realization = tile.realizations[g];
            const bool ok = tile.status[g] == Status::ok;
            record.ok.push_back(ok);
            record.sensor.emplace_back();
            record.te.emplace_back();
            record.features.emplace_back();
            if (!ok) {
                continue;
            }
            const double features_start = thread_processor_s();
            record.features.back() =
                features.compute(lane_signals(plan, tile, lane, features.meshes()), realization);
            features_s += thread_processor_s() - features_start;
            const lockstep::SpanPart part =
                tile.parts.empty() ? lockstep::SpanPart{0, signal_meshes_} : tile.parts.front();
            const int count = std::min(signal_meshes_, part.end - part.first);
            record.sensor.back() =
                signals::synthesize(tile.views, lane, tile.integration.content, plan.record.span,
                                    plan.sensors->front().paths.front(),
                                    realization.inputs.path_exponent, part.first, count);
            record.te.back() =
                recorded_te(plan.record, tile, lane, part.first, count, plan.record.samples);
            remove_mean(record.te.back());
        }
    }
    record.integration_s /= lanes_run;
    record.total_s = tiles_s / lanes_run + features_s / static_cast<double>(ids_.size());
    return record;
}

PilotError pilot_error(const PilotRecord& record, const PilotRecord& reference) {
    PilotError error;
    Sums sensor, te;
    for (std::size_t g = 0; g < reference.ok.size(); ++g) {
        if (!reference.ok[g]) {
            continue;
        }
        if (!record.ok[g]) {
            sensor.difference = te.difference = kUnbounded;
            continue;
        }
        sensor.add(record.sensor[g], reference.sensor[g]);
        te.add(record.te[g], reference.te[g]);
    }
    error.sensor = sensor.relative();
    error.te = te.relative();
    const std::size_t values = static_cast<std::size_t>(reference.features_used) *
                               static_cast<std::size_t>(reference.levels);
    for (std::size_t value = 0; value < values; ++value) {
        add_feature(record, reference, value, error);
    }
    return error;
}

}  // namespace gearpod::mc
