// Makes the plans of one study that differ only in its numerics or in the number of its gearboxes.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "lockstep/integrators/method.hpp"
#include "mc/plan/scene.hpp"

namespace gearpod::mc {

// Facts of a study that the choice of its numerics needs in addition to its plans.
struct SolverFacts {
    Numerics numerics;  // as the study gives them
    // Cost of a step for the motion of the study's gearboxes; null if nothing is integrated.
    double lockstep::StepCost::*step_cost = nullptr;
    // Strategy that integrates every mesh period; empty if the study's strategy does so.
    std::optional<Horizon> every_mesh;
    double low_pass_Hz = 0.0;
    std::vector<std::string> features;  // names
    std::vector<double> noise_levels;
};

// Plans share equal parts with the last plan made and with those of graded grids, each of which
// costs a pilot. Not thread-safe.
class Planner {
  public:
    explicit Planner(const Study& study);
    // For the study of a plan, which is shared.
    explicit Planner(const Scene& plan);

    const SolverFacts& facts() const { return facts_; }
    // Plan with these numerics, whose tolerances are not resolved. Throws SceneError.
    Scene plan(const Numerics& numerics) const;
    // Throws SceneError if reading would reject the keys of [numerics] named in `keys`.
    void check(const Numerics& numerics, std::span<const std::string_view> keys) const;
    // Throws SceneError if there is no choice of solver settings: nothing is integrated, or shafts
    // couple the gearbox to other stages.
    void check_choice() const;

    // The same study with at most `gearboxes` gearboxes, in its proportion of the two groups, and
    // without a stopping rule.
    Planner with_gearboxes(long gearboxes) const;
    // Plan without a tolerance and, where every mesh period is integrated and the features allow
    // it, with the shortest records. `span` and `mesh_frequency_Hz`: those of any plan of the
    // study.
    Scene plan_with_short_records(const signals::SpanLayout& span, double mesh_frequency_Hz) const;

  private:
    Planner(const Study& study, std::shared_ptr<const Scene> last);

    std::shared_ptr<const Study> study_;
    SolverFacts facts_;
    mutable std::shared_ptr<const Scene> last_;  // with uniform steps; may be null
    mutable std::vector<std::shared_ptr<const Scene>> graded_;
};

// Numerics without tolerances, so that nothing is chosen.
Numerics without_tolerance(Numerics numerics);

}  // namespace gearpod::mc
