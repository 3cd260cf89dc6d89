#include "mc/plan/planner.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "mc/plan/feature_needs.hpp"
#include "mc/study/fluctuations.hpp"
#include "mc/study/other_sources.hpp"

namespace gearpod::mc {
namespace {

SolverFacts facts_of(const Study& study) {
    const bool integrates_every_mesh =
        study.numerics.horizon != Horizon::superposed && !reason_not_periodic(study).empty();
    return {study.numerics,
            study.effects.quasi_static()                     ? nullptr
            : study.gearbox.kind == GearboxKind::fixed_shaft ? &lockstep::StepCost::fixed_shaft
            : study.effects.torsional()                      ? &lockstep::StepCost::rotations
                                                             : &lockstep::StepCost::planetary,
            integrates_every_mesh ? std::nullopt : std::optional(Horizon::full),
            study.sensor.low_pass_Hz,
            study.features.use,
            study.sensor.noise_levels};
}

Study with_numerics(Study study, const Numerics& numerics) {
    study.numerics = numerics;
    return study;
}

}  // namespace

Planner::Planner(const Study& study) : Planner(study, nullptr) {}

Planner::Planner(const Scene& plan) : Planner(plan.study(), std::make_shared<const Scene>(plan)) {}

Planner::Planner(const Study& study, std::shared_ptr<const Scene> last)
    : study_(std::make_shared<const Study>(study)),
      facts_(facts_of(study)),
      last_(std::move(last)) {}

Scene Planner::plan(const Numerics& numerics) const {
    const auto shares_grid = [&](const std::shared_ptr<const Scene>& other) {
        Numerics same = other->study().numerics;
        same.convergence_tolerance = numerics.convergence_tolerance;
        return same == numerics;
    };
    const auto known = std::ranges::find_if(graded_, shares_grid);
    const std::shared_ptr<const Scene> base = known != graded_.end() ? *known : last_;
    const auto made = std::make_shared<const Scene>(base ? base->with(numerics)
                                                         : Scene(with_numerics(*study_, numerics)));
    if (numerics.grid == StepGrid::uniform || !last_) {
        last_ = made;
    }
    if (numerics.grid == StepGrid::graded && known == graded_.end()) {
        graded_.push_back(made);
    }
    return *made;
}

void Planner::check(const Numerics& numerics, std::span<const std::string_view> keys) const {
    const Problems problems = numerics_problems(with_numerics(*study_, numerics), keys);
    if (!problems.empty()) {
        const Problem& first = problems.front();
        throw SceneError(first.key, first.what, first.remedy);
    }
}

void Planner::check_choice() const {
    if (study_->effects.quasi_static()) {
        throw SceneError("effects.motion",
                         "a quasi-static study has no time integration, so there are no solver "
                         "settings to compare",
                         "choose a motion with inertia, e.g. \"translational-torsional\"");
    }
    if (is_coupled(*study_)) {
        throw SceneError("sensor.stages",
                         "stages that elastic shafts couple are integrated by one method only, so "
                         "there are no solver settings to compare",
                         "remove shaft_stiffness_N_m_rad, or compare the settings of each stage's "
                         "own study");
    }
}

Planner Planner::with_gearboxes(long gearboxes) const {
    Study fewer = *study_;
    Ensemble& e = fewer.ensemble;
    e.until = {};
    const double share =
        static_cast<double>(gearboxes) / static_cast<double>(e.instances + e.threshold_instances);
    if (share < 1.0) {
        const auto part = [share](std::int64_t all) {
            return std::max<std::int64_t>(1, std::llround(share * static_cast<double>(all)));
        };
        e.instances = part(e.instances);
        e.threshold_instances = part(e.threshold_instances);
    }
    return Planner(fewer);
}

Scene Planner::plan_with_short_records(const signals::SpanLayout& span,
                                       double mesh_frequency_Hz) const {
    const Numerics numerics = without_tolerance(facts_.numerics);
    if (reason_not_periodic(*study_).empty()) {
        return plan(numerics);
    }
    Study brief = with_numerics(*study_, numerics);
    brief.sensor.record_turns.reset();
    // Half a mesh period more, because whole turns are taken.
    brief.sensor.record_s =
        (kLeastRecordTurns * span.planet_teeth + 0.5) / std::abs(mesh_frequency_Hz);
    try {
        return Scene(brief);
    } catch (const SceneError&) {
        return plan(numerics);
    }
}

Numerics without_tolerance(Numerics numerics) {
    numerics.tolerance = numerics.scatter_tolerance = 0.0;
    return numerics;
}

}  // namespace gearpod::mc
