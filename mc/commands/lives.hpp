// Runs and reports lives of gearboxes, for `lives` itself and for the commands that call it.
#pragma once

#include <string>

#include "mc/commands/report_options.hpp"
#include "mc/run/run_options.hpp"

namespace gearpod::mc {

class Ranks;

struct LivesOptions {
    RunOptions run;          // without watch, signals and part
    std::string json, html;  // "": none; JSON "-": standard output
    bool shows_withheld = false;
};

// Runs `lives` on the given MPI ranks. Every rank must call it. Returns the exit code.
int lives_study(const LivesOptions& options, const Ranks& ranks);
// Reports a results file written by `lives`. `report` calls it for such a file, and prints what it
// throws.
int report_lives(const ReportOptions& options);

}  // namespace gearpod::mc
