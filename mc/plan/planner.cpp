#include "mc/plan/planner.hpp"

#include <algorithm>
#include <cmath>

#include "mc/plan/feature_plan.hpp"
#include "mc/study/fluctuations.hpp"
#include "mc/study/sensor_signal.hpp"

namespace gearpod::mc {

// study_variants.cpp
std::vector<EffectVariant> effect_variants(const Study& study);
std::vector<AssumptionVariant> assumption_variants(const Study& study);

namespace {

SolverFacts facts_of(const Study& study) {
    const bool integrates_every_mesh =
        study.numerics.horizon != Horizon::superposed && !reason_not_periodic(study).empty();
    const Numerics& n = study.numerics;
    return {n,
            study.effects.quasi_static()                     ? nullptr
            : study.gearbox.kind == GearboxKind::fixed_shaft ? &lockstep::StepCost::fixed_shaft
            : study.effects.torsional()                      ? &lockstep::StepCost::rotations
                                                             : &lockstep::StepCost::planetary,
            integrates_every_mesh ? std::nullopt : std::optional(Horizon::full),
            n.tolerance > 0.0 || n.scatter_tolerance > 0.0 || n.verify || n.paired_gearboxes > 0,
            study.sensor.low_pass_Hz,
            study.features.use,
            study.sensor.noise_levels,
            static_cast<long>(study.ensemble.instances + study.ensemble.threshold_instances)};
}

Study with_numerics(Study study, const Numerics& numerics) {
    study.numerics = numerics;
    return study;
}

}  // namespace

struct Planner::Plans {
    const Study study;
    const SolverFacts facts;
    std::shared_ptr<const Scene> last;  // with uniform steps; may be null
    std::vector<std::shared_ptr<const Scene>> graded;

    std::shared_ptr<const Scene> with(const Numerics& numerics) {
        const auto shares = [&](const std::shared_ptr<const Scene>& plan) {
            return share_steps(plan->solve().settings.numerics, numerics);
        };
        const auto known = std::ranges::find_if(graded, shares);
        const std::shared_ptr<const Scene> base = known != graded.end() ? *known : last;
        const Study changed = with_numerics(study, numerics);
        const auto made = base ? std::make_shared<const Scene>(base->with_numerics_of(changed))
                               : std::make_shared<const Scene>(changed);
        if (numerics.grid == StepGrid::graded && known == graded.end()) {
            graded.push_back(made);
        }
        if (numerics.grid == StepGrid::uniform || !last) {
            last = made;
        }
        return made;
    }
};

Planner::Planner(const Study& study) : plans_(new Plans{study, facts_of(study), nullptr, {}}) {}

Planner Planner::with(const Numerics& numerics) const {
    SolverFacts facts = facts_of(with_numerics(plans_->study, numerics));
    facts.numerics = without_tolerance(numerics);
    return Planner(std::make_shared<Plans>(with_numerics(plans_->study, numerics), facts,
                                           plans_->last, plans_->graded));
}

const SolverFacts& Planner::facts() const {
    return plans_->facts;
}

Scene Planner::scene(const Numerics& numerics) const {
    return *plans_->with(numerics);
}

TilePlan Planner::tile(const Numerics& numerics) const {
    return plans_->with(numerics)->tile();
}

EnsemblePlan Planner::ensemble(const Numerics& numerics) const {
    return plans_->with(numerics)->ensemble();
}

StudyLives Planner::lives(const Numerics& numerics) const {
    return plans_->with(numerics)->lives();
}

PlannedSteps Planner::steps(const Numerics& numerics) const {
    const std::shared_ptr<const Scene> plan = plans_->with(numerics);
    const SolvePlan& solve = plan->solve();
    const std::optional<Calibration>& calibration = solve.steps->calibration;
    return {solve.integration().integrator,
            plan->record().samples,
            static_cast<int>(solve.integration().grid.steps.size()),
            solve.stepping().least,
            solve.stepping().longest_step,
            calibration ? std::optional(calibration->grading.first) : std::nullopt};
}

void Planner::check(const Numerics& numerics, std::span<const std::string_view> keys) const {
    const Problems problems = numerics_problems(with_numerics(plans_->study, numerics), keys);
    if (!problems.empty()) {
        const Problem& first = problems.front();
        throw SceneError(first.key, first.what, first.remedy);
    }
}

void Planner::check_choice() const {
    if (plans_->study.effects.quasi_static()) {
        throw SceneError("effects.motion",
                         "a quasi-static study has no time integration, so there are no solver "
                         "settings to compare",
                         "choose a motion with inertia, e.g. \"translational-torsional\"");
    }
    if (is_coupled(plans_->study)) {
        throw SceneError("sensor.stages",
                         "stages that elastic shafts couple are integrated by one method only, so "
                         "there are no solver settings to compare",
                         "remove shaft_stiffness_N_m_rad, or compare the settings of each stage's "
                         "own study");
    }
}

double Planner::fastest_mode_Hz(const Numerics& numerics) const {
    const GearboxPlan& gearbox = plans_->with(numerics)->gearbox();
    return dynamics::natural_frequencies_Hz(dynamics::assemble(gearbox.bodies.layout,
                                                               gearbox.inputs(gearbox.nominal),
                                                               gearbox.stiffness->mean_pairs()))
        .back();
}

Planner Planner::with_gearboxes(long gearboxes) const {
    Study fewer = with_numerics(plans_->study, facts().numerics);
    Ensemble& e = fewer.ensemble;
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

Planner Planner::with_short_records(const signals::SpanLayout& span,
                                    double mesh_frequency_Hz) const {
    const Study plain = with_numerics(plans_->study, without_tolerance(facts().numerics));
    if (reason_not_periodic(plain).empty()) {
        return Planner(plain);
    }
    Study brief = plain;
    brief.sensor.record_turns.reset();
    // Half a mesh period more, because whole turns are taken.
    brief.sensor.record_s =
        (kLeastRecordTurns * span.planet_teeth + 0.5) / std::abs(mesh_frequency_Hz);
    try {
        const Planner planner(brief);
        planner.tile(brief.numerics);
        return planner;
    } catch (const SceneError&) {
        return Planner(plain);
    }
}

std::vector<EffectVariant> Planner::effect_variants() const {
    return mc::effect_variants(plans_->study);
}

std::vector<AssumptionVariant> Planner::assumption_variants() const {
    return mc::assumption_variants(plans_->study);
}

std::vector<DescriptionSection> Planner::description(const Numerics& numerics) const {
    const std::shared_ptr<const Scene> plan = plans_->with(numerics);
    return description_of(with_numerics(plans_->study, numerics), plan->gearbox(),
                          plan->solve().stepping().decay_meshes);
}

LifePlan Planner::life(const LoadNumber& torques, const LoadNumber& speeds) const {
    Study study = plans_->study;
    study.life.polynomial_torques = torques.nodes;
    study.life.polynomial_speeds = speeds.nodes;
    LifePlan plan = plans_->with(facts().numerics)->life();
    plan.torques = torques;
    plan.speeds = speeds;
    plan.campaign = make_campaign_plan(study);
    return plan;
}

Numerics without_tolerance(Numerics numerics) {
    numerics.tolerance = numerics.scatter_tolerance = 0.0;
    return numerics;
}

}  // namespace gearpod::mc
