#include "mc/library/run/run_preparation.hpp"

#include <fmt/core.h>
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "machine/team.hpp"
#include "mc/ensemble/run_store.hpp"
#include "mc/files/atomic_file.hpp"
#include "mc/files/input/terminal_text.hpp"
#include "mc/library/run/command_files.hpp"
#include "mc/numerics/forecast/forecast.hpp"
#include "mc/numerics/forecast/memory.hpp"
#include "mc/results/provenance.hpp"
#include "mc/study/random/fnv.hpp"

namespace gearpod::mc {

std::string results_path(const RunOptions& options) {
    return options.out.empty() ? std::filesystem::path(options.study.path).stem().string() + ".h5"
                               : options.out;
}

BatchPlan plan_of(const RunOptions& options, const EnsemblePlan& plan) {
    return plan.batches(read_part(options.part).value_or(Part{}));
}

bool check_time_limit(const RunOptions& options, std::optional<std::chrono::seconds>& limit) {
    if (options.time_limit.empty()) {
        return true;
    }
    limit = parse_time_limit(options.time_limit);
    if (!limit) {
        fmt::print(stderr,
                   "--time-limit {}: is not a time; write hours:minutes:seconds as 01:30:00\n",
                   options.time_limit);
    }
    return limit.has_value();
}

bool check_progress(const RunOptions& options) {
    if (options.progress.empty() || options.progress == "json") {
        return true;
    }
    fmt::print(stderr, "--progress {}: must be json\n", printable(options.progress));
    return false;
}

bool check_part(const RunOptions& options, const EnsemblePlan& plan) {
    const std::optional<Part> part = read_part(options.part);
    if (!part) {
        fmt::print(stderr, "--part {}: must be K/N with K from 1 to N, for example 2/4\n",
                   printable(options.part));
        return false;
    }
    if (part->whole()) {
        return true;
    }
    if (plan_of(options, plan).batches() == 0) {
        fmt::print(stderr,
                   "--part {}: the study's gearboxes form {} batches of {}, of which this part has "
                   "none; use fewer parts\n",
                   options.part, plan.batches().batches(), kBatchRows);
        return false;
    }
    return true;
}

bool check_signals(const RunOptions& options, const EnsemblePlan& plan) {
    if (!options.part.empty() && !options.signals.empty()) {
        fmt::print(
            stderr,
            "--signals: a part numbers its rows differently; use `gearpod simulate --instance`\n");
        return false;
    }
    const auto rows = static_cast<long>(plan.batches().rows());
    const auto outside = std::find_if(options.signals.begin(), options.signals.end(),
                                      [&](long row) { return row < 0 || row >= rows; });
    if (outside == options.signals.end()) {
        return true;
    }
    fmt::print(stderr, "--signals {}: is not a row of the results, 0 to {}\n", *outside, rows - 1);
    return false;
}

bool check_output(const RunOptions& options) {
    const std::vector<FileRole> study{{"the study", options.study.path}};
    const std::string out = results_path(options);
    if (!can_write({"--out", out}, study)) {
        return false;
    }
    if (const std::string kind = why_no_results_name(out); !kind.empty()) {
        fmt::print(stderr, "--out {}: {}\n", printable(out), kind);
        return false;
    }
    std::string why = why_not_pending(out);
    for (const std::string& name : {resolve_links(out) + ".new", checkpoint_path(out)}) {
        if (same_file(name, options.study.path)) {
            why = "the study has the name " + name + " that the run needs";
        }
    }
    if (!why.empty()) {
        fmt::print(stderr, "{}: cannot be written: {}\n", out, why);
    }
    return why.empty();
}

bool check_memory(const RunOptions& options, const EnsemblePlan& ensemble, double motion_bytes,
                  const Ranks& ranks) {
    const BatchPlan plan = plan_of(options, ensemble);
    const int here = ranks.on_this_machine();
    const double needed =
        least_memory_bytes(motion_bytes, ensemble.shape, plan, here * thread_count(ensemble, here));
    const double at_hand = available_memory_bytes();
    if (options.force || needed <= at_hand) {
        return true;
    }
    fmt::print(
        stderr,
        "{}: numerics.threads: the run needs at least {:.2g} GB of memory, but only {:.2g} GB are "
        "available; use fewer threads or a lower sensor.sampling_Hz, or try it with --force\n",
        options.study.path, 1e-9 * needed, 1e-9 * at_hand);
    return false;
}

namespace {

// Checksum of the program's file, which reveals a rebuild between the starts of two ranks.
std::string program_sum() {
    std::ifstream stream("/proc/self/exe", std::ios::binary);
    std::uint64_t sum = kFnvStart;
    std::string piece(std::size_t{1} << 20, '\0');
    while (stream.read(piece.data(), static_cast<std::streamsize>(piece.size())),
           stream.gcount() > 0) {
        sum = fnv1a({piece.data(), static_cast<std::size_t>(stream.gcount())}, sum);
    }
    return fmt::format("{:016x}", sum);
}

// Reason why a rank other than 0 cannot take part, or "".
std::string rank_mismatch(const std::string& name, const std::string& program,
                          const std::string& first_program, const std::string& study,
                          const std::string& first_study) {
    if (program != first_program) {
        return fmt::format(
            "{} runs another program ({}; rank 0: {}); start the same program on all ranks", name,
            program, first_program);
    }
    const std::string line = line_difference(first_study, study, "in rank 0");
    return line.empty() ? "" : fmt::format("{} read another study ({})", name, line);
}

StudyScene make_in_time(const StudyOptions& options, Choosing choosing,
                        const Interruption& interruption,
                        const std::function<void(StudyScene&)>& prepare) {
    try {
        StudyScene made = make_scene(options, choosing);
        if (made && prepare) {
            prepare(made);
        }
        return made;
    } catch (const machine::Cancelled&) {
        const std::string reason = interruption.reason({});
        StudyScene none;
        none.problems = {{options.path, 0, "",
                          fmt::format("stopped by {} before its first gearbox",
                                      reason.empty() ? "the time limit" : reason),
                          "nothing has been computed yet; start it again",
                          ProblemKind::interrupted}};
        return none;
    }
}

}  // namespace

StudyScene load_scene_on_all_ranks(const Ranks& ranks, const StudyOptions& options,
                                   const Interruption& interruption,
                                   const std::function<void(StudyScene&)>& prepare) {
    // Runs are made without `prepare`; their leader corrects for the error of the steps.
    const Choosing choosing =
        ranks.leads() && !prepare ? Choosing::numerics_with_pairs : Choosing::numerics;
    StudyScene made = make_in_time(options, choosing, interruption, prepare);
    const auto all_problems = ranks.gather(made ? "" : format(made.problems));
    const auto names = ranks.gather(ranks.size() > 1 ? rank_name(ranks) : "");
    const auto programs =
        ranks.gather(ranks.size() > 1 ? fmt::format("{}, {}", version_text(), program_sum()) : "");
    const auto studies = ranks.gather(made ? made.scene->ensemble().study : "");
    std::string why = all_problems[0];
    for (std::size_t rank = 1; rank < names.size() && why.empty(); ++rank) {
        const std::string& problem = all_problems[rank];
        why = problem.empty() ? rank_mismatch(names[rank], programs[rank], programs[0],
                                              studies[rank], studies[0])
                              : names[rank] + ": " + problem.substr(0, problem.find('\n'));
        why += why.empty() ? "" : "\n";
    }
    if (!why.empty()) {
        made.scene.reset();
    }
    if (ranks.leads()) {
        fmt::print(stderr, "{}", why.empty() ? format(made.notices) : why);
    }
    return made;
}

bool was_interrupted(const Problems& problems) {
    return std::ranges::find(problems, ProblemKind::interrupted, &Problem::kind) != problems.end();
}

}  // namespace gearpod::mc
