// Where a run keeps its finished batches: a new checkpoint, one to continue, or one filled from
// finished results that are to grow.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "mc/ensemble/results_check.hpp"
#include "mc/results/checkpoint.hpp"
#include "mc/results/results_file.hpp"
#include "mc/results/row_source.hpp"
#include "mc/scene/scene.hpp"

namespace gearpod::mc {

// The checkpoint's file: beside the results file, behind its links.
std::string checkpoint_path(const std::string& results_path);

// What a results file's rows are the rows of; `path` stands for it in messages.
RunIdentity identity_of(const Results& results, const std::string& path);
// Why finished results cannot grow into those of the study, as text to follow the file's name, or
// "". They may have fewer gearboxes of either group; a part's threshold sample stays as it is,
// since with another one the parts would be others.
std::string why_not_grown(const Results& old, const std::string& path, const Study& study,
                          const Part& part);
// Which of its ensemble's rows it has.
Part part_of(const Results& results);

struct StoreOptions {
    bool resume = false;
    bool force = false;  // a run that begins anew may overwrite what is not of this study
    bool quiet = false;  // else says on stderr what it continues
    Part part = {};
    // Of finished results that are to grow.
    std::function<void(const std::string&, const Results&, const RowSource&)> check = check_results;
};

// Throws std::runtime_error naming the file and the reason.
std::unique_ptr<Checkpoint> open_checkpoint(const Study& study, const RowShape& shape,
                                            const BatchPlan& plan, const std::string& results_path,
                                            const StoreOptions& options);
// The same of a run's rows.
std::unique_ptr<Checkpoint> open_checkpoint(const Scene& scene, const BatchPlan& plan,
                                            const std::string& results_path,
                                            const StoreOptions& options);

// Puts whole batches of consecutive rows into a store.
class BatchFiller {
  public:
    // `plan` numbers the rows; `number` says under which number the store keeps a batch of it.
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
