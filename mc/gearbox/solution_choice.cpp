#include "mc/gearbox/solution_choice.hpp"

#include <utility>

#include "mc/gearbox/mesh_time.hpp"
#include "mc/gearbox/tile_random_inputs.hpp"
#include "mc/study/fluctuations.hpp"
#include "mc/study/other_sources.hpp"

namespace gearpod::mc {
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
