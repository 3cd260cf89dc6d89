#include "mc/library/run/run.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <exception>
#include <set>

#include "machine/clocks.hpp"
#include "machine/team.hpp"
#include "mc/ensemble/gearbox/simulation.hpp"
#include "mc/ensemble/run_store.hpp"
#include "mc/files/input/problems.hpp"
#include "mc/library/run/command_files.hpp"
#include "mc/library/run/reliability_on_machines.hpp"
#include "mc/library/run/run_preparation.hpp"
#include "mc/numerics/assumption_rows.hpp"
#include "mc/numerics/numerical_error.hpp"
#include "mc/report/run_report.hpp"
#include "mc/report/run_sections.hpp"
#include "mc/results/provenance.hpp"
#include "mc/results/result_rows.hpp"

namespace gearpod::mc {
namespace {

// Signals of the requested rows over a planet turn. A gearbox that failed has none.
std::vector<RowSignals> chosen_signals(const RunOptions& options, const TilePlan& tile) {
    std::vector<RowSignals> all;
    for (const long row : std::set<long>(options.signals.begin(), options.signals.end())) {
        try {
            all.push_back(
                {static_cast<std::size_t>(row),
                 simulate(tile, tile.draw().rows.id_of(row), tile.record.span.planet_teeth)
                     .columns});
        } catch (const std::runtime_error& error) {
            fmt::print(stderr, "--signals {}: {}\n", row, error.what());
        }
    }
    return all;
}

// Work of rank 0 other than computing batches.
class Run {
  public:
    Run(const RunOptions& options, const StudyScene& made, const Ranks& ranks,
        std::unique_ptr<Checkpoint> checkpoint, double setup_s)
        : options_(options),
          tile_(made.scene->tile()),
          planner_(made.planner),
          choice_(made.choice),
          ranks_(ranks),
          ensemble_(made.scene->ensemble()),
          part_(read_part(options.part).value().text()),
          plan_(plan_of(options, ensemble_)),
          checkpoint_(std::move(checkpoint)),
          setup_s_(setup_s) {}

    int run(const Interruption& interruption) {
        warn_of_shortage(ensemble_, options_.study.path);
        if (!options_.quiet) {
            fmt::print(stderr, "running {}: {}\n", options_.study.path, ensemble_.title);
            if (choice_) {
                fmt::print(stderr, "tolerance {:g}: {}\n", choice_->tolerance, choice_->text());
            }
        }
        Progress progress(static_cast<long>(plan_.rows()), options_.quiet, checkpoint_->rows_done(),
                          options_.progress == "json" ? Progress::Form::json : Progress::Form::text,
                          plan_.counted());
        const EnsembleOutcome outcome = run_batches(tile_, ensemble_, plan_,
                                                    {.ranks = ranks_,
                                                     .store = *checkpoint_,
                                                     .progress = progress,
                                                     .interruption = &interruption,
                                                     .checkpoint_s = ensemble_.checkpoint_s,
                                                     .checkpointed = [&] { snapshot(); }});
        progress.finish(outcome.failure.empty() && outcome.interruption.empty());
        return conclude(outcome, interruption);
    }

  private:
    bool prints_results() const { return !options_.quiet && options_.prints_results; }

    // Results without rows.
    Results frame(const RowSource& rows, const std::string& state) const {
        Results results = results_frame(ensemble_);
        results.detection = detect_all(results, rows);
        results.provenance = provenance(ensemble_, ranks_.size(), threads_);
        results.provenance.emplace_back("state", state);
        results.provenance.emplace_back(
            "gearboxes_asked_for", std::to_string(plan_.threshold_gearboxes() + plan_.test_rows()));
        if (!part_.empty()) {
            results.provenance.emplace_back("part", part_);
        }
        if (choice_) {
            results.provenance.emplace_back("numerics_choice", choice_->text());
        }
        return results;
    }

    // Writes the results so far, for users who look at them during the run. Skipped if it would
    // take more than 2 % of the time.
    void snapshot() {
        constexpr double kShare = 0.02;
        if (snapshot_s_ > kShare * seconds_since(last_snapshot_)) {
            return;
        }
        const auto start = WallClock::now();
        while (complete_ < plan_.batches() && checkpoint_->has(complete_)) {
            ++complete_;
        }
        const StoredRows rows(*checkpoint_, plan_, complete_);
        write_results(results_path(options_), frame(rows, "running"), rows);
        last_snapshot_ = WallClock::now();
        snapshot_s_ = seconds_since(start);
    }

    // Computes signals and numerical errors of single gearboxes after all batches; skipped if the
    // run is interrupted.
    void add_examples(Results& all, const RowSource& rows, const Interruption& interruption,
                      EnsembleOutcome& outcome) const {
        try {
            all.signals = chosen_signals(options_, tile_);
            if (part_.empty()) {  // for a part, `merge` computes them
                if (planner_->facts().verified && !options_.quiet) {
                    fmt::print(stderr, "computing some gearboxes again with fine steps\n");
                }
                all.numerical =
                    find_numerical_error(*planner_, &rows, choice_ ? choice_->fine.get() : nullptr);
                all.step_error = find_step_error_of_run(
                    *planner_, plan_.threshold_gearboxes() + plan_.test_rows());
                const auto [variants, pairs] = assumption_pairs(*planner_);
                if (pairs > 0) {
                    Progress again(2L * pairs * static_cast<long>(variants.size()),
                                   options_.quiet || options_.progress == "json", 0,
                                   Progress::Form::text, "gearboxes with changed assumptions");
                    all.assumptions =
                        assumption_rows(*planner_, [&](long count) { again.advance(count); });
                    again.finish();
                }
            }
        } catch (const machine::Cancelled&) {
            const std::string reason = interruption.reason({});
            outcome.interruption = reason.empty() ? "the time limit" : reason;
            all.signals.clear();
        }
    }

    std::string screen_of(const Results& all, const RowSource& rows) const {
        analysis::Report report;
        try {
            report = findings_of_run(all, rows,
                                     reliability_on_machines(all, rows, ranks_,
                                                             threads_of_machine(ensemble_, ranks_)))
                         .report;
        } catch (const machine::Cancelled&) {
            fmt::print(stderr, "the time limit is reached; `gearpod report` shows the results\n");
        }
        std::vector<std::string> end = screen_end(results_path(options_), !part_.empty());
        if (ranks_.machines() > 1) {
            end.push_back(fmt::format("Statistics on {} machines.", ranks_.machines()));
        }
        return screen_text(report, end);
    }

    int conclude(EnsembleOutcome outcome, const Interruption& interruption) {
        const auto start = WallClock::now();
        Results examples;
        const StoredRows rows(*checkpoint_, plan_, outcome.batches);
        if (outcome.failure.empty() && outcome.interruption.empty()) {
            add_examples(examples, rows, interruption, outcome);
        }
        const bool whole = outcome.failure.empty() && outcome.interruption.empty();
        if (!whole) {
            interruption.disable_cancellation();
        }
        threads_ += outcome.threads();
        const std::string path = results_path(options_);
        std::string problem = outcome.failure;
        std::string screen;
        Results all;
        if (problem.empty() && (whole || !options_.merges)) {
            try {
                all = frame(rows, state_of(outcome));
                all.signals = std::move(examples.signals);
                all.numerical = std::move(examples.numerical);
                all.step_error = examples.step_error;
                all.assumptions = std::move(examples.assumptions);
                all.timing = timing_of(outcome);
                all.timing.push_back({"setup_s", setup_s_});
                all.timing.push_back({"output_s", outcome.output_s});
                all.timing.push_back({"evaluation_s", seconds_since(start)});
                write_results(path, all, rows);
                if (whole && prints_results()) {
                    screen = screen_of(all, rows);
                }
            } catch (const std::exception& error) {
                problem = exception_text(error);
            }
        }
        if (!problem.empty()) {
            fmt::print(stderr, "{}\n", problem);
        }
        if (!whole || !problem.empty()) {
            return finish_early(outcome, problem.empty());
        }
        const RowCounts counts = count_rows(rows, plan_.threshold_records());
        checkpoint_->remove();
        fmt::print("{}", screen);
        return counts.failed() == 0 ? kDone : kSomeFailed;
    }

    std::string state_of(const EnsembleOutcome& outcome) const {
        return !outcome.interruption.empty() ? "interrupted by " + outcome.interruption
                                             : "complete";
    }

    // Ends the run early; the checkpoint remains. That of a merge is deleted, because the parts
    // hold all its batches.
    int finish_early(const EnsembleOutcome& outcome, bool saved) {
        if (options_.merges) {
            checkpoint_->remove();
            fmt::print(
                stderr, "{}nothing is merged and the parts are unchanged; repeat `merge`\n",
                outcome.interruption.empty() ? "" : "stopped by " + outcome.interruption + ": ");
            return kBadInput;
        }
        if (!options_.quiet || !saved) {
            print_resume_hint(outcome, plan_, *checkpoint_);
        }
        return kResumable;
    }

    const RunOptions& options_;
    const TilePlan& tile_;
    const std::optional<Planner>& planner_;
    const std::optional<NumericsChoice>& choice_;
    const Ranks& ranks_;
    const EnsemblePlan& ensemble_;
    const std::string part_;  // "" for the whole ensemble
    const BatchPlan plan_;
    std::unique_ptr<Checkpoint> checkpoint_;
    const double setup_s_;
    int threads_ = 0;
    std::size_t complete_ = 0;
    double snapshot_s_ = 0.0;
    WallClock::time_point last_snapshot_ = WallClock::now();
};

void compute_for_leader(const RunOptions& options, const TilePlan& tile,
                        const EnsemblePlan& ensemble, const Ranks& ranks,
                        const Interruption& interruption) {
    const BatchPlan plan = plan_of(options, ensemble);
    MemoryRows nothing(0);
    Progress silent(1, true);
    run_batches(
        tile, ensemble, plan,
        {.ranks = ranks, .store = nothing, .progress = silent, .interruption = &interruption});
}

}  // namespace

void print_resume_hint(const EnsembleOutcome& outcome, const BatchPlan& plan,
                       const Checkpoint& checkpoint) {
    fmt::print(stderr, "{}{} of {} {} are finished and kept in {}; continue with --resume\n",
               outcome.interruption.empty() ? "" : "stopped by " + outcome.interruption + ": ",
               checkpoint.rows_done(), plan.rows(), plan.counted(), checkpoint.path());
}

int run_to_end(const RunOptions& options, const StudyScene& made, const Ranks& ranks,
               std::unique_ptr<Checkpoint> checkpoint, double setup_s,
               const Interruption& interruption) {
    return Run(options, made, ranks, std::move(checkpoint), setup_s).run(interruption);
}

int run_command(const RunOptions& options) {
    const Ranks ranks;
    return run_study(options, ranks);
}

int run_study(const RunOptions& options, const Ranks& ranks) {
    const auto start = WallClock::now();
    std::optional<std::chrono::seconds> limit;
    const bool good_limit = check_time_limit(options, limit);
    const Interruption interruption(limit);
    const StudyScene made = load_scene_on_all_ranks(ranks, options.study, interruption);
    const auto& scene = made.scene;
    const bool too_late = !scene && was_interrupted(made.problems);
    std::unique_ptr<Checkpoint> checkpoint;
    if (ranks.leads()) {
        const bool writable = check_output(options);
        const bool good_progress = check_progress(options);
        if (scene && writable && good_limit && good_progress &&
            check_part(options, scene->ensemble()) && check_signals(options, scene->ensemble()) &&
            check_memory(options, scene->ensemble(), motion_bytes(scene->tile()), ranks)) {
            try {
                checkpoint =
                    open_checkpoint(scene->ensemble(), scene->ensemble().shape,
                                    plan_of(options, scene->ensemble()), results_path(options),
                                    {.resume = options.resume,
                                     .force = options.force,
                                     .quiet = options.quiet,
                                     .part = *read_part(options.part)});
            } catch (const std::exception& error) {
                fmt::print(stderr, "{}\n", error.what());
            }
        }
    }
    const std::string refusal = std::to_string(too_late ? kResumable : kBadInput);
    const std::string order = ranks.from_leader(checkpoint ? "go" : refusal);
    if (order != "go") {
        return std::stoi(order);
    }
    if (!ranks.leads()) {
        compute_for_leader(options, scene->tile(), scene->ensemble(), ranks, interruption);
        return std::stoi(assess_for_leader(scene->ensemble(), ranks));
    }
    const int code =
        run_to_end(options, made, ranks, std::move(checkpoint), seconds_since(start), interruption);
    ranks.from_leader(std::to_string(code));
    return code;
}

}  // namespace gearpod::mc
