#include "mc/ensemble/gearbox/simulation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <span>
#include <stdexcept>

#include "lockstep/excitation/excitation_rows.hpp"
#include "lockstep/kernels/kernel_table.hpp"
#include "mc/ensemble/gearbox/other_sources.hpp"
#include "mc/ensemble/gearbox/realization_features.hpp"
#include "mc/ensemble/gearbox/tile_random_inputs.hpp"
#include "mc/results/layout.hpp"

namespace gearpod::mc {
namespace {

using Column = SignalColumn;

// Mesh periods of the signals that are written.
struct MeshRange {
    long first = 0, count = 0;
};

// Values of the first lane over these mesh periods, repeating the recorded ones. value(record,
// sample) reads one value.
template <typename Value>
std::vector<double> unroll(const GearboxTile& tile, int samples, MeshRange meshes, Value value) {
    std::vector<double> all;
    for (long k = meshes.first; k < meshes.first + meshes.count; ++k) {
        const auto& content = tile.integration.content;
        const int id = content[static_cast<std::size_t>(k) % content.size()];
        for (int p = 0; p < samples; ++p) {
            all.push_back(value(tile.integration.records[static_cast<std::size_t>(id)],
                                static_cast<std::size_t>(p)));
        }
    }
    return all;
}

void add_motion(const lockstep::IntegrationPlan& plan, const Drivetrain& drivetrain,
                const GearboxTile& tile, MeshRange meshes, Simulation& out) {
    const auto names = dynamics::motion_names(plan.layout);
    const int samples = plan.grid.samples;
    const std::size_t lanes = tile.realizations.size();
    out.columns.push_back({"te", "rad", unroll(tile, samples, meshes, [&](const auto& r, auto p) {
                               return r.te[p * lanes];
                           })});
    for (std::size_t d = 0; d < names.size(); ++d) {
        out.columns.push_back(
            {names[d], "m", unroll(tile, samples, meshes, [&](const auto& r, auto p) {
                 return r.motion[(p * names.size() + d) * lanes];
             })});
    }
    const auto pairs = static_cast<std::size_t>(plan.nodes.pairs);
    for (PairId pair{0}; pair < pairs; ++pair) {
        out.columns.push_back({drivetrain.pair_name(pair) + "_force", "N",
                               unroll(tile, samples, meshes, [&](const auto& r, auto p) {
                                   return r.mesh_force[(p * pairs + pair) * lanes];
                               })});
    }
}

// Adds the samples of a record without and with noise. `signals` are those of the whole signal.
void add_sensor(const RecordPlan& plan, const SensorPlan& sensor, const Realization& realization,
                LaneSignals signals, const RealizationFeatures& features, const std::string& name,
                std::size_t rows, Simulation& out) {
    const LaneSignals record = drawn_record(plan, std::move(signals), realization);
    const std::vector<double>& clean = record.sensor;
    const auto noise =
        sample_noise(plan, sensor.noise(), realization, clean, features.noise().sensor,
                     record.turns > 0 ? record.turns : plan.span.ring_teeth);
    const auto add_column = [&](std::string column, std::vector<double> samples) {
        if (const auto* range = sensor.find<RangeStage>()) {
            range->clip(samples);
        }
        samples.resize(rows);
        out.columns.push_back({std::move(column), "m/s^2", std::move(samples)});
    };
    add_column(name, clean);
    for (const double level : out.noise_levels) {
        std::vector<double> noisy = clean;
        add_noise(noise, level * realization.inputs.noise_m_s2, noisy);
        add_column(fmt::format("{}_noise_{:g}", name, level), std::move(noisy));
    }
}

// Adds the samples of all sensors. `features` are those of the first one.
void add_sensors(const TilePlan& plan, const GearboxTile& tile, const RealizationFeatures& features,
                 std::size_t rows, Simulation& out) {
    const Realization& realization = tile.realizations[0];
    const LaneSignals all = lane_signals(plan, tile, LaneId{0}, plan.record.signal_meshes);
    add_sensor(plan.record, plan.sensors->front(), realization, all, features, "sensor", rows, out);
    for (LaneSignals& other :
         with_other_fault(plan, std::span(&realization, 1), std::span(&all, 1))) {
        std::ranges::transform(other.sensor, all.sensor, other.sensor.begin(), std::minus<>());
        std::vector<double> samples =
            drawn_record(plan.record, std::move(other), realization).sensor;
        samples.resize(rows);
        out.columns.push_back({kOtherFault, "m/s^2", std::move(samples)});
    }
    for (const SensorPlan& sensor : std::span(*plan.sensors).subspan(1)) {
        const HealthyReference healthy = healthy_reference(plan, sensor.number);
        RealizationFeatures sensor_features(plan, &healthy, false, sensor.number);
        const Realization here = sensor.realization(realization);
        SensorSignals signals = signals_of_sensor(
            sensor, lane_signals(plan, tile, LaneId{0}, sensor_features.meshes()));
        sensor_features.compute(signals.linked(), here);
        add_sensor(plan.record, sensor, here, signals_of_sensor(sensor, all).record,
                   sensor_features, kSensorVariant + sensor.name, rows, out);
    }
}

// Time of every sample, s. A fluctuating speed makes the spacing uneven.
std::vector<double> sample_times(const GearboxPlan& gearbox, const SolvePlan& solve,
                                 const RecordPlan& record, const Realization& realization,
                                 MeshRange meshes) {
    std::vector<double> times;
    if (!gearbox.excitation || !gearbox.excitation->speed) {
        const double period_s = record.mesh_period_s(realization.inputs);
        for (long i = 0; i < meshes.count * record.samples; ++i) {
            times.push_back(static_cast<double>(i) / record.samples * period_s);
        }
        return times;
    }
    // Not every program is built for one lane.
    const auto lanes =
        static_cast<std::size_t>(lockstep::lanes_for(Precision::double_precision, 1));
    const std::vector<dynamics::GearboxInputs> inputs(lanes, gearbox.inputs(realization.inputs));
    const auto excitation =
        draw_excitation(gearbox, record.seed, {solve.longest_run_in(), record.signal_meshes},
                        std::vector<Realization>(lanes, realization));
    const lockstep::IntegrationPlan& plan = solve.integration();
    lockstep::ExcitationRows rows(plan, *excitation, inputs, /*with_time=*/true);
    for (long mesh = meshes.first; mesh < meshes.first + meshes.count; ++mesh) {
        rows.fill(static_cast<int>(mesh));
        for (std::size_t step = 0; step < plan.grid.steps.size(); ++step) {
            if (plan.grid.steps[step].sample >= 0) {
                times.push_back(*rows.time(static_cast<int>(step)));
            }
        }
    }
    if (meshes.first > 0) {
        const double start = times.front();
        for (double& time : times) {
            time -= start;
        }
    }
    return times;
}

}  // namespace

Simulation simulate(const TilePlan& plan, const GearboxId& id, long meshes) {
    const MeshRange range{
        plan.record.length
            ? record_window(plan.record, id, plan.record.turns(plan.sampler->draw(id).inputs))
                  .first_mesh
            : 0,
        meshes};
    const GearboxTile tile =
        run_gearboxes(plan, std::span(&id, 1), 1,
                      {.records = lockstep::RecordOptions{
                           .motion_meshes = static_cast<int>(range.first + range.count)}});
    if (tile.status[0] != Status::ok) {
        throw std::runtime_error(fmt::format("this gearbox {}", failure_text(tile.status[0])));
    }
    const HealthyReference healthy = healthy_reference(plan);
    RealizationFeatures features(plan, &healthy);
    Simulation out;
    out.noise_levels = plan.record.noise_levels;
    for (const features::Feature* feature : plan.features.used) {
        out.feature_names.emplace_back(feature->name);
    }
    out.features = features.compute(lane_signals(plan, tile, LaneId{0}, features.meshes()),
                                    tile.realizations[0]);

    const int samples = plan.record.samples;
    const auto inputs = plan.gearbox->inputs(tile.realizations[0].inputs);
    const auto rows = static_cast<std::size_t>(meshes) * static_cast<std::size_t>(samples);
    Column time{"time", "s", {}}, phase{"mesh_phase", "mesh periods", {}},
        angle{"carrier_angle", "rad", {}};
    const double period_s = dynamics::mesh_period_s(inputs);
    for (std::size_t i = 0; i < rows; ++i) {
        const double mesh = static_cast<double>(range.first) + static_cast<double>(i) / samples;
        phase.values.push_back(mesh);
        angle.values.push_back(mesh * period_s * dynamics::frame_speed_rad_s(inputs));
    }
    time.values =
        sample_times(*plan.gearbox, *plan.solve, plan.record, tile.realizations[0], range);
    out.columns = {time, phase};
    if (plan.gearbox->kind == GearboxKind::planetary) {
        out.columns.push_back(angle);
    }
    if (plan.features.sensor) {
        add_sensors(plan, tile, features, rows, out);
    }
    add_motion(plan.solve->integration(), *plan.gearbox->drivetrain, tile, range, out);
    if (!tile.integration.contact_loss.empty()) {
        const auto meshes_of_kind = plan.gearbox->meshes();
        const auto loss = contact_loss(tile, LaneId{0}, meshes_of_kind.size());
        for (std::size_t m = 0; m < loss.size(); ++m) {
            out.contact_loss.push_back({mesh_name(meshes_of_kind[m]), {loss[m]}});
        }
    }
    return out;
}

}  // namespace gearpod::mc
