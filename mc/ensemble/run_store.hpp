// Where a run keeps its finished batches: a new checkpoint, one to continue, or one filled from
// finished results that are to grow.
#pragma once

#include <memory>
#include <string>

#include "mc/results/checkpoint.hpp"
#include "mc/scene/scene.hpp"

namespace gearpod::mc {

// The checkpoint's file: beside the results file, behind its links.
std::string checkpoint_path(const std::string& results_path);

struct StoreOptions {
    bool resume = false;
    bool force = false;  // a run that begins anew may overwrite what is not of this study
    bool quiet = false;  // else says on stderr what it continues
};

// Throws std::runtime_error naming the file and the reason.
std::unique_ptr<Checkpoint> open_checkpoint(const Scene& scene, const BatchPlan& plan,
                                            const std::string& results_path,
                                            const StoreOptions& options);

}  // namespace gearpod::mc
