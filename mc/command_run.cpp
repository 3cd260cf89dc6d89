#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <exception>
#include <filesystem>

#include "analysis/detection_text.hpp"
#include "analysis/reliability_text.hpp"
#include "mc/command_support.hpp"
#include "mc/ensemble.hpp"
#include "mc/progress.hpp"
#include "mc/provenance.hpp"
#include "mc/reliability_of_results.hpp"
#include "mc/results_file.hpp"

namespace gearpod::mc {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

long count_status(const Results& results, Status status) {
    return std::count(results.status.begin(), results.status.end(), static_cast<int>(status));
}

double timing(const Results& results, const std::string& name) {
    const auto found = std::find_if(results.timing.begin(), results.timing.end(),
                                    [&](const Timing& t) { return t.name == name; });
    return found == results.timing.end() ? 0.0 : found->seconds;
}

void print_times(const Results& results, const Study& study) {
    const int threads = thread_count(study);
    const double total = threads * timing(results, "ensemble_s");
    fmt::print("where the time went ({} thread{}, share of the ensemble's {:.1f} s):\n", threads,
               threads == 1 ? "" : "s", timing(results, "ensemble_s"));
    double listed = 0.0;
    for (const char* name : {"sampling", "stiffness", "march", "signals", "features"}) {
        const double spent = timing(results, fmt::format("{}_thread_s", name));
        listed += spent;
        fmt::print("  {:<10} {:5.1f} %\n", name, 100.0 * spent / total);
    }
    fmt::print("  {:<10} {:5.1f} %\n", "waiting", 100.0 * std::max(0.0, total - listed) / total);
    fmt::print("set-up {:.2f} s, detection and output {:.2f} s\n", timing(results, "setup_s"),
               timing(results, "output_s"));
}

void print_failures(const Results& results, int max_meshes) {
    const long diverged = count_status(results, Status::diverged);
    const long unsettled = count_status(results, Status::not_settled);
    fmt::print("gearboxes: {} of {} failed ({} diverged, {} did not settle)\n",
               diverged + unsettled, results.status.size(), diverged, unsettled);
    if (unsettled > 0) {
        fmt::print(
            "  (their orbit or the fault's disturbance was not back within {} mesh periods: "
            "raise numerics.max_meshes, or numerics.settle_tolerance)\n",
            max_meshes);
    }
}

}  // namespace

int run_command(const RunOptions& options) {
    const auto start = Clock::now();
    const std::string out = options.out.empty()
                                ? std::filesystem::path(options.study.path).stem().string() + ".h5"
                                : options.out;
    const auto scene = load_scene(options.study);
    const bool writable = can_write(out);
    if (!scene || !writable) {
        return kBadInput;
    }
    const Study& study = scene->study();
    if (!options.quiet) {
        fmt::print(stderr, "{}: {}\n", options.study.path, study.title);
    }
    const double setup = seconds_since(start);
    Progress progress(study.ensemble.instances + study.ensemble.threshold_instances, options.quiet);
    Results results = run_ensemble(*scene, progress);
    progress.finish();

    const auto after = Clock::now();
    results.detection = detect_all(results);
    results.provenance = provenance(study);
    results.timing.push_back({"setup_s", setup});
    results.timing.push_back({"detection_s", seconds_since(after)});
    try {
        write_results(out, results);
    } catch (const std::exception& error) {
        fmt::print(stderr, "{}\n", error.what());
        return kBadInput;
    }
    results.timing.push_back({"output_s", seconds_since(after)});
    if (!options.quiet) {
        fmt::print("{}\n{}\n", analysis::detection_text(results.detection, results.request),
                   analysis::reliability_text(reliability_of(results, ""), results.request));
        print_failures(results, scene->max_meshes());
        print_times(results, study);
        fmt::print("results: {}\n", out);
    }
    return count_status(results, Status::ok) == static_cast<long>(results.status.size())
               ? kDone
               : kSomeFailed;
}

}  // namespace gearpod::mc
