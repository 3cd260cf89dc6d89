// Solution of a tile: the motion of its gearboxes alone, or together with the stages to which
// elastic shafts couple them.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "lockstep/tile/tile.hpp"
#include "machine/clocks.hpp"
#include "machine/ids.hpp"
#include "mc/ensemble/gearbox/solution_choice.hpp"
#include "mc/ensemble/gearbox/tile_sensors.hpp"
#include "mc/plan/sampling.hpp"
#include "mc/plan/tile_plan.hpp"
#include "mc/results/results_file.hpp"
#include "mc/study/sensor_signal.hpp"
#include "signals/noise/tones.hpp"
#include "signals/sensor/sensor_signal.hpp"
#include "signals/tile_signals.hpp"

namespace gearpod::mc {

// Returns the seconds since `start` and sets `start` to now.
inline double lap(WallClock::time_point& start) {
    const auto now = WallClock::now();
    return std::chrono::duration<double>(now - std::exchange(start, now)).count();
}

// Motion of a tile, and the time that it took.
struct TileSolution {
    lockstep::TileResult integration;
    // Samples of each coupled stage at its own sensor, [stage][gearbox][sample], m/s^2.
    std::vector<std::vector<std::vector<double>>> coupled;
    int meshes = 0;  // integrated, of all stages
    double stiffness_s = 0.0, integration_s = 0.0;
    double integration_cpu_s = 0.0;  // processor time of this thread for the time integration
};

// In the functions below `realizations` has one gearbox per lane.

// Solves a tile by the strategy that solution_of(loads) returns.
TileSolution solve(const TilePlan& plan, std::span<const Realization> realizations,
                   const std::function<lockstep::Solution(const TileLoads&)>& solution_of);

// Receives the record of a mesh period, as lockstep::RecordedSpan::on_record.
using OnRecord = std::function<void(int, const lockstep::MeshRecord&)>;

// Solves a tile together with the coupled stages next to its gearboxes. The gearboxes of stage
// `faulty_stage` have their fault. Requires check_stages().
TileSolution solve_coupled(const TilePlan& plan, const CoupledStages& coupled,
                           std::span<const Realization> realizations,
                           const lockstep::RecordOptions& options, const OnRecord& on_record,
                           std::optional<std::size_t> faulty_stage);

// Status of a gearbox whose lane ended with that status.
Status status_of(const GearboxPlan& gearbox, const SolvePlan& solve, const InstanceInputs& instance,
                 lockstep::LaneStatus status);

// Computes recorded motion and folded signals of a tile of W gearboxes from their sampled inputs.

class IntegrationCache;  // integration_cache.hpp

struct LaneSignals {
    std::vector<double> folded;   // as GearboxTile::folded, of the first sensor
    std::vector<double> te_turn;  // as GearboxTile::te_turn
    std::vector<double> sensor;   // m/s^2 without noise, [mesh * P + p]
    std::vector<double> te;       // rad, [mesh * P_te + p]; empty unless records have a length
    // Signals of the gearbox's baseline records, owned by the tile: null unless a feature compares
    // with the baseline, and only one if their motion is the same.
    const LaneSignals* baseline = nullptr;
    std::size_t baselines = 0;
    SensorNoise noise;  // of the sensor in this record, at noise level 1
    // Samples of each coupled stage at its own sensor, m/s^2, in the order and from the start that
    // coupled_span() states.
    std::vector<std::vector<double>> coupled;
    // Folded signals and samples of the additional sensors in this record; all else is the same.
    std::vector<LaneSignals> additional;
    // Window of a record that was cut from the signals (record_window.hpp): turns of the monitored
    // gear, or 0 for the plan's span, and mesh period of the signals at which the record begins.
    int turns = 0, first_mesh = 0;
};

// Results of a tile. `integration.records` owns the data that `views` refers to. If
// `sensor_recorders` recorded the sensor signals, `integration.records` holds only the healthy mesh
// period. `meshes` is 0 if `integration` came from the cache.
struct GearboxTile : TileSolution {
    std::vector<Realization> realizations;  // one entry per lane
    std::size_t gearboxes = 0;              // requested; further lanes repeat the last one
    // Mesh periods of the signals that were integrated; empty: all (EveryMeshPeriod).
    std::vector<lockstep::SpanPart> parts;
    std::vector<Status> status;  // one entry per requested gearbox
    signals::TileSignals views;
    SensorRecorders sensor_recorders;  // empty if the records were kept
    signals::Tones tones;              // interfering tones; may be empty
    // By sensor: [bin][lane], (m/s^2)^2; empty for a quasi-static gearbox. Each is empty where the
    // chain of the sensor does not begin with a PathStage.
    std::vector<machine::AlignedVector> folded;
    machine::AlignedVector te_turn;  // [sample][lane], rad
    // Equally many entries for each requested gearbox, one gearbox after the other. Empty unless a
    // feature compares with baseline records.
    std::vector<LaneSignals> baseline;

    double sampling_s = 0.0, signals_s = 0.0;
    // Number of records (baselines included) computed by superposition, and number that fell back
    // to full integration.
    std::ptrdiff_t superposed = 0, superposition_fallbacks = 0;
};

// Optional outputs of a tile.
struct TileOptions {
    // If set, the records of every mesh period are kept. Motions are recorded only then.
    std::optional<lockstep::RecordOptions> records = {};
    // Number of mesh periods of sensor samples to keep if the signal is recorded during
    // integration; -1 keeps all.
    int signal_meshes = -1;
    const IntegrationCache* cache = nullptr;  // earlier results, which are reused without `records`
    std::optional<std::size_t> faulty_stage = {};  // coupled stage that has its fault
    std::size_t repeats = 1;  // number of records of each gearbox (GearboxId::repeat)
};

// Runs the gearboxes in `ids`, at most one per lane. The number of lanes is `fewest` (16, 8, 4 or
// 1) or the next larger number for which the program has kernels. Unused lanes repeat the last
// gearbox. If features compare with baseline records, these run first, or in the same tile if
// enough of its lanes are free. A gearbox whose baseline fails counts as failed. If every mesh
// period is integrated, the sensor signals are recorded during integration and the motion is not
// kept.
GearboxTile run_gearboxes(const TilePlan& plan, std::span<const GearboxId> ids, int fewest,
                          const TileOptions& options = {});

// Runs the test records of these gearboxes, without baselines. Their inputs need not be those that
// the study's distributions give.
GearboxTile run_realizations(const TilePlan& plan, std::vector<Realization> realizations,
                             int fewest, const TileOptions& options = {});

// Integrates only the mesh periods that the faults of these gearboxes change. Starts from the
// healthy states of the same gearboxes in a tile of `lanes` lanes. Requires
// SolvePlan::perturbation_only. Sets only realizations, integration and status of the
// result.
GearboxTile run_fault_perturbations(const TilePlan& plan, std::vector<Realization> realizations,
                                    int lanes, const lockstep::SpanStates& healthy);

// Views of the recorded motion of a tile, which must outlive them.
signals::TileSignals views_of(const RecordPlan& record, const GearboxTile& tile);

// Completes a tile from a time integration made elsewhere, as run_gearboxes does. The number of
// lanes is the number of status entries of `integration`.
GearboxTile complete_tile(const TilePlan& plan, std::span<const GearboxId> ids,
                          lockstep::TileResult integration);

// Contact loss ratio of each mesh of the gearbox: the mean over the gear pairs of that mesh.
// `meshes` is the number of meshes; 0 gives an empty result.
std::vector<double> contact_loss(const GearboxTile& tile, LaneId lane, std::size_t meshes);

// Transmission error of a lane over mesh periods of a tile with all records, as `samples` values in
// each.
std::vector<double> recorded_te(const RecordPlan& plan, const GearboxTile& tile, LaneId lane,
                                int first, int meshes, int samples);
// Subtracts the mean of the values from each of them.
void remove_mean(std::vector<double>& values);

// Signals of one lane. `meshes` is the number of mesh periods of sensor signal, 0 for none.
LaneSignals lane_signals(const TilePlan& plan, const GearboxTile& tile, LaneId lane, int meshes);
// Signals of all requested gearboxes, computed together.
std::vector<LaneSignals> all_lane_signals(const TilePlan& plan, const GearboxTile& tile,
                                          int meshes);

// Signals of an additional sensor of a gearbox, and those of its baseline records.
struct SensorSignals {
    LaneSignals record;
    std::vector<LaneSignals> baseline;

    // Lets the record refer to its baselines, which must not move afterwards.
    const LaneSignals& linked() {
        record.baseline = baseline.data();
        record.baselines = baseline.size();
        return record;
    }
};
// The record does not refer to its baselines.
SensorSignals signals_of_sensor(const SensorPlan& sensor, const LaneSignals& all);

}  // namespace gearpod::mc
