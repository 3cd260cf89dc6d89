#include "mc/ensemble/run_store.hpp"

#include <fmt/core.h>

#include <filesystem>
#include <stdexcept>

#include "mc/ensemble/batch_worker.hpp"
#include "mc/ensemble/results_check.hpp"
#include "mc/files/atomic_file.hpp"
#include "mc/results/file_rows.hpp"
#include "mc/results/provenance.hpp"
#include "mc/results/results_file.hpp"

namespace gearpod::mc {

Part part_of(const Results& results) {
    return read_part(results.provenance_value("part")).value_or(Part{});
}

RunIdentity identity_of(const Results& results, const std::string& path) {
    const StudyReading reading = read_study_text(results.provenance_value("study"), path);
    RunIdentity identity =
        run_identity(reading.study.value_or(Study{}), row_shape(results), part_of(results));
    identity.version = version_text(results.provenance_value("code_version"),
                                    results.provenance_value("git_hash"));
    identity.seed = results.provenance_value("seed");
    return identity;
}

void BatchFiller::add(const RowBlock& block) {
    for (std::size_t row = 0; row < block.count(); ++row) {
        const auto values =
            block.values.begin() + static_cast<std::ptrdiff_t>(row * shape_.values());
        rows_.status.push_back(block.status[row]);
        rows_.values.insert(rows_.values.end(), values,
                            values + static_cast<std::ptrdiff_t>(shape_.values()));
        const std::size_t batch = plan_.batch_of_row(block.first + row);
        const Batch place = plan_.batch(batch);
        if (block.first + row + 1 == place.first_row + place.count) {
            store_.write(number_(batch), rows_);
            rows_ = {};
        }
    }
}

namespace {

std::unique_ptr<Checkpoint> grow(const std::string& results_path, const std::string& path,
                                 const RunIdentity& identity, const BatchPlan& plan) {
    const Results old = read_frame(results_path);
    const FileRows rows(results_path, old);
    const std::string why = difference(identity_of(old, results_path), identity);
    if (!why.empty()) {
        throw std::runtime_error(results_path + ": cannot be continued: it " + why);
    }
    if (rows.rows() > plan.rows()) {
        throw std::runtime_error(
            fmt::format("{}: cannot be continued: it has {} gearboxes, more than the {} asked for; "
                        "raise --instances",
                        results_path, rows.rows(), plan.rows()));
    }
    check_results(results_path, old, rows);
    auto checkpoint = Checkpoint::create(path, identity, plan);
    BatchFiller filler(*checkpoint, plan, identity.shape, [](std::size_t batch) { return batch; });
    rows.visit([&](const RowBlock& block) { filler.add(block); });
    checkpoint->sync();
    return checkpoint;
}

// Why a run of `identity` must not overwrite what is there, or "". The same study by another
// version of the program may: that is what one computes again for.
std::string why_precious(const std::string& results_path, const RunIdentity& identity) {
    std::error_code none;
    if (!Checkpoint::exists(results_path) || std::filesystem::file_size(results_path, none) == 0) {
        return "";
    }
    try {
        const Results old = read_frame(results_path);
        RunIdentity there = identity_of(old, results_path);
        there.version = identity.version;
        const std::string why = difference(there, identity);
        return why.empty() ? "" : results_path + ": holds results that a run wrote and that " + why;
    } catch (const std::exception& error) {
        return error.what();
    }
}

void tell(const Checkpoint& checkpoint, const BatchPlan& plan, const std::string& from) {
    for (const std::string& finding : checkpoint.findings()) {
        fmt::print(stderr, "{}\n", finding);
    }
    fmt::print(stderr, "continuing {}: {} of {} tiles of gearboxes are there\n", from,
               checkpoint.batches_done(), plan.batches());
}

}  // namespace

std::string checkpoint_path(const std::string& results_path) {
    return behind_links(results_path) + ".part";
}

std::unique_ptr<Checkpoint> open_checkpoint(const Scene& scene, const BatchPlan& plan,
                                            const std::string& results_path,
                                            const StoreOptions& options) {
    const Study& study = scene.study();
    const RunIdentity identity =
        run_identity(study, row_shape(Sampler(study), study), options.part);
    const std::string path = checkpoint_path(results_path);
    std::unique_ptr<Checkpoint> checkpoint;
    std::string from;
    if (options.resume && Checkpoint::exists(path)) {
        from = path;
        checkpoint = Checkpoint::resume(path, identity, plan);
    } else if (options.resume && Checkpoint::exists(behind_links(results_path))) {
        from = results_path;
        checkpoint = grow(results_path, path, identity, plan);
    } else {
        const std::string why =
            options.force ? "" : why_precious(behind_links(results_path), identity);
        if (!why.empty()) {
            throw std::runtime_error(why +
                                     "; name another file with --out, or overwrite this one with "
                                     "--force");
        }
        checkpoint = Checkpoint::create(path, identity, plan);
        if (options.resume && !options.quiet) {
            fmt::print(stderr, "{}: there is nothing to continue; the run begins anew\n",
                       results_path);
        }
    }
    if (!from.empty() && (!options.quiet || !checkpoint->findings().empty())) {
        tell(*checkpoint, plan, from);
    }
    return checkpoint;
}

}  // namespace gearpod::mc
