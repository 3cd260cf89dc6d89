// Command `compare A.h5 B.h5 ...`: the effect of a change of sensor, feature, noise or design on
// detection.
#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <nlohmann/json.hpp>
#include <set>

#include "analysis/comparison/comparison_report.hpp"
#include "analysis/report/false_alarm_text.hpp"
#include "mc/commands/commands.hpp"
#include "mc/commands/options/options.hpp"
#include "mc/commands/output_folder.hpp"
#include "mc/ensemble/ranks.hpp"
#include "mc/files/input/problems.hpp"
#include "mc/files/input/terminal_text.hpp"
#include "mc/library/run/command_files.hpp"
#include "mc/report/run_sections.hpp"
#include "mc/report/sweep/summaries.hpp"
#include "mc/results/reliability_of_results.hpp"
#include "mc/results/result_rows.hpp"

namespace gearpod::mc {
namespace {

struct CompareOptions {
    std::vector<std::string> results;  // the others are compared with the first
    std::string json, html;            // "": none; JSON "-": standard output
    bool full = false;                 // prints all findings
    bool force = false;                // replaces outputs of another kind
};

// Results file with its smallest faults.
struct Side : ComparedSide {
    std::size_t gearboxes = 0;
    std::vector<std::optional<analysis::SmallestFault>> smallest;
    std::vector<bool> without_threshold;
    std::string title;
};

// Describes an incomplete file (part of a study, interrupted run); "" if it is complete.
std::string incomplete_text(const Results& frame, std::size_t gearboxes) {
    const std::string part = frame.provenance_value("part");
    const std::string state = frame.provenance_value("state");
    const bool stopped = state == "running" || state.starts_with("interrupted");
    return (part.empty() ? "" : fmt::format(", part {} only", printable(part))) +
           (stopped ? fmt::format(", {} of {} gearboxes ({})", gearboxes,
                                  printable(frame.provenance_value("gearboxes_asked_for")),
                                  printable(state))
                    : "");
}

Side read_side(const std::string& path) {
    Side side{read_compared(path), 0, {}, {}, ""};
    const ColumnRows rows(side.frame);
    const auto reliability = reliability_of(side.frame, rows, "", thread_count());
    for (std::size_t n = 0; reliability && n < side.frame.noise_levels.size(); ++n) {
        side.smallest.push_back(analysis::smallest_fault(*reliability, n));
        side.without_threshold.push_back(analysis::without_threshold(side.frame.detection, n));
    }
    side.gearboxes = count_rows(rows, side.frame.request.threshold_records).all;
    side.title = (side.facts ? printable(side.facts->ensemble.title) : "") +
                 incomplete_text(side.frame, side.gearboxes);
    return side;
}

// Noise level to show: the reference level among those that all files have, else the first file's.
double shown_level(const std::vector<Side>& sides) {
    const auto& levels = sides.front().frame.noise_levels;
    std::vector<double> common = levels;
    std::erase_if(common, [&](double level) {
        return !std::ranges::all_of(sides, [&](const Side& side) {
            return std::ranges::count(side.frame.noise_levels, level) > 0;
        });
    });
    return common.empty() ? levels[reference_level(levels)] : common[reference_level(common)];
}

analysis::ComparedResults compare_sides(const std::vector<Side>& sides) {
    analysis::ComparedResults results;
    const Side& first = sides.front();
    results.size = first.frame.request.size;
    results.confidence = first.frame.request.confidence;
    results.noise_level = shown_level(sides);
    for (const Side& side : sides) {
        results.first_records = results.first_records || side.frame.request.threshold_records > 1;
        analysis::ComparedFile file;
        file.path = side.path;
        file.title = side.title;
        file.gearboxes = static_cast<long>(side.gearboxes);
        file.noise_levels = side.frame.noise_levels;
        file.smallest = side.smallest;
        file.without_threshold = side.without_threshold;
        file.shortage = analysis::sample_shortage(side.frame.detection, side.frame.request,
                                                  subject_of(side.frame));
        if (&side != &first) {
            analysis::ComparisonRequest request;
            request.confidence = results.confidence;
            compare_with(first, side, request, {}, file);
        }
        results.files.push_back(std::move(file));
    }
    return results;
}

// Reads all files. If some cannot be read, or cannot be compared with the first, it prints every
// problem and returns none.
std::vector<Side> read_sides(const std::vector<std::string>& paths) {
    std::vector<Side> sides;
    std::set<std::string> problems;  // a file may be named twice
    bool good = true;
    const auto say = [&](const std::string& problem) {
        if (!problem.empty() && problems.insert(problem).second) {
            fmt::print(stderr, "{}", problem);
            good = false;
        }
    };
    for (const std::string& path : paths) {
        try {
            sides.push_back(read_side(path));
            if (sides.front().path == paths.front() && sides.size() > 1) {
                say(mismatch(sides.front(), sides.back()));
            }
        } catch (const std::exception& error) {
            say(exception_text(error) + "\n");
        }
    }
    return good ? std::move(sides) : std::vector<Side>{};
}

int compare_command(const CompareOptions& options) {
    std::vector<FileRole> read;
    for (const std::string& path : options.results) {
        read.push_back({"the results file", path});
    }
    if (!can_write_json_and_page(options.json, options.html, std::move(read), options.force)) {
        return kBadInput;
    }
    if (options.results.size() < 2) {
        fmt::print(stderr,
                   "compare: only one results file; give two or more, the first is the "
                   "reference\n");
        return kBadInput;
    }
    const std::vector<Side> sides = read_sides(options.results);
    if (sides.empty()) {
        return kBadInput;
    }
    const analysis::ComparedResults results = compare_sides(sides);
    if (!write_json_and_page(comparison_json(results), options.json, options.html)) {
        return kBadInput;
    }
    if (options.json != "-") {
        print_findings(comparison_report(results), options.full);
        print_written("page", options.html);
    }
    return kDone;
}

}  // namespace

void add_compare(CLI::App& app, int& code) {
    const auto [command, options] = add_command<CompareOptions>(
        app, code, "compare",
        "compare detection between results files, for example of two sensors, noises or designs",
        reporting<compare_command>);
    command
        .add_option("results", options.results,
                    "results files (HDF5); all others are compared with the first")
        ->required();
    add_full(command, options.full);
    add_json(command, options.json);
    add_page(command, options.html);
    add_force(command, options.force);
}

}  // namespace gearpod::mc
