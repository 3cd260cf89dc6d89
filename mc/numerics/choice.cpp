#include "mc/numerics/choice.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "lockstep/integrators/facts.hpp"
#include "mc/numerics/pilot.hpp"
#include "mc/numerics/reference.hpp"
#include "mc/numerics/scatter_choice.hpp"
#include "mc/numerics/solver_families.hpp"

namespace gearpod::mc {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();
// The reference changes by at most this fraction of the tolerance when its steps are halved.
constexpr double kReferenceShare = 0.1;

// Candidates have up to this many times the steps of an integrator's own rule, which aims at 0.1 %.
constexpr double kBeyondOwnRule = 16.0;

// Result of a candidate setting on the pilot.
struct Trial {
    double error = kNever;  // relative, of the worst feature
    int worst = 0;          // index of that feature
    double cost = kNever;   // in rk4 steps per gearbox
    bool was_run = false;   // false: too expensive to be chosen, or invalid for the study
};

class Search {
  public:
    explicit Search(const Study& study)
        : study_(study),
          tolerance_(study.numerics.tolerance),
          own_(with_setting(study, own_setting(study))),
          last_(std::make_unique<const Scene>(own_)),
          pilot_(own_) {
        ReferenceRequest request;
        request.agreement = kReferenceShare * tolerance_;
        request.convergence_tolerance = std::min(1e-10, 1e-3 * tolerance_);
        reference_ = self_converged_reference(study, pilot_, request);
        if (!reference_.reached) {
            refuse_tolerance(request);
        }
    }

    NumericsChoice run() {
        std::vector<SolverFamily> all = solver_families(study_, kBeyondOwnRule);
        std::erase_if(all, [&](const SolverFamily& f) {
            const bool never_chosen = lockstep::facts(*f.common.numerics.integrator).never_chosen;
            return f.size() == 0 || (never_chosen && !study_.numerics.integrator);
        });
        // The least expensive families first: candidates that cost more than the best so far are
        // not tried.
        std::stable_sort(all.begin(), all.end(), [&](const SolverFamily& a, const SolverFamily& b) {
            return cost_of(a) * a.own_steps < cost_of(b) * b.own_steps;
        });
        for (const SolverFamily& family : all) {
            family.graded() ? search_graded(family) : search(family);
        }
        if (!std::isfinite(best_.cost)) {
            throw SceneError(
                "numerics.tolerance",
                fmt::format(
                    "no solver setting keeps the features within {:g} (smallest error: {:.2g})",
                    tolerance_, least_error_),
                "use a larger tolerance, or remove integrator and steps_per_mesh");
        }
        return choice();
    }

  private:
    // Throws SceneError with the reason why the reference does not verify the tolerance.
    [[noreturn]] void refuse_tolerance(const ReferenceRequest& request) const {
        const int finest = reference_.first.numerics.steps_per_mesh;
        if (reference_.agreement.relative.empty()) {
            throw SceneError(
                "numerics.tolerance",
                fmt::format("{:g} cannot be verified: the check would double the {} steps per mesh "
                            "period over {:.0f} mesh periods, more than {:g} steps",
                            tolerance_, finest, reference_.record.tile_meshes,
                            request.most_tile_steps),
                "use numerics.scatter_tolerance, or shorter records (sensor.record_turns)");
        }
        throw SceneError(
            "numerics.tolerance",
            fmt::format("{:g} cannot be verified: with this study's integrator the features "
                        "still change by {:.2g} from {} steps per mesh period to twice as many",
                        tolerance_, reference_.agreement.largest_feature(), finest / 2),
            "use a larger tolerance");
    }

    double cost_of(const SolverFamily& family) const {
        return step_cost(study_, family.common).value();
    }

    Trial trial(const SolverFamily& family, std::size_t step, double convergence) {
        const SolverSetting setting = family.setting(step, convergence);
        const auto known =
            std::ranges::find(trials_, setting, &std::pair<SolverSetting, Trial>::first);
        if (known != trials_.end()) {
            return known->second;
        }
        const Trial result = run(family, setting);
        least_error_ = std::min(least_error_, result.error);
        if (result.error <= tolerance_ && result.cost < best_.cost) {
            best_ = result;
            best_setting_ = setting;
        }
        return trials_.emplace_back(setting, result).second;
    }

    Trial run(const SolverFamily& family, const SolverSetting& setting) {
        const Numerics numerics = with_setting(study_, setting).numerics;
        Trial result;
        try {
            last_ = std::make_unique<const Scene>(last_->with(numerics));
            if (family.graded() && !is_affordable(family, last_->plan().grid.steps.size())) {
                return result;
            }
            const PilotRecord record = pilot_.run(*last_);
            const PilotError error = pilot_error(record, reference_.record);
            result.error = error.largest_feature();
            result.worst = error.worst_feature(reference_.record.levels);
            result.cost = cost_of(family) * record.steps * record.meshes_per_tile();
            result.was_run = true;
        } catch (const SceneError&) {  // invalid for this study: infinite error
        }
        return result;
    }

    // Finds the smallest number of steps that keeps the tolerance, then for it and the next one the
    // loosest convergence tolerance.
    void search(const SolverFamily& family) {
        const std::vector<double>& convergence = convergence_tolerances();
        if (!may_be_cheapest(family, 0)) {
            return;
        }
        const auto keeps = [&](std::size_t step, double tolerance) {
            return trial(family, step, tolerance).error <= tolerance_;
        };
        std::size_t low = 0, high = family.steps.size();
        while (low < high) {
            const std::size_t middle = (low + high) / 2;
            // Candidates more expensive than the best one are not tried; fewer steps may still
            // suffice.
            if (!may_be_cheapest(family, middle) || keeps(middle, convergence.front())) {
                high = middle;
            } else {
                low = middle + 1;
            }
        }
        for (std::size_t step = low; step < std::min(low + 2, family.steps.size()); ++step) {
            if (may_be_cheapest(family, step) && keeps(step, convergence.front())) {
                loosen_convergence(family, step);
            }
        }
    }

    // Finds the loosest convergence tolerance that keeps the tolerance, for steps that keep it.
    void loosen_convergence(const SolverFamily& family, std::size_t step) {
        const std::vector<double>& convergence = convergence_tolerances();
        std::size_t tight = 0, loose = convergence.size();
        while (loose - tight > 1) {
            const std::size_t middle = (tight + loose) / 2;
            (trial(family, step, convergence[middle]).error <= tolerance_ ? tight : loose) = middle;
        }
    }

    // Finds the coarsest graded grid that keeps the tolerance. Every grid costs a pilot, so only
    // grid tolerances near the tolerance are tried. None is tried if the fewest possible steps
    // would already be too expensive.
    void search_graded(const SolverFamily& family) {
        constexpr double kNear = 30.0;
        if (!is_affordable(family,
                           static_cast<std::size_t>(kFewestGradedFraction * family.own_steps))) {
            return;
        }
        for (std::size_t i = 0; i < family.size(); ++i) {
            const double ratio = family.grid_tolerances[i] / tolerance_;
            if (family.size() > 1 && (ratio > kNear || ratio < 1.0 / kNear)) {
                continue;
            }
            const Trial found = trial(family, i, convergence_tolerances().front());
            if (found.error <= tolerance_) {
                loosen_convergence(family, i);
            }
            if (found.error <= tolerance_ || !found.was_run) {
                return;
            }
        }
    }

    // Lower bound of the cost: with the loosest convergence tolerance, at least this many mesh
    // periods are integrated.
    bool may_be_cheapest(const SolverFamily& family, std::size_t step) {
        return is_affordable(family, static_cast<std::size_t>(family.steps[step]));
    }

    bool is_affordable(const SolverFamily& family, std::size_t steps) {
        if (least_meshes_ == 0.0) {
            SolverSetting setting = own_setting(study_);
            setting.numerics.convergence_tolerance = convergence_tolerances().back();
            const Scene loose = own_.with(with_setting(study_, setting).numerics);
            least_meshes_ = pilot_.run(loose).meshes_per_tile();
        }
        return cost_of(family) * static_cast<double>(steps) * least_meshes_ < best_.cost;
    }

    NumericsChoice choice() const {
        NumericsChoice made;
        made.setting = best_setting_;
        made.error = best_.error;
        made.worst_feature = study_.features.use[static_cast<std::size_t>(best_.worst)];
        made.cost = best_.cost;
        made.gearboxes = static_cast<int>(pilot_.size());
        return made;
    }

    const Study& study_;
    const double tolerance_;
    const Scene own_;  // steps by the integrator's own rule
    // Last scene tried: the next one often differs only in its convergence tolerance and shares the
    // plan.
    std::unique_ptr<const Scene> last_;
    const Pilot pilot_;
    Reference reference_;
    std::vector<std::pair<SolverSetting, Trial>> trials_;
    Trial best_;
    SolverSetting best_setting_;
    double least_error_ = kNever, least_meshes_ = 0.0;
};

}  // namespace

ResolvedStudy resolve_numerics(Study study) {
    std::optional<NumericsChoice> choice;
    const double tolerance = study.numerics.tolerance, share = study.numerics.scatter_tolerance;
    if (share > 0.0) {
        choice = choose_by_scatter(study);
    } else if (tolerance > 0.0) {
        choice = Search(study).run();
    }
    if (choice) {
        study.numerics = choice->setting.numerics;
        study.numerics.tolerance = tolerance;
        study.numerics.scatter_tolerance = share;
    }
    return {std::move(study), std::move(choice)};
}

Study without_tolerance(Study study) {
    study.numerics.tolerance = study.numerics.scatter_tolerance = 0.0;
    return study;
}

}  // namespace gearpod::mc
