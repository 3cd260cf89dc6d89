// What `accuracy` finds: every rung of the ladder with its time and its error against a converged
// reference, and what numerics.tolerance would choose.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "mc/accuracy/pilot_detection.hpp"
#include "mc/numerics/reference.hpp"
#include "mc/numerics/rung.hpp"

namespace gearpod::mc {

// Of a rung that is left out for want of time.
inline constexpr const char* kNotTried = "not tried: the time was up";

struct RungResult {
    Rung rung;
    std::string refusal;  // why it has no place in the study; then nothing else is said
    int steps = 0;        // of the phase grid, a mesh period
    double meshes = 0.0;  // marched by a tile
    double failed = 0.0;  // gearboxes of the pilot
    // Processor seconds of one thread and gearbox in full tiles: the least and the median of the
    // repeats.
    double march_s = 0.0, march_median_s = 0.0, total_s = 0.0;
    double mesh_s = 0.0;  // march_s by the mesh periods marched
    double cost = 0.0;    // by the cost model, in steps of rk4
    PilotError error;
    bool frontier = false;  // no rung is both faster and closer
    std::optional<DetectionChange> detection;
};

// The classical Runge-Kutta method at its stability limit, marched or not.
struct ExplicitLimit {
    double steps = 0.0;   // a mesh period
    double step_s = 0.0;  // one gearbox and step, measured
    double meshes = 0.0;  // a tile, settled to the study's own tolerance
    bool refused = false;
    double mesh_s() const { return steps * step_s; }
    double march_s() const { return mesh_s() * meshes; }
};

// What a tolerance chooses and how it compares with the best rung measured.
struct ChoiceCheck {
    double tolerance = 0.0;
    std::string refusal;
    int chosen = -1, best = -1;  // places in AccuracyReport::rungs
    double over_best = 0.0;      // time of the chosen over the best's, less one
};

// A method of another program, from a table.
struct PeerResult {
    std::string name, command;
    double march_s = 0.0, mesh_s = 0.0;                    // a gearbox, a mesh period
    double sensor = 0.0, te = 0.0;                         // as PilotError has them
    std::vector<std::pair<std::string, double>> features;  // relative
};

struct AccuracyReport {
    std::vector<std::string> features;
    std::vector<double> noise_levels;
    int gearboxes = 0, signal_meshes = 0, span_meshes = 0;
    double mesh_frequency_Hz = 0.0;
    Reference reference;
    ExplicitLimit explicit_limit;
    std::vector<RungResult> rungs;
    int own = -1;  // the study's own rung
    std::vector<ChoiceCheck> choices;
    std::vector<PeerResult> peers;
    std::vector<std::string> step_costs;  // the cost model's ratios against the measured ones
    std::vector<std::string> left_out;    // because the time was up

    int levels() const { return static_cast<int>(noise_levels.size()); }
};

struct AccuracyRequest {
    int repeats = 3;
    std::vector<double> tolerances{1e-2, 1e-3, 1e-4};
    // Of the pilot ensemble, both groups; 0: none. By default 480, or as many as the time allows.
    std::optional<long> gearboxes;
    double seconds = 300.0;  // processor time after which no part is begun; 0: none is left out
    std::function<void(const std::string&)> progress = [](const std::string&) {};
};

// Throws SceneError.
AccuracyReport measure_accuracy(const Study& study, const AccuracyRequest& request);

std::string accuracy_text(const AccuracyReport& report);
std::string accuracy_json(const AccuracyReport& report, const Study& study);

// Rows of a peer's table (CSV: name, command, march_s, mesh_s, sensor, te, then features by name).
// Throws std::runtime_error naming file, line and what is wrong.
std::vector<PeerResult> read_peers(const std::string& path);

}  // namespace gearpod::mc
