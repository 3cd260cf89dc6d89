#include "mc/numerics/numerics_choice.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <utility>
#include <vector>

#include "lockstep/integrators/facts.hpp"
#include "lockstep/kernels/kernel_table.hpp"
#include "machine/team.hpp"
#include "mc/ensemble/batch_workers.hpp"
#include "mc/ensemble/ranks.hpp"
#include "mc/files/python/python_worker.hpp"
#include "mc/numerics/pilot.hpp"
#include "mc/numerics/solver_setting.hpp"
#include "mc/plan/mesh_loads.hpp"
#include "mc/study/gears.hpp"
#include "mc/study/sensor_signal.hpp"

namespace gearpod::mc {

std::string NumericsChoice::text() const {
    if (of_scatter && worst_feature.empty()) {
        return setting.text() + " (no fewer steps keep the tolerance)";
    }
    return fmt::format("{} (features within {:.2g}{} on {} pilot gearboxes; the worst is {})",
                       setting.text(), error, of_scatter ? " of their scatter" : "", gearboxes,
                       worst_feature);
}

namespace {

constexpr std::uint64_t kHealthyPilots = 16;
constexpr int kMostTries = 6;   // of a limit of the mass scaling
constexpr int kMostAtOnce = 4;  // candidates integrated together, of which the first may suffice
// Half of normally distributed errors lie within this share of their root mean square.
constexpr double kHalf = 0.6745;

void check_free(const Numerics& n) {
    const auto refuse = [](const char* key, const std::string& what) {
        throw SceneError(key, what, "remove it, or numerics.scatter_tolerance");
    };
    if (n.integrator && !lockstep::facts(*n.integrator).scales_mass) {
        refuse("numerics.integrator",
               fmt::format("numerics.scatter_tolerance chooses steps of {}",
                           lockstep::names_of(&lockstep::IntegratorFacts::scales_mass)));
    }
    if ((n.steps_per_mesh > 0) != (n.mass_scaling_Hz > 0.0)) {
        refuse(n.steps_per_mesh > 0 ? "numerics.steps_per_mesh" : "numerics.mass_scaling_Hz",
               "is chosen by numerics.scatter_tolerance, unless both it and the other of "
               "steps_per_mesh and mass_scaling_Hz are given");
    }
    if (n.tolerance > 0.0) {
        refuse("numerics.tolerance", "chooses the steps, too");
    }
}

// Central differences with the steps of their own rule, without mass scaling.
Numerics unscaled(Numerics numerics) {
    numerics.integrator = lockstep::Integrator::central_difference;
    numerics.scatter_tolerance = numerics.mass_scaling_Hz = 0.0;
    numerics.steps_per_mesh = 0;
    return numerics;
}

class ScatterChoice {
  public:
    ScatterChoice(const Planner& planner, const Numerics& numerics, bool pairs)
        : planner_(planner),
          given_(numerics),
          unscaled_(unscaled(numerics)),
          unscaled_steps_(planner.steps(unscaled_)) {
        for (std::uint64_t i = 0; i < kHealthyPilots; ++i) {
            ids_.push_back({Group::threshold, i});
        }
        const TilePlan tile = planner.tile(unscaled_);
        const EnsemblePlan ensemble = planner.ensemble(unscaled_);
        shape_ = ensemble.shape;
        const auto fine = std::make_shared<FineRows>(FineRows{unscaled_, ids_, {}});
        const int count = pairs ? unscaled_.paired_gearboxes : 0;
        for (const GearboxId& id : paired_gearboxes(tile, ensemble, count)) {
            if (id.group == Group::test || id.index >= kHealthyPilots) {
                fine->ids.push_back(id);
            }
        }
        fine->rows = rows_of_gearboxes(tile, ensemble, fine->ids);
        fine_ = fine;
        threads_ = std::min(thread_count(ensemble), kMostAtOnce);
        for (std::size_t value = 0; value < shape_.features * shape_.levels; ++value) {
            scatter_.push_back(standard_deviation(column(fine_->rows, value)));
        }
    }

    NumericsChoice run() {
        NumericsChoice made;
        made.gearboxes = static_cast<int>(ids_.size());
        made.of_scatter = true;
        made.setting = {unscaled_, {}};
        made.fine = fine_;
        const NumericsChoice without_scaling = made;
        // The first of the candidates that keeps the tolerance. All are integrated at once.
        const auto one_keeps = [&](const std::vector<Numerics>& candidates) {
            const std::vector<Error> errors = errors_of(candidates);
            for (std::size_t i = 0; i < candidates.size(); ++i) {
                made.error = errors[i].error;
                made.worst_feature = planner_.facts().features[errors[i].feature];
                made.setting = {candidates[i], {"mass_scaling_Hz"}};
                if (made.error <= given_.scatter_tolerance) {
                    return true;
                }
            }
            return false;
        };
        if (given_.mass_scaling_Hz > 0.0) {
            if (!one_keeps({without_tolerance(given_)})) {
                throw SceneError("numerics.scatter_tolerance",
                                 fmt::format("the steps given change {} by {:.2g} of its scatter",
                                             made.worst_feature, made.error),
                                 "remove steps_per_mesh and mass_scaling_Hz, so that they are "
                                 "chosen, or use a larger tolerance");
            }
            return made;
        }
        const double fastest_Hz = planner_.fastest_mode_Hz(unscaled_);
        std::vector<Numerics> candidates;  // as many as there are threads, or fewer at the end
        for (int steps = unscaled_steps_.samples; steps < unscaled_steps_.steps;
             steps += unscaled_steps_.samples) {
            if (const auto numerics = scaled_numerics(planner_, unscaled_, fastest_Hz, steps)) {
                candidates.push_back(*numerics);
            }
            const bool last = steps + unscaled_steps_.samples >= unscaled_steps_.steps;
            if ((last || candidates.size() == static_cast<std::size_t>(threads_)) &&
                one_keeps(std::exchange(candidates, {}))) {
                return made;
            }
        }
        return without_scaling;
    }

  private:
    // Values of the pilot gearboxes.
    std::vector<double> column(const BatchRows& rows, std::size_t value) const {
        std::vector<double> values;
        for (std::size_t row = 0; row < ids_.size(); ++row) {
            values.push_back(rows.values[row * shape_.values() + shape_.parameters + value]);
        }
        return values;
    }

    // Largest error over all features and noise levels: the median over the gearboxes, as a root
    // mean square of normally distributed errors, over the scatter. Where a feature jumps, because
    // another tooth has the largest value, a few gearboxes do not decide.
    struct Error {
        double error = 0.0;
        std::size_t feature = 0;
    };
    std::vector<Error> errors_of(const std::vector<Numerics>& candidates) const {
        std::vector<std::pair<TilePlan, EnsemblePlan>> plans;  // a planner serves one thread
        for (const Numerics& numerics : candidates) {
            plans.emplace_back(planner_.tile(numerics), planner_.ensemble(numerics));
        }
        std::vector<Error> errors(candidates.size());
        machine::for_each_index(plans.size(), threads_, [&](std::size_t i) {
            errors[i] = error_of(rows_of_gearboxes(plans[i].first, plans[i].second, ids_));
        });
        return errors;
    }
    Error error_of(const BatchRows& rows) const {
        Error worst;
        for (std::size_t value = 0; value < scatter_.size(); ++value) {
            const std::vector<double> here = column(rows, value),
                                      there = column(fine_->rows, value);
            std::vector<double> errors;
            for (std::size_t i = 0; i < here.size(); ++i) {
                if (std::isfinite(there[i])) {
                    errors.push_back(std::isfinite(here[i]) ? std::abs(here[i] - there[i])
                                                            : INFINITY);
                }
            }
            if (errors.empty() || !(scatter_[value] > 0.0)) {
                continue;
            }
            const auto middle = errors.begin() + static_cast<std::ptrdiff_t>(errors.size() / 2);
            std::ranges::nth_element(errors, middle);
            const double error = *middle / kHalf / scatter_[value];
            if (error > worst.error) {
                worst = {error, value / shape_.levels};
            }
        }
        return worst;
    }

    const Planner& planner_;
    const Numerics given_, unscaled_;
    const PlannedSteps unscaled_steps_;
    RowShape shape_;
    std::vector<GearboxId> ids_;
    std::shared_ptr<const FineRows> fine_;
    int threads_ = 1;
    std::vector<double> scatter_;  // by feature and noise level
};

NumericsChoice choose_by_scatter(const Planner& planner, const Numerics& numerics, bool pairs) {
    check_free(numerics);
    try {
        return ScatterChoice(planner, numerics, pairs).run();
    } catch (const SceneError& error) {
        if (error.key() == "numerics.mass_scaling_Hz" && numerics.mass_scaling_Hz == 0.0) {
            throw SceneError("numerics.scatter_tolerance", error.what(), error.remedy());
        }
        throw;
    }
}

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
    Search(const Planner& planner, const Numerics& numerics)
        : planner_(planner), given_(numerics), tolerance_(numerics.tolerance), pilot_(planner) {
        ReferenceRequest request;
        request.agreement = kReferenceShare * tolerance_;
        request.convergence_tolerance = std::min(1e-10, 1e-3 * tolerance_);
        reference_ = self_converged_reference(pilot_, numerics, request);
        if (!reference_.reached) {
            refuse_tolerance(request);
        }
    }

    NumericsChoice run() {
        std::vector<SolverFamily> all = solver_families(planner_, given_, kBeyondOwnRule);
        std::erase_if(all, [](const SolverFamily& f) { return f.size() == 0; });
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
        return step_cost(planner_.facts(), family.common).value();
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
        planner_.check(setting.numerics, setting.keys());
        Trial result;
        try {
            if (family.graded() && !is_affordable(family, planner_.steps(setting.numerics).steps)) {
                return result;
            }
            const PilotRecord record = pilot_.run(setting.numerics);
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
        if (!is_affordable(family, static_cast<int>(kFewestGradedFraction * family.own_steps))) {
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
        return is_affordable(family, family.steps[step]);
    }

    bool is_affordable(const SolverFamily& family, int steps) {
        if (least_meshes_ == 0.0) {
            SolverSetting loose = own_setting(given_);
            loose.numerics.convergence_tolerance = convergence_tolerances().back();
            planner_.check(loose.numerics, loose.keys());
            least_meshes_ = pilot_.run(loose.numerics).meshes_per_tile();
        }
        return cost_of(family) * steps * least_meshes_ < best_.cost;
    }

    NumericsChoice choice() const {
        NumericsChoice made;
        made.setting = best_setting_;
        made.error = best_.error;
        made.worst_feature = planner_.facts().features[static_cast<std::size_t>(best_.worst)];
        made.cost = best_.cost;
        made.gearboxes = static_cast<int>(pilot_.size());
        return made;
    }

    const Planner& planner_;
    const Numerics given_;
    const double tolerance_;
    const Pilot pilot_;
    Reference reference_;
    std::vector<std::pair<SolverSetting, Trial>> trials_;
    Trial best_;
    SolverSetting best_setting_;
    double least_error_ = kNever, least_meshes_ = 0.0;
};

}  // namespace

std::optional<Numerics> scaled_numerics(const Planner& planner, const Numerics& unscaled,
                                        double fastest_Hz, int steps) {
    Numerics numerics = unscaled;
    numerics.steps_per_mesh = 0;
    double limit_Hz = fastest_Hz;
    for (int i = 0; i < kMostTries && limit_Hz > planner.facts().low_pass_Hz + 1.0; ++i) {
        numerics.mass_scaling_Hz = limit_Hz;
        const double needed = 1.0 / planner.steps(numerics).longest_step;
        if (needed <= steps) {
            numerics.steps_per_mesh = steps;
            numerics.mass_scaling_Hz = std::floor(limit_Hz);
            return numerics;
        }
        limit_Hz *= 0.98 * steps / needed;
    }
    return std::nullopt;
}

ResolvedNumerics resolve_numerics(const Planner& planner, const Numerics& numerics, bool pairs) {
    ResolvedNumerics resolved{numerics, std::nullopt};
    if (numerics.scatter_tolerance > 0.0) {
        resolved.choice = choose_by_scatter(planner, numerics, pairs);
    } else if (numerics.tolerance > 0.0) {
        resolved.choice = Search(planner, numerics).run();
    }
    if (resolved.choice) {
        resolved.choice->tolerance =
            resolved.choice->of_scatter ? numerics.scatter_tolerance : numerics.tolerance;
        resolved.numerics = resolved.choice->setting.numerics;
        resolved.numerics.tolerance = numerics.tolerance;
        resolved.numerics.scatter_tolerance = numerics.scatter_tolerance;
        if (numerics.lanes == full_lanes(numerics.precision)) {
            resolved.numerics.lanes = full_lanes(resolved.numerics.precision);
        }
    }
    return resolved;
}

Scene resolved_plan(const Study& study) {
    const Planner planner(study);
    return planner.scene(resolve_numerics(planner, study.numerics).numerics);
}

namespace {

StudyScene refused(Problems problems) {
    StudyScene none;
    none.problems = std::move(problems);
    return none;
}

// Chooses the numerics of neighbouring stages that leave them to a tolerance, at their speed here.
void choose_numerics_of_stages(Study& study) {
    const std::vector<Study> studies = stage_studies(study);
    for (std::size_t i = 0; i < studies.size(); ++i) {
        NeighbourStage& stage = study.sensor.stages[i];
        Study resolved = *stage.study;
        resolved.numerics = resolve_numerics(Planner(studies[i]), studies[i].numerics).numerics;
        stage.text = resolved_text(resolved);
        stage.study = std::make_shared<const Study>(std::move(resolved));
    }
}

}  // namespace

StudyScene make_scene(const std::string& name, StudyReading reading, Choosing choosing) {
    if (!reading.study) {
        return refused(std::move(reading.problems));
    }
    if (choosing == Choosing::nothing) {
        reading.study->numerics = without_tolerance(reading.study->numerics);
    }
    if (!has_gears(*reading.study)) {
        return refused({{name, 0, "gearbox.sun.teeth",
                         "no tooth numbers or no module (only the commands modes and describe work "
                         "without them)",
                         "give the teeth of sun, planet and ring, and module_mm"}});
    }
    try {
        lockstep::choose_instruction_set(reading.study->numerics.instruction_set);
    } catch (const std::invalid_argument& error) {
        return refused({{name, 0, "numerics.instruction_set", error.what(), "use auto"}});
    }
    try {
        lockstep::check_lanes(reading.study->numerics.precision, reading.study->numerics.lanes);
    } catch (const lockstep::MissingKernel& error) {
        return refused({{name, 0, "numerics.lanes", error.what(),
                         "remove it, or build with all kernels (preset portable)"}});
    }
    try {
        const Numerics& numerics = reading.study->numerics;
        if (is_coupled(*reading.study) &&
            (numerics.tolerance > 0.0 || numerics.scatter_tolerance > 0.0)) {
            throw SceneError(
                numerics.tolerance > 0.0 ? "numerics.tolerance" : "numerics.scatter_tolerance",
                "cannot choose the numerics of stages that elastic shafts couple",
                "give numerics.integrator = \"central-difference\", precision = "
                "\"double\" and, if needed, steps_per_mesh");
        }
        choose_numerics_of_stages(*reading.study);
        const Planner planner(*reading.study);
        ResolvedNumerics resolved =
            resolve_numerics(planner, numerics, choosing == Choosing::numerics_with_pairs);
        StudyScene made{std::make_unique<const Scene>(planner.scene(resolved.numerics)),
                        std::move(resolved.choice),
                        {},
                        std::move(reading.notices),
                        planner.with(resolved.numerics)};
        check_stages(*reading.study, *made.scene);
        for (Problems& more :
             std::array{stage_notices(*reading.study, name), load_warnings(*reading.study, name)}) {
            std::ranges::move(more, std::back_inserter(made.notices));
        }
        return made;
    } catch (const SceneError& error) {
        return refused({{name, 0, error.key(), error.what(), error.remedy(), error.kind()}});
    } catch (const PythonError& error) {
        return refused({{name, 0, "features.python", error.what(), ""}});
    }
}

}  // namespace gearpod::mc
