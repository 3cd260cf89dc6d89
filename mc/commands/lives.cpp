// Command `lives STUDY`: gearboxes that are measured repeatedly while a crack grows.
#include "mc/commands/lives.hpp"

#include <fmt/format.h>

#include <chrono>
#include <exception>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>

#include "analysis/report/json_values.hpp"
#include "mc/commands/commands.hpp"
#include "mc/commands/options/options.hpp"
#include "mc/commands/output_folder.hpp"
#include "mc/ensemble/run_store.hpp"
#include "mc/files/atomic_file.hpp"
#include "mc/files/input/problems.hpp"
#include "mc/library/run/command_files.hpp"
#include "mc/library/run/run.hpp"
#include "mc/library/run/run_preparation.hpp"
#include "mc/lives/campaign.hpp"
#include "mc/lives/interpolation.hpp"
#include "mc/plan/study_facts.hpp"
#include "mc/report/lives_report.hpp"
#include "mc/report/page.hpp"
#include "mc/report/run_report.hpp"
#include "mc/report/run_sections.hpp"
#include "mc/results/provenance.hpp"
#include "mc/results/result_rows.hpp"

namespace gearpod::mc {
namespace {

// The JSON of lives with the definitions of the features, the fault and the provenance.
nlohmann::json with_origin(nlohmann::json json, const CampaignPlan& plan, const Results& frame) {
    for (const features::Feature* feature : plan.ensemble.features) {
        json["features"].push_back(definition_json(feature->name, feature->unit, feature->alarm));
    }
    const auto facts = run_facts(frame.provenance_value("study"));
    json["fault"] = facts ? analysis::text_or_null(facts->fault.words) : nullptr;
    json["provenance"] = nlohmann::json(
        std::map<std::string, std::string>(frame.provenance.begin(), frame.provenance.end()));
    return json;
}

// Evaluates the rows and writes the requested outputs. Returns kBadInput after printing a problem,
// or if the results are withheld.
int write_outputs(const CampaignPlan& plan, const Results& frame, const RowSource& rows,
                  const ReportOptions& outputs, bool prints_text = true) {
    const Campaign campaign = campaign_of(plan, frame, rows);
    const LifeMonitor monitor(plan, campaign);
    if (!outputs.json.empty() || !outputs.html.empty() || !outputs.figures.empty() ||
        !outputs.evidence.empty()) {
        const auto json = lives_json(monitor, outputs.shows_withheld);
        if (!outputs.evidence.empty()) {
            const OutputFolder folder{
                {"--evidence", outputs.evidence},
                evidence_files(with_origin(json, plan, frame), outputs.results)};
            if (!can_write_folders({folder},
                                   {{"the results file", outputs.results},
                                    {"--json", outputs.json},
                                    {"--html", outputs.html}},
                                   outputs.force)) {
                return kBadInput;
            }
            write_files(folder);
        }
        if (!write_json_and_page(json, outputs.json, outputs.html, outputs.figures)) {
            return kBadInput;
        }
    }
    const std::string withheld = outputs.shows_withheld ? "" : why_withheld(plan, campaign);
    if (!prints_text && !withheld.empty()) {
        fmt::print(stderr, "{}\n", withheld);
    }
    if (prints_text && outputs.json != "-") {
        if (!print_report(outputs, lives_report(monitor, outputs.shows_withheld), false)) {
            return kBadInput;
        }
        print_written("page", outputs.html);
        print_written("evidence", outputs.evidence);
    }
    return withheld.empty() ? kDone : kBadInput;
}

// Rank 0's part of the run, after the checks. Returns the exit code.
int run_lives_on_leader(const LivesOptions& options, const LifeTiles& tiles,
                        double interpolation_error, const Ranks& ranks, Checkpoint& checkpoint,
                        const Interruption& interruption) {
    const RunOptions& run = options.run;
    const CampaignPlan& campaign = tiles.plan().campaign;
    const BatchPlan plan = lives_plan(campaign);
    Progress progress(static_cast<long>(plan.rows()), run.quiet, checkpoint.rows_done(),
                      run.progress == "json" ? Progress::Form::json : Progress::Form::text);
    const EnsembleOutcome outcome = run_lives(tiles, plan,
                                              {.ranks = ranks,
                                               .store = checkpoint,
                                               .progress = progress,
                                               .interruption = &interruption,
                                               .checkpoint_s = campaign.ensemble.checkpoint_s});
    std::string trouble = outcome.failure;
    const bool complete = trouble.empty() && outcome.interruption.empty();
    progress.finish(complete);
    if (complete) {
        interruption.disable_cancellation();
        try {
            Results frame = lives_frame(campaign);
            for (const auto& entry :
                 provenance(campaign.ensemble, ranks.size(), outcome.threads())) {
                frame.provenance.push_back(entry);
            }
            frame.provenance.emplace_back("state", "complete");
            store_run_costs(tiles.plan(), interpolation_error, outcome, frame);
            const StoredRows rows(checkpoint, plan, outcome.batches);
            const std::string path = results_path(run);
            write_results(path, frame, rows);
            int code = count_rows(rows, 1).failed() > 0 ? kSomeFailed : kDone;
            if (run.prints_results) {
                ReportOptions outputs;
                outputs.results = path;
                outputs.full = options.full;
                outputs.json = options.json;
                outputs.html = options.html;
                outputs.shows_withheld = options.shows_withheld;
                const int written = write_outputs(campaign, frame, rows, outputs, !run.quiet);
                code = written == kDone ? code : written;
                if (options.full && !run.quiet && options.json != "-") {
                    fmt::print("\nresults: {}\n", path);
                }
            }
            checkpoint.remove();
            return code;
        } catch (const std::exception& error) {
            trouble = exception_text(error);
        }
    }
    if (!trouble.empty()) {
        fmt::print(stderr, "{}\n", trouble);
    }
    if (!run.quiet || !trouble.empty()) {
        print_resume_hint(outcome, plan, checkpoint);
    }
    return kResumable;
}

// Chooses the numbers of torques and speeds at which gearboxes are integrated. A study without
// possible lives loses its scene and gets all problems.
std::optional<InterpolationChoice> prepare_lives(const RunOptions& run, StudyScene& made) {
    made.problems = made.scene->lives().problems_in(run.study.path);
    if (made.problems.empty()) {
        try {
            return choose_interpolation(made.scene->tile(), made.scene->life());
        } catch (const SceneError& error) {
            made.problems.push_back({run.study.path, 0, error.key(), error.what(), error.remedy()});
        } catch (const std::exception& error) {
            made.problems.push_back({run.study.path, 0, "", exception_text(error), ""});
        }
    }
    made.scene.reset();
    return {};
}

std::unique_ptr<Checkpoint> lives_checkpoint(const RunOptions& run, const CampaignPlan& plan) {
    try {
        return open_checkpoint(
            plan.ensemble, row_shape(lives_frame(plan)), lives_plan(plan), results_path(run),
            {.resume = run.resume, .force = run.force, .quiet = run.quiet, .check = check_lives});
    } catch (const std::exception& error) {
        fmt::print(stderr, "{}\n", error.what());
    }
    return nullptr;
}

}  // namespace

void add_lives(CLI::App& app, int& code) {
    const auto [command, options] = add_command<LivesOptions>(
        app, code, "lives",
        "simulate gearboxes that are measured repeatedly while a crack grows, and report the "
        "cracks found in time, the warning time and the false alarms",
        [](const LivesOptions& lives) { return lives_study(lives, Ranks()); });
    RunOptions& run = options.run;
    add_study(command, run.study);
    add_ensemble(command, "number of gearboxes with a growing crack", run.study);
    add_results(command, run,
                "continue an interrupted run, or add cracked gearboxes to a finished one",
                "overwrite the results of another study or any other file");
    add_progress(command, run);
    add_full(command, options.full);
    add_json(command, options.json);
    add_page(command, options.html);
    command.add_flag("--show-withheld", options.shows_withheld,
                     "report lives although their signals are interpolated too coarsely");
    command.add_flag("--quiet", run.quiet, "print problems only");
}

int lives_study(const LivesOptions& options, const Ranks& ranks) {
    const RunOptions& run = options.run;
    std::optional<std::chrono::seconds> limit;
    const bool good_limit = check_time_limit(run, limit);
    const Interruption interruption(limit);
    std::optional<InterpolationChoice> choice;
    const StudyScene made =
        load_scene_on_all_ranks(ranks, run.study, interruption, [&](StudyScene& scene) {
            const auto& ignored = scene.scene->lives().ignored;
            if (ranks.leads() && !ignored.empty()) {
                fmt::print(stderr, "{}: `lives` ignores keys that only `run` uses: {}\n",
                           run.study.path, fmt::join(ignored, ", "));
            }
            choice = prepare_lives(run, scene);
        });
    std::unique_ptr<LifeTiles> tiles;
    if (made) {
        tiles = std::make_unique<LifeTiles>(
            made.scene->tile(), made.planner->life(choice->plan.torques, choice->plan.speeds));
    }
    std::unique_ptr<Checkpoint> checkpoint;
    if (ranks.leads()) {
        const bool good_outputs = can_write_json_and_page(
            options.json, options.html,
            {{"the study", run.study.path}, {"--out", results_path(run)}}, run.force);
        const bool good_out = check_output(run), good_progress = check_progress(run);
        if (tiles && good_limit && good_outputs && good_out && good_progress) {
            checkpoint = lives_checkpoint(run, tiles->plan().campaign);
        }
    }
    const std::string refusal =
        std::to_string(!made && was_interrupted(made.problems) ? kResumable : kBadInput);
    const std::string order = ranks.from_leader(checkpoint ? "go" : refusal);
    if (order != "go") {
        return std::stoi(order);
    }
    if (!ranks.leads()) {
        MemoryRows nothing(0);
        Progress silent(1, true);
        run_lives(
            *tiles, lives_plan(tiles->plan().campaign),
            {.ranks = ranks, .store = nothing, .progress = silent, .interruption = &interruption});
        return std::stoi(ranks.from_leader(""));
    }
    const int code =
        run_lives_on_leader(options, *tiles, choice->error, ranks, *checkpoint, interruption);
    ranks.from_leader(std::to_string(code));
    return code;
}

int report_lives(const ReportOptions& options) {
    if (!options.csv.empty() || !options.pdf.empty() || !options.condition.empty()) {
        fmt::print(stderr,
                   "{}: holds lives; --csv, --pdf and --by are only for results of "
                   "`run`, omit them\n",
                   options.results);
        return kBadInput;
    }
    const Results frame = read_frame(options.results);
    const FileRows rows(options.results, frame);
    return write_outputs(check_lives(options.results, frame, rows), frame, rows, options);
}

}  // namespace gearpod::mc
