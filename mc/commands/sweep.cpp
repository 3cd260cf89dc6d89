// sweep STUDY --vary KEY=[...]: a study at every combination of some values, side by side.
#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>

#include "mc/commands/run_checks.hpp"
#include "mc/commands/run_to_end.hpp"
#include "mc/commands/support.hpp"
#include "mc/ensemble/run_store.hpp"
#include "mc/ensemble/thread_count.hpp"
#include "mc/files/json_text.hpp"
#include "mc/input/exception_text.hpp"
#include "mc/input/printable.hpp"
#include "mc/report/page.hpp"
#include "mc/results/file_rows.hpp"
#include "mc/sweep/summary.hpp"

namespace gearpod::mc {
namespace {

namespace fs = std::filesystem;

std::string folder_of(const SweepOptions& options) {
    return options.out.empty() ? fs::path(options.study.path).stem().string() + "-sweep"
                               : options.out;
}

// The run of a point.
RunOptions run_of(const SweepOptions& options, const SweepPoint& point) {
    RunOptions run;
    run.study = options.study;
    run.study.overrides.insert(run.study.overrides.end(), point.overrides.begin(),
                               point.overrides.end());
    run.out = (fs::path(folder_of(options)) / (point.name + ".h5")).string();
    run.force = options.force;
    run.quiet = options.quiet;
    run.says_results = false;
    return run;
}

// Of all points, each said once.
Problems problems_of(const SweepOptions& options, const std::vector<VariedKey>& keys,
                     const std::vector<SweepPoint>& points) {
    Problems all;
    std::set<std::string> said;
    for (const SweepPoint& point : points) {
        const RunOptions run = run_of(options, point);
        for (Problem& problem : read_study(run.study.path, run.study.overrides).problems) {
            for (const VariedKey& key : keys) {
                const bool of_key = (key.key + ".").starts_with(problem.key + ".");
                if (problem.file == "--set" && of_key) {
                    problem.file = "--vary";
                }
            }
            if (said.insert(format(problem)).second) {
                all.push_back(std::move(problem));
            }
        }
    }
    return all;
}

// What is there of a point: nothing, something to go on from, or all.
enum class Progressed { nothing, some, all };

Progressed progressed(const RunOptions& run) {
    const std::string path = results_path(run);
    if (fs::exists(checkpoint_path(path))) {
        return run.force ? Progressed::nothing : Progressed::some;
    }
    if (!fs::exists(path)) {
        return Progressed::nothing;
    }
    try {
        const Results old = read_frame(path);
        const StudyScene made = make_scene(run.study);
        const Study& study = made.scene->study();
        if (!why_not_grown(old, path, study, Part{}).empty()) {
            return Progressed::nothing;  // the run says why it does not overwrite it
        }
        const bool enough = FileRows(path, old).rows() >= plan_of(run, study).rows() ||
                            old.provenance_value("state") == "ended by ensemble.until";
        return enough ? Progressed::all : Progressed::some;
    } catch (const std::exception&) {
        return Progressed::nothing;  // no results, or damaged ones
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
            if (code != kDone && code != kSomeFailed) {
                return stopped(p, code);
            }
        }
        return std::stoi(ranks_.from_leader(ranks_.leads() ? std::to_string(conclude()) : ""));
    }

  private:
    int run_point(std::size_t p) {
        RunOptions run = run_of(options_, points_[p]);
        const Progressed there =
            ranks_.leads() ? progressed(run) : Progressed::nothing;  // the leader's counts
        const std::string order = ranks_.from_leader(std::to_string(static_cast<int>(there)));
        const auto decided = static_cast<Progressed>(std::stoi(order));
        if (ranks_.leads() && !options_.quiet) {
            fmt::print(stderr, "{} of {}, {}: {}\n", p + 1, points_.size(), points_[p].name,
                       decided == Progressed::all    ? "is finished"
                       : decided == Progressed::some ? "goes on"
                                                     : "begins");
        }
        if (decided == Progressed::all) {
            return kDone;
        }
        run.resume = decided == Progressed::some;
        return run_study(run, ranks_);
    }

    int stopped(std::size_t finished, int code) const {
        if (ranks_.leads() && code == kResumable) {
            fmt::print(stderr,
                       "{} of {} points are finished; the same command goes on from there\n",
                       finished, points_.size());
        }
        return code;
    }

    // False after a message.
    bool write_files(const std::vector<PointSummary>& summaries) const {
        if (options_.json.empty() && options_.html.empty()) {
            return true;
        }
        const auto study = read_study(options_.study.path, options_.study.overrides).study;
        const auto json = sweep_json(study ? printable(study->title) : "", keys_, summaries);
        return (options_.json.empty() || write_text_to(options_.json, json_text(json, 2) + "\n")) &&
               (options_.html.empty() ||
                write_text_to(options_.html, report_page(json_text(json))));
    }

    int conclude() const {
        std::vector<PointSummary> summaries;
        try {
            for (const SweepPoint& point : points_) {
                const std::string path = results_path(run_of(options_, point));
                summaries.push_back(summarise(point, path, thread_count()));
            }
            if (!write_files(summaries)) {
                return kBadInput;
            }
        } catch (const std::exception& error) {
            fmt::print(stderr, "{}\n", exception_text(error));
            return kBadInput;
        }
        if (options_.json != "-") {
            fmt::print("{}results: {}\n", sweep_text(keys_, summaries), folder_of(options_));
            if (!options_.html.empty()) {
                fmt::print("page: {}\n", options_.html);
            }
            if (summaries.size() > 1) {
                fmt::print("differences with intervals: gearpod compare {} {}\n",
                           summaries[0].results, summaries[1].results);
            }
        }
        const bool failed = std::ranges::any_of(
            summaries, [](const PointSummary& point) { return point.failed > 0; });
        return failed ? kSomeFailed : kDone;
    }

    const SweepOptions& options_;
    const std::vector<VariedKey>& keys_;
    const std::vector<SweepPoint>& points_;
    const Ranks& ranks_;
};

// The folder is there, or made; else says why not.
bool make_folder(const std::string& folder) {
    std::error_code error;
    fs::create_directories(folder, error);
    if (!fs::is_directory(folder)) {
        fmt::print(stderr, "--out {}: cannot be made a folder: {}\n", folder,
                   error ? error.message() : "it is a file");
        return false;
    }
    return true;
}

bool can_write_answers(const SweepOptions& options, const std::vector<SweepPoint>& points) {
    std::vector<FileRole> others{{"the study", options.study.path}};
    for (const SweepPoint& point : points) {
        others.push_back({"the results of " + point.name, results_path(run_of(options, point))});
    }
    const FileRole json{"--json", options.json};
    const bool json_good = can_write(json, others);
    others.push_back(json);
    return can_write({"--html", options.html}, others) && json_good;
}

}  // namespace

int sweep_command(const SweepOptions& options) {
    const Ranks ranks;
    Problems problems;
    const std::vector<VariedKey> keys = read_varied(options.vary, problems);
    std::vector<SweepPoint> points;
    if (problems.empty()) {
        points = grid_of(keys);
        problems = points.empty()
                       ? Problems{{"--vary", 0, "", fmt::format("more than {} points", kMostPoints),
                                   "give fewer values"}}
                       : problems_of(options, keys, points);
    }
    const bool good = !ranks.leads() || (problems.empty() && can_write_answers(options, points) &&
                                         make_folder(folder_of(options)));
    if (ranks.leads() && !problems.empty()) {
        print_problems(problems);
    }
    if (ranks.from_leader(good ? "go" : "stop") != "go") {
        return kBadInput;
    }
    return Sweep(options, keys, points, ranks).run();
}

}  // namespace gearpod::mc
