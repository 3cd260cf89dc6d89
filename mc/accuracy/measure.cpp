// measure_accuracy(): measures time and error of the solver settings.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>

#include "lockstep/integrators/facts.hpp"
#include "machine/upper_median.hpp"
#include "mc/accuracy/listing.hpp"
#include "mc/accuracy/measure_detection.hpp"
#include "mc/accuracy/report.hpp"
#include "mc/accuracy/rung_scenes.hpp"
#include "mc/accuracy/time_left.hpp"
#include "mc/gearbox/mesh_time.hpp"
#include "mc/numerics/choice.hpp"
#include "mc/numerics/ladder.hpp"

namespace gearpod::mc {
namespace {

// Settings slower than equally accurate ones by more than this factor are timed only once.
constexpr double kNearFrontier = 3.0;
// Settings within this factor of the fastest for a tolerance are timed more often.
constexpr double kContender = 1.5;
constexpr int kContenderRepeats = 10;
// Fraction of the processor time for the reference.
constexpr double kReferenceShare = 1.0 / 3.0;
// Stiffness tolerances tried with the fastest setting for each tolerance.
constexpr double kStiffnessTolerances[] = {1e-8, 1e-6, 1e-5, 1e-4, 1e-3};

class Measurement {
  public:
    Measurement(const Study& study, const AccuracyRequest& request)
        : study_(plain(study)),
          request_(request),
          time_(request.seconds),
          scenes_(study_),
          pilot_(scenes_.own()) {
        const Scene& scene = scenes_.own();
        report_.features = study_.features.use;
        report_.noise_levels = study_.sensor.noise_levels;
        report_.gearboxes = static_cast<int>(pilot_.size());
        report_.signal_meshes = std::clamp(scene.pattern().length, 1, kMostSignalMeshes);
        report_.span_meshes = scene.span_meshes();
        report_.mesh_frequency_Hz = scene.nominal_mesh_frequency_Hz();
        report_.explicit_limit.steps = scene.explicit_steps();
    }

    AccuracyReport run() {
        request_.progress("reference: refining two methods until they agree");
        ReferenceRequest reference;
        reference.seconds = kReferenceShare * time_.seconds();
        report_.reference = converged_reference(study_, pilot_, reference);
        report_.own = 0;
        for (const ListedRung& listed : listed_rungs(study_)) {
            add(listed.rung, listed.refusal);
        }
        times_.resize(report_.rungs.size());
        request_.progress(fmt::format("{} solver settings", report_.rungs.size()));
        march_first(0);
        finish_times();
        for (const double tolerance : request_.tolerances) {
            choose(tolerance);
        }
        settle_loosely();
        for (int repeat = 1; repeat < request_.repeats; ++repeat) {
            finish_times();
            request_.progress(fmt::format("timing {} of {}", repeat + 1, request_.repeats));
            if (!march_again()) {
                leave_out(fmt::format("all but {} of {} timings", repeat, request_.repeats));
                break;
            }
        }
        thin_stiffness();
        time_contenders();
        finish_times();
        for (ChoiceCheck& check : report_.choices) {
            compare(check);
        }
        mark_frontier();
        measure_explicit_limit();
        check_step_costs();
        measure_detection(study_, request_, time_, report_);
        return std::move(report_);
    }

  private:
    static Study plain(Study study) {
        study.numerics.tolerance = 0.0;
        return study;
    }
    void add(const Rung& rung, const std::string& refusal = "") {
        report_.rungs.emplace_back();
        report_.rungs.back().rung = rung;
        report_.rungs.back().refusal = refusal;
    }

    // Measures the fastest settings again with fewer terms in the stiffness curves.
    void thin_stiffness() {
        if (!time_.enough()) {
            return leave_out("settings with shorter stiffness series");
        }
        finish_times();
        std::vector<Rung> fastest_rungs;
        for (const ChoiceCheck& check : report_.choices) {
            const double best = fastest(check.tolerance);
            const auto known = [&](const Rung& rung) {
                return std::any_of(fastest_rungs.begin(), fastest_rungs.end(),
                                   [&](const Rung& r) { return r.text() == rung.text(); });
            };
            for (const RungResult& result : report_.rungs) {
                if (holds(result, check.tolerance) && result.march_s == best &&
                    !known(result.rung)) {
                    fastest_rungs.push_back(result.rung);
                }
            }
        }
        const std::size_t first = report_.rungs.size();
        for (const Rung& rung : fastest_rungs) {
            for (const double tolerance : kStiffnessTolerances) {
                Rung thin = rung;
                thin.other.push_back(fmt::format("numerics.stiffness_tolerance={:g}", tolerance));
                add(thin);
            }
        }
        times_.resize(report_.rungs.size());
        request_.progress(
            fmt::format("{} settings with shorter stiffness series", report_.rungs.size() - first));
        march_first(first);
    }

    // Measures looser convergence tolerances; settings with the same steps use one scene in turn.
    void settle_loosely() {
        if (!time_.enough()) {
            return leave_out("settings with a looser settle_tolerance");
        }
        finish_times();
        std::vector<Rung> loose;
        for (const RungResult& result : report_.rungs) {
            if (!result.refusal.empty() || !near_frontier(result) ||
                result.rung.settle_tolerance != settle_tolerances().front() ||
                result.rung.integrator == "auto" || marches_everything(result.rung)) {
                continue;
            }
            for (std::size_t i = 1; i < settle_tolerances().size(); ++i) {
                loose.push_back(result.rung);
                loose.back().settle_tolerance = settle_tolerances()[i];
            }
        }
        const std::size_t first = report_.rungs.size();
        for (const Rung& rung : loose) {
            if (place_of(rung, report_.rungs) == report_.rungs.size()) {
                add(rung);
            }
        }
        times_.resize(report_.rungs.size());
        request_.progress(fmt::format("{} settings with a looser settle_tolerance",
                                      report_.rungs.size() - first));
        march_first(first);
    }

    bool near_frontier(const RungResult& result) const {
        return std::none_of(
            report_.rungs.begin(), report_.rungs.end(), [&](const RungResult& other) {
                return other.steps > 0 &&
                       other.error.largest_feature() <= result.error.largest_feature() &&
                       kNearFrontier * other.march_s < result.march_s;
            });
    }

    void leave_out(const std::string& what) { report_.left_out.push_back(what); }

    // Lower bound of the processor time of a setting, s; only known where every mesh period is
    // integrated.
    double least_s(const Rung& rung) const {
        const RungResult& own = report_.rungs[0];
        return marches_everything(rung) && own.meshes > 0.0 && !times_[0].march.empty()
                   ? times_[0].march.front() * report_.gearboxes * report_.span_meshes / own.meshes
                   : 0.0;
    }

    void march_first(std::size_t from) {
        int untried = 0;
        for (const std::size_t i : cheapest_first(study_, report_.rungs, from)) {
            RungResult& result = report_.rungs[i];
            if (i > 0 && result.refusal.empty() && !time_.enough(least_s(result.rung))) {
                result.refusal = kNotTried;
                ++untried;
                continue;
            }
            march(i, true);
        }
        if (untried > 0) {
            leave_out(fmt::format("{} solver settings", untried));
        }
    }

    // Times the settings again; false if the time ran out.
    bool march_again() {
        for (std::size_t i = 0; i < report_.rungs.size(); ++i) {
            if (!time_.enough()) {
                return false;
            }
            if (near_frontier(report_.rungs[i])) {
                march(i, false);
            }
        }
        return true;
    }

    void march(std::size_t place, bool first) {
        RungResult& result = report_.rungs[place];
        if (!result.refusal.empty() || (marches_everything(result.rung) && !first)) {
            return;
        }
        try {
            const PilotRecord record = pilot_.run(scenes_.of(result.rung));
            times_[place].march.push_back(record.march_s);
            times_[place].total.push_back(record.total_s);
            if (first) {
                fill(record, result);
            }
        } catch (const SceneError& error) {
            result.refusal = error.what();
        }
    }

    void fill(const PilotRecord& record, RungResult& result) const {
        result.steps = record.steps;
        result.meshes = record.meshes_per_tile();
        result.failed = static_cast<double>(std::count(record.ok.begin(), record.ok.end(), false));
        result.error = pilot_error(record, report_.reference.record);
        // The study's own setting may have the integrator "auto".
        const std::string integrator = result.rung.integrator == "auto"
                                           ? std::string(lockstep::name(own_integrator_))
                                           : result.rung.integrator;
        result.cost = step_cost(study_, integrator, result.rung.other).value_or(0.0) *
                      result.steps * result.meshes;
    }

    bool holds(const RungResult& result, double tolerance) const {
        return result.refusal.empty() && result.steps > 0 &&
               result.error.largest_feature() <= tolerance;
    }

    // Finds the setting that numerics.tolerance chooses, and measures it if it is new.
    void choose(double tolerance) {
        request_.progress(fmt::format("choice for a tolerance of {:g}", tolerance));
        ChoiceCheck check;
        check.tolerance = tolerance;
        if (!time_.enough()) {
            check.refusal = "not tried: the time had run out";
            leave_out(fmt::format("the choice for numerics.tolerance = {:g}", tolerance));
            report_.choices.push_back(check);
            return;
        }
        Study study = without_steps(study_);
        study.numerics.tolerance = tolerance;
        try {
            const Rung rung = resolve_numerics(study).choice->rung;
            const std::size_t place = place_of(rung, report_.rungs);
            check.chosen = static_cast<int>(place);
            if (place == report_.rungs.size()) {
                add(rung);
                times_.emplace_back();
                march(place, true);
            }
        } catch (const SceneError& error) {
            check.refusal = error.what();
        }
        report_.choices.push_back(check);
    }

    // Times the contenders alternately, so that other load slows all of them equally.
    void time_contenders() {
        finish_times();
        std::vector<std::size_t> contenders;
        for (const ChoiceCheck& check : report_.choices) {
            const double best = fastest(check.tolerance);
            for (std::size_t i = 0; i < report_.rungs.size(); ++i) {
                if ((holds(report_.rungs[i], check.tolerance) &&
                     report_.rungs[i].march_s < kContender * best) ||
                    static_cast<int>(i) == check.chosen) {
                    contenders.push_back(i);
                }
            }
        }
        std::sort(contenders.begin(), contenders.end());
        contenders.erase(std::unique(contenders.begin(), contenders.end()), contenders.end());
        request_.progress(fmt::format("the {} fastest settings again", contenders.size()));
        for (int repeat = 0; repeat < kContenderRepeats; ++repeat) {
            for (const std::size_t place : contenders) {
                if (!time_.enough()) {
                    leave_out(fmt::format("all but {} of {} timings of the fastest settings",
                                          repeat, kContenderRepeats));
                    return;
                }
                march(place, false);
            }
        }
    }

    double fastest(double tolerance) const {
        double best = INFINITY;
        for (const RungResult& result : report_.rungs) {
            best = holds(result, tolerance) ? std::min(best, result.march_s) : best;
        }
        return best;
    }

    void finish_times() {
        for (std::size_t i = 0; i < report_.rungs.size(); ++i) {
            RungResult& result = report_.rungs[i];
            if (times_[i].march.empty()) {
                continue;
            }
            result.march_s = *std::min_element(times_[i].march.begin(), times_[i].march.end());
            result.march_median_s = machine::upper_median(times_[i].march);
            result.total_s = *std::min_element(times_[i].total.begin(), times_[i].total.end());
            result.mesh_s = result.march_s / result.meshes;
        }
    }

    void compare(ChoiceCheck& check) const {
        const double best = fastest(check.tolerance);
        for (std::size_t i = 0; i < report_.rungs.size(); ++i) {
            if (holds(report_.rungs[i], check.tolerance) && report_.rungs[i].march_s == best) {
                check.best = static_cast<int>(i);
            }
        }
        if (check.chosen >= 0 && check.best >= 0) {
            check.over_best =
                report_.rungs[static_cast<std::size_t>(check.chosen)].march_s / best - 1.0;
        }
    }

    void mark_frontier() {
        std::vector<RungResult*> marched;
        for (RungResult& result : report_.rungs) {
            if (result.refusal.empty() && std::isfinite(result.error.largest_feature())) {
                marched.push_back(&result);
            }
        }
        std::sort(marched.begin(), marched.end(),
                  [](const auto* a, const auto* b) { return a->march_s < b->march_s; });
        double least = INFINITY;
        for (RungResult* result : marched) {
            result->frontier = result->error.largest_feature() < least;
            least = std::min(least, result->error.largest_feature());
        }
    }

    void measure_explicit_limit() {
        ExplicitLimit& limit = report_.explicit_limit;
        limit.step_s = explicit_step_s(scenes_.of(own_rung(study_)));
        limit.meshes = report_.rungs[0].meshes;
        limit.refused = std::none_of(report_.rungs.begin(), report_.rungs.end(), [](const auto& r) {
            return r.rung.integrator == "rk4" && r.refusal.empty();
        });
    }

    // Compares the measured time of a step relative to rk4's with the cost model's table.
    void check_step_costs() {
        std::map<std::string, std::vector<double>> measured;
        for (const RungResult& result : report_.rungs) {
            if (result.steps > 0 && result.rung.integrator != "auto" && result.rung.other.empty()) {
                measured[result.rung.integrator].push_back(result.mesh_s / result.steps);
            }
        }
        for (auto& [integrator, steps] : measured) {
            const auto known = step_cost(study_, integrator, {});
            report_.step_costs.push_back(
                fmt::format("{}: {:.1f} measured, {} in the table", integrator,
                            machine::upper_median(steps) / report_.explicit_limit.step_s,
                            known ? fmt::format("{:.1f}", *known) : "none"));
        }
    }

    struct Times {
        std::vector<double> march, total;
    };
    const Study study_;
    const AccuracyRequest& request_;
    const TimeLeft time_;
    RungScenes scenes_;
    const lockstep::Integrator own_integrator_ = scenes_.own().plan().integrator;
    const Pilot pilot_;
    AccuracyReport report_;
    std::vector<Times> times_;
};

}  // namespace

AccuracyReport measure_accuracy(const Study& study, const AccuracyRequest& request) {
    return Measurement(study, request).run();
}

}  // namespace gearpod::mc
