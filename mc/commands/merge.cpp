#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <exception>
#include <map>
#include <stdexcept>

#include "machine/clocks.hpp"
#include "mc/commands/commands.hpp"
#include "mc/commands/options/options.hpp"
#include "mc/ensemble/results_check.hpp"
#include "mc/ensemble/run_store.hpp"
#include "mc/files/input/problems.hpp"
#include "mc/files/input/terminal_text.hpp"
#include "mc/library/run/command_files.hpp"
#include "mc/library/run/run.hpp"
#include "mc/library/run/run_preparation.hpp"
#include "mc/results/provenance.hpp"
#include "mc/results/result_rows.hpp"

namespace gearpod::mc {
namespace {

struct MergeOptions {
    std::vector<std::string> results;  // results files of the parts of one study
    std::string out;
    bool force = false;  // overwrite the results of a different run
    bool quiet = false;
};

// Results file and the number of batches that it contains.
struct PartFile {
    std::string path;
    Results frame;
    EnsemblePlan ensemble;
    BatchPlan plan;
    std::size_t batches = 0;  // complete ones; they are the first of the plan
};

PartFile read_part_file(const std::string& path) {
    Results frame = read_frame(path);
    const FileRows rows(path, frame);
    if (frame.provenance_value("kind") == kRecordingsKind) {
        throw std::runtime_error(path +
                                 ": contains recordings; only results of `run` can be merged");
    }
    StudyReading reading = read_study_text(frame.provenance_value("study"), path);
    if (!reading.study) {
        throw std::runtime_error(path + ": the study in the file cannot be read:\n" +
                                 format(reading.problems));
    }
    check_results(path, frame, rows);
    const EnsemblePlan ensemble(*reading.study);
    const BatchPlan plan = ensemble.batches(part_of(frame));
    PartFile file{path, std::move(frame), ensemble, plan, 0};
    while (file.batches < plan.batches() && plan.rows_before(file.batches + 1) <= rows.rows()) {
        ++file.batches;
    }
    return file;
}

// Rows of a batch of the complete ensemble, "rows 16 to 31".
std::string rows_text(const BatchPlan& whole, std::size_t batch) {
    const Batch place = whole.batch(batch);
    return fmt::format("rows {} to {}", place.first_row, place.first_row + place.rows() - 1);
}

class Merge {
  public:
    explicit Merge(const MergeOptions& options) : options_(options) {}

    // Reads all files. Returns every problem, one line each; "" if there is none.
    std::string read() {
        std::string problems;
        for (const std::string& path : options_.results) {
            try {
                files_.push_back(read_part_file(path));
            } catch (const std::exception& error) {
                problems += exception_text(error) + "\n";
            }
        }
        for (const PartFile& file : files_) {
            problems += rank_mismatch(file);
        }
        return problems.empty() ? gaps() : problems;
    }

    std::string study() const { return files_.front().frame.provenance_value("study"); }

    BatchPlan whole() const { return files_.front().ensemble.batches(); }

    void fill(RowStore& store) const {
        for (const PartFile& file : files_) {
            BatchFiller filler(store, file.plan, row_shape(file.frame),
                               [&](std::size_t batch) { return file.plan.number(batch); });
            FileRows(file.path, file.frame).visit([&](const RowBlock& block) {
                filler.add(block);
            });
        }
    }

  private:
    // Reason why this program cannot merge the file with the first one; "" if it can.
    std::string rank_mismatch(const PartFile& file) const {
        const PartFile& first = files_.front();
        RunIdentity here = identity_of(first.frame, first.path);
        here.version = version_text();
        RunIdentity there = identity_of(file.frame, file.path);
        there.part = here.part;
        std::string why = difference(there, here);
        if (why.empty() && file.ensemble.test_gearboxes != first.ensemble.test_gearboxes) {
            why = fmt::format("has ensemble.instances = {}, but {} has {}",
                              file.ensemble.test_gearboxes, first.path,
                              first.ensemble.test_gearboxes);
        }
        if (why.empty() && file.frame.provenance_value("numerics_choice") !=
                               first.frame.provenance_value("numerics_choice")) {
            why = fmt::format("uses another solver setting ({}) than {} ({})",
                              file.frame.provenance_value("numerics_choice"), first.path,
                              first.frame.provenance_value("numerics_choice"));
        }
        return why.empty() ? ""
                           : file.path + ": cannot be merged: it " + why +
                                 "; merge with the program and the study of all parts\n";
    }

    // Batches that are in several files, or in none, as problem lines.
    std::string gaps() const {
        std::map<std::size_t, const PartFile*> owner;
        std::string problems;
        for (const PartFile& file : files_) {
            for (std::size_t batch = 0; batch < file.batches; ++batch) {
                const auto [at, fresh] = owner.emplace(file.plan.number(batch), &file);
                if (!fresh) {
                    problems +=
                        fmt::format("{}: cannot be merged: {} and more are also in {}\n", file.path,
                                    rows_text(whole(), at->first), at->second->path);
                    break;
                }
            }
            if (file.batches < file.plan.batches()) {
                problems += fmt::format(
                    "{}: contains {} of its {} {} ({}); continue it with `run --resume`\n",
                    file.path, file.plan.rows_before(file.batches), file.plan.rows(),
                    file.plan.counted(), printable(file.frame.provenance_value("state")));
            }
        }
        if (!problems.empty()) {
            return problems;
        }
        for (std::size_t batch = 0; batch < whole().batches(); ++batch) {
            if (!owner.contains(batch)) {
                return fmt::format(
                    "{} of {} batches of gearboxes are in none of the files, first {}; {}\n",
                    whole().batches() - owner.size(), whole().batches(), rows_text(whole(), batch),
                    missing_part(batch));
            }
        }
        return "";
    }

    std::string missing_part(std::size_t batch) const {
        const std::size_t parts = part_of(files_.front().frame).count;
        return fmt::format("compute them with `run --part {}/{}`", batch % parts + 1, parts);
    }

    const MergeOptions& options_;
    std::vector<PartFile> files_;
};

bool check_names(const MergeOptions& options) {
    std::vector<FileRole> parts;
    for (const std::string& path : options.results) {
        parts.push_back({"a part", path});
    }
    return can_write({"--out", options.out}, parts);
}

int merge_command(const MergeOptions& options) {
    const auto start = WallClock::now();
    RunOptions run;
    run.study.path = options.results.front();
    run.out = options.out;
    run.force = options.force;
    run.quiet = options.quiet;
    run.merges = true;
    const Ranks ranks;
    if (ranks.size() > 1) {
        fmt::print(stderr,
                   "merge: runs in one process, but {} were started; start it without mpiexec\n",
                   ranks.size());
        return kBadInput;
    }
    Merge merge(options);
    const std::string problems = merge.read();
    fmt::print(stderr, "{}", problems);
    if (!check_names(options) || !check_output(run) || !problems.empty()) {
        return kBadInput;
    }
    const std::string& first = options.results.front();
    const StudyScene made =
        make_scene(first, read_study_text(merge.study(), first), Choosing::numerics_with_pairs);
    if (!made) {
        print_problems(made.problems);
        return kBadInput;
    }
    const std::string temporary = checkpoint_path(options.out);
    const bool existed = Checkpoint::exists(temporary);
    std::unique_ptr<Checkpoint> checkpoint;
    try {
        // The rows that a killed merge or run of this study left are the same.
        checkpoint = open_checkpoint(
            made.scene->ensemble(), made.scene->ensemble().shape, merge.whole(), options.out,
            {.resume = existed, .force = options.force, .quiet = options.quiet});
        merge.fill(*checkpoint);
        checkpoint->sync();
    } catch (const std::exception& error) {
        fmt::print(stderr, "{}\n", exception_text(error));
        if (!existed) {
            ::unlink(temporary.c_str());
        }
        return kBadInput;
    }
    const Interruption interruption(std::nullopt);
    return run_to_end(run, made, ranks, std::move(checkpoint), seconds_since(start), interruption);
}

}  // namespace

void add_merge(CLI::App& app, int& code) {
    const auto [command, options] = add_command<MergeOptions>(
        app, code, "merge",
        "join the results files of all parts of a study into one, as one run writes it",
        merge_command);
    command.add_option("results", options.results, "results files of `run --part` 1/N to N/N")
        ->required();
    add_file(command, "--out", options.out, "results file to write")->required();
    command.add_flag("--force", options.force,
                     "overwrite the results of another study or any other file");
    command.add_flag("--quiet", options.quiet, "print problems only");
}

}  // namespace gearpod::mc
