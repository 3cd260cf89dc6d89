// Command `sweep STUDY --vary KEY=[...]`: runs a study at every combination of some values and
// compares the results.
#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>

#include "mc/commands/commands.hpp"
#include "mc/commands/lives.hpp"
#include "mc/commands/options/options.hpp"
#include "mc/commands/output_folder.hpp"
#include "mc/ensemble/interruption.hpp"
#include "mc/ensemble/ranks.hpp"
#include "mc/ensemble/run_store.hpp"
#include "mc/files/input/problems.hpp"
#include "mc/files/input/terminal_text.hpp"
#include "mc/library/run/command_files.hpp"
#include "mc/library/run/run.hpp"
#include "mc/library/run/run_preparation.hpp"
#include "mc/lives/campaign.hpp"
#include "mc/plan/planner.hpp"
#include "mc/report/sweep/summaries.hpp"
#include "mc/results/result_rows.hpp"

namespace gearpod::mc {
namespace {

struct SweepOptions {
    StudyOptions study;
    bool lives = false;             // true: run `lives` at every point; false: `run`
    std::vector<std::string> vary;  // "section.key=[a, b, c]"
    std::string out;                // results folder; "": the study's name with -sweep
    std::string json, html;         // "": none; JSON "-": standard output
    bool full = false;              // print all findings
    bool force = false;             // overwrite the results of a different run
    bool quiet = false;
};

namespace fs = std::filesystem;

std::string folder_of(const SweepOptions& options) {
    return options.out.empty() ? fs::path(options.study.path).stem().string() + "-sweep"
                               : options.out;
}

RunOptions run_of(const SweepOptions& options, const SweepPoint& point) {
    RunOptions run;
    run.study = options.study;
    run.study.overrides.insert(run.study.overrides.end(), point.overrides.begin(),
                               point.overrides.end());
    run.out = (fs::path(folder_of(options)) / (point.name + ".h5")).string();
    run.force = options.force;
    run.quiet = options.quiet;
    run.prints_results = false;
    return run;
}

// Adds the reasons why `lives` refuses the study `file`.
void add_lives_problems(const Planner& planner, const std::string& file, Problems& problems) {
    try {
        const StudyLives lives = planner.lives(without_tolerance(planner.facts().numerics));
        std::ranges::move(lives.problems_in(file), std::back_inserter(problems));
    } catch (const SceneError& error) {
        problems.push_back({file, 0, error.key(), error.what(), error.remedy()});
    }
}

// Problems of all points' studies, without duplicates.
Problems problems_of(const SweepOptions& options, const std::vector<VariedKey>& keys,
                     const std::vector<SweepPoint>& points) {
    Problems all;
    std::set<std::string> printed;
    for (const SweepPoint& point : points) {
        const RunOptions run = run_of(options, point);
        StudyReading reading = read_study(run.study.path, run.study.overrides);
        if (options.lives && reading.study) {
            add_lives_problems(Planner(*reading.study), run.study.path, reading.problems);
        }
        for (Problem& problem : reading.problems) {
            for (const VariedKey& key : keys) {
                const bool of_key = (key.key + ".").starts_with(problem.key + ".");
                if (problem.file == "--set" && of_key) {
                    problem.file = "--vary";
                }
            }
            if (printed.insert(format(problem)).second) {
                all.push_back(std::move(problem));
            }
        }
    }
    return all;
}

// Problems with varied keys that only `lives` uses, in a sweep of `run`.
Problems lives_key_problems(const SweepOptions& options, const std::vector<VariedKey>& keys) {
    Problems all;
    for (const VariedKey& key : keys) {
        const bool of_lives = key.key.starts_with("life.") || key.key.starts_with("monitoring.") ||
                              key.key.starts_with("random.life.");
        if (of_lives && !options.lives) {
            all.push_back(
                {"--vary", 0, key.key, "is only used by `lives`, not by `run`", "give --lives"});
        }
    }
    return all;
}

// State of a point's results: none, resumable, or complete.
enum class PointState { nothing, some, all };

PointState point_state(const RunOptions& run, bool lives) {
    const std::string path = results_path(run);
    if (fs::exists(checkpoint_path(path))) {
        return run.force ? PointState::nothing : PointState::some;
    }
    if (!fs::exists(path)) {
        return PointState::nothing;
    }
    try {
        const Results old = read_frame(path);
        const StudyScene made = make_scene(run.study);
        if (!made) {
            return PointState::nothing;  // the run will print the reason
        }
        const bool are_lives = old.provenance_value("kind") == kLivesKind;
        if (are_lives != lives ||
            !why_not_extendable(old, path, made.scene->ensemble(), Part{}).empty()) {
            return PointState::nothing;  // the run will print why it does not overwrite the file
        }
        const BatchPlan plan =
            lives ? lives_plan(made.scene->life().campaign) : plan_of(run, made.scene->ensemble());
        const bool enough = FileRows(path, old).rows() >= plan.rows();
        return enough ? PointState::all : PointState::some;
    } catch (const std::exception&) {
        return PointState::nothing;  // not a results file, or damaged
    }
}

class Sweep {
  public:
    Sweep(const SweepOptions& options, const std::vector<VariedKey>& keys,
          const std::vector<SweepPoint>& points, const Ranks& ranks)
        : options_(options), keys_(keys), points_(points), ranks_(ranks) {}

    int run() {
        for (std::size_t p = 0; p < points_.size(); ++p) {
            const int code = run_point(p);
            if (ranks_.leads() && code == kResumable) {
                fmt::print(stderr, "{} of {} points are finished; repeat the command to continue\n",
                           p, points_.size());
            }
            if (code != kDone && code != kSomeFailed) {
                return code;
            }
        }
        return std::stoi(ranks_.from_leader(ranks_.leads() ? std::to_string(conclude()) : ""));
    }

  private:
    int run_point(std::size_t p) {
        RunOptions run = run_of(options_, points_[p]);
        const PointState there = ranks_.leads() ? point_state(run, options_.lives)
                                                : PointState::nothing;  // rank 0 decides
        const std::string order = ranks_.from_leader(std::to_string(static_cast<int>(there)));
        const auto decided = static_cast<PointState>(std::stoi(order));
        if (ranks_.leads() && !options_.quiet) {
            fmt::print(stderr, "{} of {}, {}: {}\n", p + 1, points_.size(), points_[p].name,
                       decided == PointState::all    ? "finished before"
                       : decided == PointState::some ? "continued"
                                                     : "started");
        }
        if (decided == PointState::all) {
            return kDone;
        }
        run.resume = decided == PointState::some;
        return options_.lives ? lives_study({run, "", ""}, ranks_) : run_study(run, ranks_);
    }

    int conclude() const {
        std::vector<std::string> results;  // files
        for (const SweepPoint& point : points_) {
            results.push_back(results_path(run_of(options_, point)));
        }
        try {
            const auto study = read_study(options_.study.path, options_.study.overrides).study;
            const std::string title = study ? printable(study->title) : "";
            if (options_.lives) {
                const LivesSweep sweep = summarise_lives(title, keys_, points_, results);
                return show(sweep.points, lives_sweep_report(sweep), lives_sweep_json(sweep));
            }
            const RunSweep sweep = summarise_runs(title, keys_, points_, results, thread_count());
            return show(sweep.points, sweep_report(sweep), sweep_json(sweep));
        } catch (const std::exception& error) {
            fmt::print(stderr, "{}\n", exception_text(error));
            return kBadInput;
        }
    }

    // Writes JSON and page if requested, and prints the text. Returns the exit code.
    template <class Points>
    int show(const Points& points, const analysis::Report& report,
             const nlohmann::json& json) const {
        if (!write_json_and_page(json, options_.json, options_.html)) {
            return kBadInput;
        }
        if (options_.json != "-") {
            print_findings(report, options_.full);
            fmt::print("\nresults: {}\n", folder_of(options_));
            if (!options_.html.empty()) {
                fmt::print("page: {}\n", options_.html);
            }
            if (points.size() > 1 && !options_.lives) {
                fmt::print("all differences of two points: gearpod compare {} {}\n",
                           points[0].results, points[1].results);
            }
        }
        return std::ranges::any_of(points, [](const auto& point) { return point.failed > 0; })
                   ? kSomeFailed
                   : kDone;
    }

    const SweepOptions& options_;
    const std::vector<VariedKey>& keys_;
    const std::vector<SweepPoint>& points_;
    const Ranks& ranks_;
};

// Creates the folder if it does not exist. Returns false after printing the problem.
bool make_folder(const std::string& folder) {
    std::error_code error;
    fs::create_directories(folder, error);
    if (!fs::is_directory(folder)) {
        fmt::print(stderr, "--out {}: the folder cannot be created: {}\n", folder,
                   error ? error.message() : "a file has this name");
        return false;
    }
    return true;
}

bool can_write_outputs(const SweepOptions& options, const std::vector<SweepPoint>& points) {
    std::vector<FileRole> others{{"the study", options.study.path}};
    for (const SweepPoint& point : points) {
        others.push_back({"the results of " + point.name, results_path(run_of(options, point))});
    }
    return can_write_json_and_page(options.json, options.html, std::move(others), options.force);
}

int sweep_command(const SweepOptions& options) {
    const Ranks ranks;
    Problems problems;
    const std::vector<VariedKey> keys = read_varied(options.vary, problems);
    for (Problem& problem : lives_key_problems(options, keys)) {
        problems.push_back(std::move(problem));
    }
    std::vector<SweepPoint> points;
    if (problems.empty()) {
        points = grid_of(keys);
        problems = points.empty()
                       ? Problems{{"--vary", 0, "", fmt::format("more than {} points", kMostPoints),
                                   "give fewer values"}}
                       : problems_of(options, keys, points);
    }
    const bool good = !ranks.leads() || (problems.empty() && can_write_outputs(options, points) &&
                                         make_folder(folder_of(options)));
    if (ranks.leads() && !problems.empty()) {
        print_problems(problems);
    }
    if (ranks.from_leader(good ? "go" : "stop") != "go") {
        return kBadInput;
    }
    // A signal between two points stops the next one.
    const Interruption interruption(std::nullopt);
    return Sweep(options, keys, points, ranks).run();
}

}  // namespace

void add_sweep(CLI::App& app, int& code) {
    const auto [command, options] = add_command<SweepOptions>(
        app, code, "sweep",
        "run a study at every combination of some key values, with the same random numbers, and "
        "compare the results; finished points are not computed again",
        sweep_command);
    add_study(command, options.study);
    command
        .add_option("--vary", options.vary,
                    "key to vary and its values, e.g. sensor.noise_m_s2=[0.5,1,2]; repeat the "
                    "option for more keys")
        ->type_name("SECTION.KEY=[A,B,...]")
        ->required()
        ->allow_extra_args(false);
    command.add_flag("--lives", options.lives,
                     "run `lives` instead of `run`: cracks found before tooth failure, warning "
                     "times and false alarms at every combination");
    add_ensemble(command, "number of gearboxes over all fault sizes", options.study);
    add_file(command, "--out", options.out,
             "folder of the results files (default: the study's name with -sweep)");
    add_full(command, options.full);
    add_json(command, options.json);
    add_file(command, "--html", options.html, "write a page with curves to a file");
    command.add_flag("--force", options.force,
                     "overwrite the results of another study or any other file");
    command.add_flag("--quiet", options.quiet, "show no progress");
}

}  // namespace gearpod::mc
