#include "mc/ensemble/run_store.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <filesystem>
#include <stdexcept>

#include "mc/ensemble/batch_workers.hpp"
#include "mc/ensemble/gearbox/realization_features.hpp"
#include "mc/files/atomic_file.hpp"
#include "mc/results/provenance.hpp"

namespace gearpod::mc {

Part part_of(const Results& results) {
    return read_part(results.provenance_value("part")).value_or(Part{});
}

RunIdentity identity_of(const Results& results, const std::string& path,
                        std::optional<std::int64_t> threshold_gearboxes) {
    const auto plan = recorded_plan(results.provenance_value("study"), path, threshold_gearboxes);
    RunIdentity identity =
        run_identity(plan ? *plan : EnsemblePlan(), row_shape(results), part_of(results));
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
        if (block.first + row + 1 == place.first_row + place.rows()) {
            store_.write(number_(batch), rows_);
            rows_ = {};
        }
    }
}

std::string why_not_extendable(const Results& old, const std::string& path,
                               const EnsemblePlan& plan, const Part& part) {
    const auto old_plan = recorded_plan(old.provenance_value("study"), path);
    const auto healthy = old_plan ? old_plan->threshold_gearboxes : 0;
    // Trending features are relative to the first healthy gearboxes, so the old results must
    // contain all of these.
    const bool fewer =
        part.whole() && healthy >= HealthyReference::kRecords && healthy < plan.threshold_gearboxes;
    const RunIdentity there =
        fewer ? identity_of(old, path, plan.threshold_gearboxes) : identity_of(old, path);
    return difference(there, run_identity(plan, row_shape(old), part));
}

namespace {

// Rows of one group of a block, renumbered for a plan with `shift` more rows before them.
RowBlock of_group(const RowBlock& block, Group group, std::size_t shift) {
    RowBlock out;
    const std::size_t width = block.row_values();
    for (std::size_t row = 0; row < block.count(); ++row) {
        if (block.group[row] == static_cast<int>(group)) {
            out.first = out.status.empty() ? block.first + row + shift : out.first;
            out.group.push_back(block.group[row]);
            out.status.push_back(block.status[row]);
            const auto values = block.values.begin() + static_cast<std::ptrdiff_t>(row * width);
            out.values.insert(out.values.end(), values,
                              values + static_cast<std::ptrdiff_t>(width));
        }
    }
    return out;
}

std::unique_ptr<Checkpoint> extend_results(const std::string& results_path, const std::string& path,
                                           const RunIdentity& identity, const EnsemblePlan& plan,
                                           const BatchPlan& batches, const StoreOptions& options) {
    const Results old = read_frame(results_path);
    const FileRows rows(results_path, old);
    const std::string why = why_not_extendable(old, results_path, plan, options.part);
    if (!why.empty()) {
        throw std::runtime_error(results_path + ": cannot be continued: it " + why);
    }
    options.check(results_path, old, rows);
    std::size_t healthy = 0;
    rows.visit([&](const RowBlock& block) {
        healthy += static_cast<std::size_t>(
            std::count(block.group.begin(), block.group.end(), static_cast<int>(Group::threshold)));
    });
    if (rows.rows() - healthy > batches.test_rows()) {
        throw std::runtime_error(
            fmt::format("{}: cannot be continued: it has {} test gearboxes, more than the {} "
                        "requested; raise --instances",
                        results_path, rows.rows() - healthy, batches.test_rows()));
    }
    auto checkpoint = Checkpoint::create(path, identity, batches);
    const auto same_number = [](std::size_t batch) { return batch; };
    // One filler per group. The last batch of each group may be incomplete; it is omitted.
    BatchFiller thresholds(*checkpoint, batches, identity.shape, same_number),
        test(*checkpoint, batches, identity.shape, same_number);
    rows.visit([&](const RowBlock& block) {
        thresholds.add(of_group(block, Group::threshold, 0));
        test.add(of_group(block, Group::test, batches.threshold_rows() - healthy));
    });
    checkpoint->sync();
    return checkpoint;
}

// Reason why a run of `identity` must not overwrite the existing file, or "". Results of the same
// study by another version of the program may be overwritten.
std::string why_not_overwritable(const std::string& results_path, const RunIdentity& identity) {
    std::error_code none;
    if (!Checkpoint::exists(results_path) || std::filesystem::file_size(results_path, none) == 0) {
        return "";
    }
    try {
        const Results old = read_frame(results_path);
        RunIdentity existing = identity_of(old, results_path);
        existing.version = identity.version;
        const std::string why = difference(existing, identity);
        return why.empty() ? "" : results_path + ": contains results of another run: it " + why;
    } catch (const std::exception& error) {
        return error.what();
    }
}

void report_resumed(const Checkpoint& checkpoint, const BatchPlan& plan, const std::string& from) {
    for (const std::string& finding : checkpoint.findings()) {
        fmt::print(stderr, "{}\n", finding);
    }
    fmt::print(stderr, "continuing {}: {} of {} batches are finished\n", from,
               checkpoint.batches_done(), plan.batches());
}

}  // namespace

std::string checkpoint_path(const std::string& results_path) {
    return resolve_links(results_path) + ".part";
}

std::unique_ptr<Checkpoint> open_checkpoint(const EnsemblePlan& plan, const RowShape& shape,
                                            const BatchPlan& batches,
                                            const std::string& results_path,
                                            const StoreOptions& options) {
    const RunIdentity identity = run_identity(plan, shape, options.part);
    const std::string path = checkpoint_path(results_path);
    std::unique_ptr<Checkpoint> checkpoint;
    std::string from;
    if (options.resume && Checkpoint::exists(path)) {
        from = path;
        checkpoint = Checkpoint::resume(path, identity, batches);
    } else if (options.resume && Checkpoint::exists(resolve_links(results_path))) {
        from = results_path;
        checkpoint = extend_results(results_path, path, identity, plan, batches, options);
    } else {
        const std::string why =
            options.force ? "" : why_not_overwritable(resolve_links(results_path), identity);
        if (!why.empty()) {
            throw std::runtime_error(why +
                                     "; name another file with --out, or overwrite this one with "
                                     "--force");
        }
        checkpoint = Checkpoint::create(path, identity, batches);
        if (options.resume && !options.quiet) {
            fmt::print(stderr, "{}: there is nothing to continue; starting a new run\n",
                       results_path);
        }
    }
    if (!from.empty() && (!options.quiet || !checkpoint->findings().empty())) {
        report_resumed(*checkpoint, batches, from);
    }
    return checkpoint;
}

}  // namespace gearpod::mc
