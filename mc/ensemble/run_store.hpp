// Checkpoint of a run: a new one, one to resume, or one filled from finished results that are to be
// extended.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "mc/ensemble/results_check.hpp"
#include "mc/plan/ensemble_plan.hpp"
#include "mc/results/checkpoint.hpp"
#include "mc/results/result_rows.hpp"
#include "mc/results/results_file.hpp"

namespace gearpod::mc {

// Path of the checkpoint: in the directory of the results file, after following symbolic links.
std::string checkpoint_path(const std::string& results_path);

// Identity of the run that wrote the results. `path` names the file in messages. With
// `threshold_gearboxes`, that of the same run with another number of these.
RunIdentity identity_of(const Results& results, const std::string& path,
                        std::optional<std::int64_t> threshold_gearboxes = {});
// Reason why finished results cannot be extended to those of the study, as text to follow the
// file's name, or "". The results may have fewer gearboxes in either group. The threshold sample of
// a part must be unchanged, because it determines the other parts.
std::string why_not_extendable(const Results& old, const std::string& path,
                               const EnsemblePlan& plan, const Part& part);
// Part of the ensemble that the results cover.
Part part_of(const Results& results);

struct StoreOptions {
    bool resume = false;
    bool force = false;  // allows a new run to overwrite results of another study
    bool quiet = false;  // suppresses the note on stderr about resumed work
    Part part = {};
    // Check of finished results that are to be extended.
    std::function<void(const std::string&, const Results&, const RowSource&)> check = check_results;
};

// Opens or creates the checkpoint. Throws std::runtime_error naming the file and the reason.
std::unique_ptr<Checkpoint> open_checkpoint(const EnsemblePlan& plan, const RowShape& shape,
                                            const BatchPlan& batches,
                                            const std::string& results_path,
                                            const StoreOptions& options);

// Collects consecutive rows and writes complete batches to a store.
class BatchFiller {
  public:
    // `plan` numbers the rows; `number` maps its batch numbers to those of the store.
    BatchFiller(RowStore& store, const BatchPlan& plan, const RowShape& shape,
                std::function<std::size_t(std::size_t)> number)
        : store_(store), plan_(plan), shape_(shape), number_(std::move(number)) {}

    void add(const RowBlock& block);

  private:
    RowStore& store_;
    const BatchPlan plan_;
    const RowShape shape_;
    const std::function<std::size_t(std::size_t)> number_;
    BatchRows rows_;
};

}  // namespace gearpod::mc
