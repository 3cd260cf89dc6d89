#include "mc/numerics/pilot.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <span>

#include "lockstep/integrators/facts.hpp"
#include "lockstep/kernels/kernel_table.hpp"
#include "lockstep/steps/graded_grid.hpp"
#include "machine/clocks.hpp"
#include "mc/ensemble/gearbox/gearbox_tile.hpp"
#include "mc/ensemble/gearbox/realization_features.hpp"
#include "mc/numerics/solver_setting.hpp"
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

namespace {

// Richardson extrapolation: removes the leading error term from `fine`. The steps of `coarse` are
// twice as long.
void extrapolate(const PilotRecord& coarse, double order, PilotRecord& fine) {
    const double weight = 1.0 / (std::exp2(order) - 1.0);
    const auto improve = [weight](const std::vector<double>& from, std::vector<double>& to) {
        for (std::size_t i = 0; i < std::min(from.size(), to.size()); ++i) {
            to[i] += weight * (to[i] - from[i]);
        }
    };
    for (std::size_t g = 0; g < fine.ok.size(); ++g) {
        improve(coarse.sensor[g], fine.sensor[g]);
        improve(coarse.te[g], fine.te[g]);
        improve(coarse.features[g], fine.features[g]);
    }
}

// Successive refinement: one method with its steps halved repeatedly.
class Refinement {
  public:
    Refinement(const Pilot& pilot, const Numerics& numerics,
               std::optional<lockstep::Integrator> integrator, const ReferenceRequest& request)
        : pilot_(pilot), setting_(own_setting(numerics)), request_(request) {
        setting_.numerics.integrator = integrator;
        setting_.numerics.steps_per_mesh = 0;
        setting_.numerics.convergence_tolerance = request.convergence_tolerance;
        try {
            setting_.numerics.steps_per_mesh = steps_of(pilot.planner(), setting_).steps;
        } catch (const SceneError&) {  // the study is too stiff for this explicit method
            stopped_ = true;
        }
    }

    bool stopped() const { return stopped_; }
    bool has_result() const { return best_.has_value(); }
    const PilotRecord& finest() const { return *last_; }  // as integrated
    const PilotRecord& best() const { return *best_; }    // extrapolated
    const SolverSetting& setting() const { return done_; }
    const SolverSetting& next_setting() const { return setting_; }
    // Change of the result at the last halving.
    double last_change() const { return change_; }
    // Cost of the next integration, in rk4 steps per mesh period. cost_s(): processor time of one
    // such step in the last one.
    double next_cost() const {
        return step_cost(pilot_.planner().facts(), setting_).value_or(1.0) *
               setting_.numerics.steps_per_mesh;
    }
    double cost_s() const { return has_result() ? last_s_ / (0.5 * next_cost()) : 0.0; }
    void stop() { stopped_ = true; }

    // Expected cost, in rk4 steps, of the refinement at which halving the steps changes the result
    // by the requested agreement; infinite before the first halving.
    double expected_cost() const {
        const auto step = step_cost(pilot_.planner().facts(), setting_);
        if (!step || !has_result() || !(change_ > 0.0)) {
            return INFINITY;
        }
        const double order = order_ > 0.0 ? order_ : 2.0;
        return *step * last_->steps * last_->tile_meshes *
               std::pow(std::max(1.0, change_ / request_.agreement), 1.0 / order);
    }

    void integrate() {
        const double start_s = thread_processor_s();
        PilotRecord record = pilot_.run(setting_.numerics);
        last_s_ = thread_processor_s() - start_s;
        done_ = setting_;
        best_ = record;
        order_ = 0.0;
        if (last_) {
            const double change = pilot_error(*last_, record).sensor;
            const double order = std::log2(change_ / change);
            // The leading error can be removed if halving the steps shows the method's order.
            if (change_ > 0.0 && order > 1.5 && order < 6.5) {
                order_ = std::round(order);
                extrapolate(*last_, order_, *best_);
            }
            change_ = change;
        }
        const double next = 2.0 * record.steps * record.tile_meshes;
        last_ = std::move(record);
        refine(next);
    }

  private:
    void refine(double tile_steps) {
        setting_.numerics.steps_per_mesh *= 2;
        try {
            if (tile_steps > request_.most_tile_steps) {
                stopped_ = true;
            } else {
                steps_of(pilot_.planner(), setting_);
            }
        } catch (const SceneError&) {
            stopped_ = true;
        }
    }

    const Pilot& pilot_;
    SolverSetting setting_, done_;
    const ReferenceRequest request_;
    bool stopped_ = false;
    std::optional<PilotRecord> last_, best_;
    double change_ = 0.0, order_ = 0.0, last_s_ = 0.0;
};

bool two_have_results(const std::vector<Refinement>& methods) {
    return std::count_if(methods.begin(), methods.end(),
                         [](const Refinement& m) { return m.has_result(); }) >= 2;
}

// Stops all but the two methods that are expected to agree at the lowest cost, once every remaining
// method has halved its steps.
void keep_two_best(std::vector<Refinement>& methods) {
    std::vector<double> costs;
    for (const Refinement& method : methods) {
        if (!method.stopped()) {
            costs.push_back(method.expected_cost());
        }
    }
    if (costs.size() <= 2) {
        return;
    }
    std::nth_element(costs.begin(), costs.begin() + 1, costs.end());
    if (!std::isfinite(costs[1])) {
        return;
    }
    for (Refinement& method : methods) {
        if (!method.stopped() && method.expected_cost() > costs[1]) {
            method.stop();
        }
    }
}

// True if both computed the same gearboxes, and at least one.
bool comparable(const PilotRecord& a, const PilotRecord& b) {
    return a.ok == b.ok && std::find(a.ok.begin(), a.ok.end(), true) != a.ok.end();
}

// Chooses the pair of methods that agrees best, first the one with the smaller last change.
void choose_pair(const std::vector<Refinement>& methods, const ReferenceRequest& request,
                 double& least, Reference& reference) {
    for (std::size_t i = 0; i < methods.size(); ++i) {
        for (std::size_t j = 0; j < i; ++j) {
            if (!methods[i].has_result() || !methods[j].has_result() ||
                !comparable(methods[i].best(), methods[j].best())) {
                continue;
            }
            const bool swap = methods[i].last_change() < methods[j].last_change();
            const Refinement& a = methods[swap ? i : j];
            const Refinement& b = methods[swap ? j : i];
            const PilotError error = pilot_error(b.best(), a.best());
            const double apart = error.signals();
            if (apart < least) {
                least = apart;
                reference = {a.best(), a.setting(), b.setting(), error, apart <= request.agreement};
            }
        }
    }
}

}  // namespace

Reference self_converged_reference(const Pilot& pilot, const Numerics& numerics,
                                   const ReferenceRequest& request) {
    // Method that the study would use without a tolerance: explicit unless the study is too stiff.
    Refinement method(pilot, numerics, numerics.integrator, request);
    if (method.stopped()) {
        steps_of(pilot.planner(), method.next_setting());  // throws the reason
    }
    Reference reference;
    while (!reference.reached && !method.stopped()) {
        const bool first = !method.has_result();
        PilotRecord before = first ? PilotRecord{} : method.finest();
        method.integrate();
        if (!first) {
            reference.agreement = pilot_error(before, method.finest());
            reference.reached = reference.agreement.largest_feature() <= request.agreement;
        }
        reference.record = method.best();
        reference.first = method.setting();
    }
    return reference;
}

Reference converged_reference(const Pilot& pilot, const Numerics& numerics,
                              const ReferenceRequest& request) {
    std::vector<Refinement> methods;
    for (const lockstep::Integrator integrator : lockstep::all_integrators()) {
        methods.emplace_back(pilot, numerics, integrator, request);
    }
    Reference reference;
    double least = INFINITY;
    const double end_s = thread_processor_s() + request.seconds;
    double cost_s = 0.0;
    const auto any_running = [&] {
        return std::any_of(methods.begin(), methods.end(),
                           [](const Refinement& m) { return !m.stopped(); });
    };
    while (!reference.reached && any_running()) {
        for (Refinement& method : methods) {
            if (thread_processor_s() + cost_s * method.next_cost() > end_s &&
                (method.has_result() || two_have_results(methods))) {
                method.stop();
            }
            if (!method.stopped()) {
                method.integrate();
                cost_s = std::max(cost_s, method.cost_s());
            }
        }
        choose_pair(methods, request, least, reference);
        keep_two_best(methods);
    }
    if (!std::isfinite(least)) {
        throw SceneError(
            "numerics.integrator",
            "no two integrators can integrate this study, so no solution can be verified", "");
    }
    return reference;
}

}  // namespace gearpod::mc
