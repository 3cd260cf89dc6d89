#include "mc/ensemble/gearbox/solution_choice.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <utility>

#include "lockstep/integrators/facts.hpp"
#include "lockstep/plan/stiffness_nodes.hpp"
#include "lockstep/steps/graded_grid.hpp"
#include "lockstep/tile/rigid_rotation.hpp"
#include "lockstep/tile/superposed_motion.hpp"
#include "lockstep/tile/tile_integrators.hpp"
#include "machine/clocks.hpp"
#include "mc/ensemble/coupling/record_positions.hpp"
#include "mc/ensemble/gearbox/integration_cache.hpp"
#include "mc/ensemble/gearbox/tile_random_inputs.hpp"
#include "mc/study/fluctuations.hpp"
#include "mc/study/gears.hpp"
#include "mc/study/housing.hpp"
#include "mc/study/noise.hpp"
#include "mc/study/other_sources.hpp"

namespace gearpod::mc {
namespace {

// Processor seconds of one thread for a healthy mesh period of W nominal gearboxes: the minimum of
// several integrations from rest. The motion may grow without bound, which does not change the
// cost.
template <int W>
double least_mesh_s(const Scene& scene, const lockstep::IntegrationPlan& plan, bool with_excitation,
                    int repetitions) {
    const std::vector<Realization> gearboxes(W, {{}, scene.gearbox().nominal});
    const std::vector<dynamics::GearboxInputs> inputs(W, scene.inputs(gearboxes[0].inputs));
    const auto excitation =
        with_excitation
            ? draw_excitation(scene.gearbox(), scene.draw().seed,
                              {scene.longest_run_in(), scene.signal_meshes()}, gearboxes)
            : std::nullopt;
    lockstep::MeshRecord record = lockstep::make_record(plan, W, false);
    std::function<void(lockstep::TileState&)> integrate;
    if constexpr (W <= 8) {  // there is no kernel with variable excitation for 16 lanes
        if (excitation) {
            integrate = [&, variable_kernel = std::shared_ptr<lockstep::ExcitedIntegrator<W>>(
                                lockstep::make_excited_integrator<W>(plan, *excitation, inputs))](
                            lockstep::TileState& state) {
                (*variable_kernel)(0, {}, state, record);
            };
        }
    }
    if (!integrate) {
        integrate = [&, steady = std::shared_ptr<const lockstep::MeshIntegrator<W>>(
                            lockstep::make_mesh_integrator<W>(plan, inputs))](
                        lockstep::TileState& state) { (*steady)({}, state, record); };
    }
    const auto degrees = static_cast<std::size_t>(dynamics::degrees_of_freedom(plan.layout));
    double least = std::numeric_limits<double>::infinity();
    for (int i = 0; i < repetitions; ++i) {
        lockstep::TileState state = lockstep::zero_state(degrees, plan.channels(), W);
        const double start = thread_processor_s();
        integrate(state);
        least = std::min(least, thread_processor_s() - start);
    }
    return least;
}

// Integration plan of the scene with the usual explicit method.
lockstep::IntegrationPlan explicit_plan(const Scene& scene, int steps) {
    lockstep::IntegrationPlan plan = scene.plan();
    plan.integrator = lockstep::kUsualExplicit;
    plan.grid = lockstep::make_phase_grid(plan.grid.samples, steps, {});
    plan.grid.stage_nodes = lockstep::stage_nodes(plan.integrator);
    plan.nodes = lockstep::tabulate(scene.pairs(), plan.grid, scene.study().effects.mesh_damping);
    if (dynamics::has_error(plan.mesh_law)) {
        lockstep::add_errors(
            scene.pairs(), plan.grid,
            std::vector<lockstep::MeshError>(static_cast<std::size_t>(scene.pairs().pairs())),
            plan.nodes);
    }
    return plan;
}

// Mesh periods recorded in addition to the periodic orbit: all of them, or the passages of the
// fault.
double additional_recorded_meshes(const Scene& scene) {
    if (scene.study().numerics.horizon != Horizon::periodic) {
        return scene.recorded_meshes();
    }
    return passage_meshes(scene);
}

double mesh_record_bytes(const Scene& scene) {
    const lockstep::MeshRecord record =
        lockstep::make_record(scene.plan(), scene.study().numerics.lanes, false);
    return 8.0 * static_cast<double>(record.acceleration.size() + record.te.size());
}

std::vector<int> part_periods(const Scene& scene) {
    const bool planetary = scene.study().gearbox.kind == GearboxKind::planetary;
    std::vector<int> teeth;
    for (const Member member : planetary ? std::vector{Member::sun, Member::planet, Member::ring}
                                         : std::vector{Member::pinion, Member::gear}) {
        teeth.push_back(teeth_of(scene.study(), member).value());
    }
    return lockstep::part_periods(std::move(teeth));
}

// Mesh periods of a record of the nominal gearbox. Precondition: records have a length.
int nominal_record_meshes(const Scene& scene) {
    return scene.record().turns(scene.gearbox().nominal) * scene.span().planet_teeth;
}

// True if it saves at least half of a full integration to integrate the records alone.
bool records_alone(const Scene& scene) {
    return scene.record().same_window > 1 && scene.study().numerics.horizon != Horizon::periodic &&
           2 * (run_in_meshes(scene) + nominal_record_meshes(scene)) <= scene.signal_meshes();
}

// Mesh periods to integrate if every one of the recorded mesh periods is integrated.
double full_integration_meshes(const Scene& scene) {
    return approach_meshes(scene) + run_in_meshes(scene) + recorded_meshes(scene);
}

// Mesh periods to integrate for superposed gearboxes without a fault.
double superposition_meshes(const Scene& scene) {
    return approach_meshes(scene) +
           lockstep::part_meshes(part_periods(scene), run_in_meshes(scene));
}

}  // namespace

double approach_meshes(const Scene& scene) {
    if (scene.study().effects.quasi_static()) {
        return 0.0;
    }
    return std::min(1.0 + scene.decay_meshes() * -std::log(convergence_tolerance(scene.study())),
                    static_cast<double>(scene.max_meshes()));
}

bool integrates_records_only(const Scene& scene) {
    return records_alone(scene) && !superposition(scene).healthy;
}

int recorded_meshes(const Scene& scene) {
    return records_alone(scene) ? std::min(nominal_record_meshes(scene), scene.recorded_meshes())
                                : scene.recorded_meshes();
}

Superposition superposition(const Scene& scene) {
    if (scene.study().numerics.horizon != Horizon::superposed) {
        return {};
    }
    const double all = full_integration_meshes(scene), parts = superposition_meshes(scene);
    return {parts < all, parts + passage_meshes_of_span(scene) < all};
}

double healthy_meshes(const Scene& scene) {
    return scene.study().numerics.horizon == Horizon::periodic ? approach_meshes(scene)
           : superposition(scene).healthy                      ? superposition_meshes(scene)
                                                               : full_integration_meshes(scene);
}

double integrated_meshes(const Scene& scene) {
    return scene.study().numerics.horizon == Horizon::periodic
               ? approach_meshes(scene) + passage_meshes(scene)
           : superposition(scene).faulty
               ? superposition_meshes(scene) + passage_meshes_of_span(scene)
               : full_integration_meshes(scene);
}

double passage_meshes(const Scene& scene) {
    if (scene.faulty_pair() < 0) {
        return 0.0;
    }
    const double passage = std::ceil(scene.pairs().curve(scene.faulty_pair()).contact_ratio()) +
                           approach_meshes(scene);
    return std::min(passage * static_cast<double>(scene.pattern().passages.size()),
                    static_cast<double>(scene.pattern().length));
}

double passage_meshes_of_span(const Scene& scene) {
    const double span = run_in_meshes(scene) + scene.recorded_meshes();
    return std::min(passage_meshes(scene) * span / scene.pattern().length, span);
}

bool records_during_integration(const Scene& scene) {
    return scene.study().numerics.horizon != Horizon::periodic &&
           !scene.study().effects.quasi_static() && !distinct_integrations(scene);
}

int needed_sensor_meshes(const Scene& scene, features::SignalSet needs) {
    const bool cut = scene.record().length && !scene.study().effects.quasi_static();
    return needs_samples(needs) || cut || any_response(scene.study()) ? scene.signal_meshes()
           : noise_by_density(scene.study()) || has_range(scene.study()) ||
                   has_other_sources(scene.study())
               ? scene.span_meshes()
               : 0;
}

int needed_sensor_meshes(const Scene& scene) {
    return needed_sensor_meshes(scene, scene.features().needs.all());
}

double motion_bytes(const Scene& scene) {
    if (!records_during_integration(scene)) {
        return record_bytes(scene);
    }
    // Copies: samples as recorded and by lane, plus those of the baseline records.
    const double copies = 2.0 + static_cast<double>(scene.record().baselines);
    const double samples =
        static_cast<double>(needed_sensor_meshes(scene)) * scene.samples_per_mesh();
    return copies * 8.0 * samples * scene.study().numerics.lanes +
           (superposition(scene).healthy ? record_bytes(scene) : 2.0 * mesh_record_bytes(scene));
}

double record_bytes(const Scene& scene) {
    return mesh_record_bytes(scene) *
           (1.0 + additional_recorded_meshes(scene) +
            (superposition(scene).healthy ? lockstep::part_meshes(part_periods(scene), 0) : 0));
}

double mesh_period_s(const Scene& scene) {
    constexpr int kRepetitions = 5;
    return with_lane_count(scene.study().numerics.lanes, [&](auto lanes) {
        return least_mesh_s<lanes()>(scene, scene.plan(), true, kRepetitions);
    });
}

double explicit_step_s(const Scene& scene) {
    constexpr int kSteps = 2000, kRepetitions = 20;
    const lockstep::IntegrationPlan plan =
        lockstep::in_double_precision(explicit_plan(scene, kSteps));
    return least_mesh_s<lockstep::kPilotLanes>(scene, plan, false, kRepetitions) /
           static_cast<double>(plan.grid.steps.size()) / lockstep::kPilotLanes;
}

namespace {

template <class T>
const T* pointer_to(const std::optional<T>& value) {
    return value ? &*value : nullptr;
}

}  // namespace

lockstep::Convergence convergence_of(const Scene& scene) {
    return {convergence_tolerance(scene.study()), scene.max_meshes()};
}

lockstep::Solution choose_solution(const Scene& scene, const TileLoads& loads,
                                   const lockstep::RecordOptions& options,
                                   std::function<void(int, const lockstep::MeshRecord&)> on_record,
                                   std::vector<lockstep::SpanPart> parts) {
    const bool periodic = scene.study().numerics.horizon == Horizon::periodic;
    const bool quasi_static = scene.study().effects.quasi_static();
    if (quasi_static && !periodic) {
        return lockstep::QuasiStaticSolution{
            lockstep::StaticSpan{scene.recorded_meshes(), options.motion_meshes,
                                 pointer_to(loads.tooth_errors), pointer_to(loads.excitation)}};
    }
    if (periodic) {
        const bool with_motion = options.motion_meshes > 0;
        std::optional<lockstep::ConstantGravity> gravity;
        if (loads.excitation) {
            gravity = loads.excitation->gravity;
        }
        if (quasi_static) {
            return lockstep::QuasiStaticSolution{lockstep::StaticPattern{with_motion, gravity}};
        }
        return lockstep::PeriodicSolution{convergence_of(scene), with_motion, gravity};
    }
    lockstep::RecordedSpan span{scene.recorded_meshes(), run_in_meshes(scene), options,
                                std::move(on_record)};
    if (const Superposition use = superposition(scene); use.healthy) {
        return lockstep::SuperposedSolution{*loads.tooth_errors, convergence_of(scene),
                                            std::move(span), use.faulty};
    }
    span.parts = std::move(parts);
    return lockstep::FullSolution{convergence_of(scene), std::move(span),
                                  pointer_to(loads.tooth_errors), pointer_to(loads.excitation)};
}

lockstep::FaultPerturbation fault_perturbation(const Scene& scene, const TileLoads& loads,
                                               const lockstep::SpanStates& healthy) {
    return {healthy, convergence_of(scene), pointer_to(loads.tooth_errors)};
}

bool integrates_perturbation_only(const Scene& scene) {
    const Study& study = scene.study();
    return study.numerics.horizon != Horizon::periodic && !study.effects.quasi_static() &&
           !has_variable_excitation(study) && !is_coupled(study) &&
           scene.recorded_meshes() == scene.span_meshes();
}

}  // namespace gearpod::mc
