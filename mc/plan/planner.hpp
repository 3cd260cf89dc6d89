// Makes the plans of one study that differ only in its numerics or in the number of its gearboxes.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "lockstep/integrators/method.hpp"
#include "mc/plan/description.hpp"
#include "mc/plan/scene.hpp"

namespace gearpod::mc {

// Facts of a study that the choice of its numerics needs in addition to its plans.
struct SolverFacts {
    Numerics numerics;  // as the study gives them
    // Cost of a step for the motion of the study's gearboxes; null if nothing is integrated.
    double lockstep::StepCost::*step_cost = nullptr;
    // Strategy that integrates every mesh period; empty if the study's strategy does so.
    std::optional<Horizon> every_mesh;
    bool verified = false;  // a run integrates some gearboxes again with finer steps
    double low_pass_Hz = 0.0;
    std::vector<std::string> features;  // names
    std::vector<double> noise_levels;
    long gearboxes = 0;  // of both groups
};

class Planner;

// Study without one of its optional effects, or with one that it lacks.
struct EffectVariant {
    std::string effect;
    bool in_study = false;
    std::function<Planner()> planner;  // throws SceneError if the study is then invalid
};

// Study with an assumption at `factor` times its value: the key that states it.
struct AssumptionVariant {
    std::string key;
    double factor = 1.0;
    std::function<Planner()> planner;  // throws SceneError if the study is then invalid
};

// Steps per mesh period of a plan.
struct PlannedSteps {
    lockstep::Integrator integrator = lockstep::kUsualExplicit;
    int samples = 0;                    // of the sensor, per mesh period
    int steps = 0;                      // per mesh period
    int least = 1;                      // Stepping::least
    double longest_step = 1.0;          // Stepping::longest_step
    std::optional<double> finest_step;  // of a graded grid, in mesh periods
};

// Plans share equal parts with the last plan made and with those of graded grids, each of which
// costs a pilot. Copies make the same plans. Not thread-safe.
class Planner {
  public:
    explicit Planner(const Study& study);
    // The same study with numerics that were chosen, and without a tolerance for them.
    Planner with(const Numerics& numerics) const;

    const SolverFacts& facts() const;
    // Plan with these numerics, whose tolerances are not resolved, and its parts. Throw SceneError.
    Scene scene(const Numerics& numerics) const;
    TilePlan tile(const Numerics& numerics) const;
    EnsemblePlan ensemble(const Numerics& numerics) const;
    StudyLives lives(const Numerics& numerics) const;
    PlannedSteps steps(const Numerics& numerics) const;
    // Throws SceneError if reading would reject the keys of [numerics] named in `keys`.
    void check(const Numerics& numerics, std::span<const std::string_view> keys) const;
    // Throws SceneError if there is no choice of solver settings: nothing is integrated, or shafts
    // couple the gearbox to other stages.
    void check_choice() const;
    // Highest natural frequency of the nominal gearbox without additional inertia.
    double fastest_mode_Hz(const Numerics& numerics) const;

    // The same study with at most `gearboxes` gearboxes, in its proportion of the two groups, and
    // without a stopping rule.
    Planner with_gearboxes(long gearboxes) const;
    // The same study without a tolerance and, where every mesh period is integrated and the
    // features allow it, with the shortest records. `span` and `mesh_frequency_Hz` are those of any
    // plan of the study.
    Planner with_short_records(const signals::SpanLayout& span, double mesh_frequency_Hz) const;
    // Plans of the study without each optional effect that it has, and with each that it lacks.
    std::vector<EffectVariant> effect_variants() const;
    // Plans of the study at half and at twice each assumption that it has, the most uncertain
    // first: the torque scatter of the baseline, the noise and the errors of the teeth.
    std::vector<AssumptionVariant> assumption_variants() const;
    // Description of the nominal gearbox and of the effects simulated and omitted, with these
    // numerics.
    std::vector<DescriptionSection> description(const Numerics& numerics) const;
    // Plan of the study's lives, integrated at these numbers of torques and speeds. Throws
    // SceneError if it has none.
    LifePlan life(const LoadNumber& torques, const LoadNumber& speeds) const;

  private:
    struct Plans;
    explicit Planner(std::shared_ptr<Plans> plans) : plans_(std::move(plans)) {}
    std::shared_ptr<Plans> plans_;
};

// Numerics without tolerances for which others would be chosen.
Numerics without_tolerance(Numerics numerics);

}  // namespace gearpod::mc
