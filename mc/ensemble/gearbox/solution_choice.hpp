// Calls code that is compiled for a fixed number of lanes.
#pragma once

#include <optional>
#include <type_traits>

#include "features/signals.hpp"
#include "lockstep/strategies/solution.hpp"
#include "mc/plan/scene.hpp"

namespace gearpod::mc {

// Calls call(std::integral_constant<int, W>) for W = 1, 4, 8 or 16 lanes.
template <class Call>
auto with_lane_count(int lanes, Call call) {
    if (lanes == 1) {
        return call(std::integral_constant<int, 1>());
    }
    if (lanes == 4) {
        return call(std::integral_constant<int, 4>());
    }
    if (lanes == 8) {
        return call(std::integral_constant<int, 8>());
    }
    return call(std::integral_constant<int, 16>());
}

// Estimates of the number of mesh periods to integrate, of their time, and of the memory for their
// records.

// Mesh periods that the nominal gearbox needs to converge to its periodic orbit; 0 for a
// quasi-static study.
double approach_meshes(const Scene& scene);
// Mesh periods that a tile integrates or solves: approach, run-in, and the passages of the fault or
// all recorded periods, as the strategy requires. Estimated from the nominal damping; most
// gearboxes need about as many.
double integrated_meshes(const Scene& scene);

// Mesh periods that a fault changes: its passages and the decay after them.
double passage_meshes(const Scene& scene);

// Mesh periods of the run-in and the recorded span that a fault changes, all its passages included.
double passage_meshes_of_span(const Scene& scene);

// Mesh periods that a tile without a fault integrates.
double healthy_meshes(const Scene& scene);

// True if tiles integrate the windows of their records only (parts_of_records): records
// share windows, the study needs full integration, and that saves at least half of it.
bool integrates_records_only(const Scene& scene);
// Mesh periods that a tile of test records records one by one.
int recorded_meshes(const Scene& scene);

// True for gearboxes that are superposed while their teeth keep contact: the study requests it and
// it takes fewer mesh periods.
struct Superposition {
    bool healthy = false, faulty = false;
};
Superposition superposition(const Scene& scene);

// True if sensor signals are recorded during integration and the motion is not kept. This is so if
// every mesh period is integrated and no other tile can use the result.
bool records_during_integration(const Scene& scene);

// Number of mesh periods of sensor samples that must be synthesized: for features that need these
// signals, or for all features of the study.
int needed_sensor_meshes(const Scene& scene, features::SignalSet needs);
int needed_sensor_meshes(const Scene& scene);

// Memory in bytes for the motion that a tile keeps, and for the records of all its mesh periods.
double motion_bytes(const Scene& scene);
double record_bytes(const Scene& scene);

// Processor seconds of one thread for one healthy mesh period of a full tile with the study's
// excitation: the minimum of several integrations from rest.
double mesh_period_s(const Scene& scene);

// Processor seconds of one step of the classical Runge-Kutta method, per gearbox of a full tile,
// with constant excitation. The study need not use this method.
double explicit_step_s(const Scene& scene);

// Choice of the strategy with which the tiles of a study are solved.

// Tooth errors and excitation of a tile, if the study has any. The solution refers to both.
struct TileLoads {
    std::optional<lockstep::ToothErrors> tooth_errors;
    std::optional<lockstep::Excitation> excitation;
};

// Criterion for the convergence to a periodic orbit.
lockstep::Convergence convergence_of(const Scene& scene);

// `options`, `on_record` and `parts` as in lockstep::RecordedSpan. `on_record` is used only if
// every mesh period is integrated (records_during_integration), and `parts` only with full
// integration.
lockstep::Solution choose_solution(const Scene& scene, const TileLoads& loads,
                                   const lockstep::RecordOptions& options,
                                   std::function<void(int, const lockstep::MeshRecord&)> on_record,
                                   std::vector<lockstep::SpanPart> parts = {});

// Perturbation of these healthy states; only for scenes for which integrates_perturbation_only is
// true.
lockstep::FaultPerturbation fault_perturbation(const Scene& scene, const TileLoads& loads,
                                               const lockstep::SpanStates& healthy);

// True if only the perturbation from the healthy solution has to be integrated: every mesh period
// of the span is integrated, under a constant excitation and without coupled stages.
bool integrates_perturbation_only(const Scene& scene);

}  // namespace gearpod::mc
