#include "mc/options/options.hpp"

namespace gearpod::mc {

void add_lives(CLI::App& app, LivesOptions& options, int& code) {
    auto* command = app.add_subcommand(
        "lives",
        "gearboxes measured again and again while a crack grows: how many are found in time, how "
        "long before, and how many false alarms that costs");
    RunOptions& run = options.run;
    add_study(*command, run.study);
    add_shorthand(*command, "--instances", "ensemble.instances", "gearboxes that crack", run.study);
    add_shorthand(*command, "--seed", "ensemble.seed", "seed of all random numbers", run.study);
    add_results(*command, run,
                "continue an interrupted run, or add gearboxes that crack to a finished one",
                "overwrite the results of another study, or a file that is none");
    add_progress(*command, run);
    needs_name(command->add_option("--json", options.json, "write JSON to a file, or to -"));
    needs_name(command->add_option("--html", options.html, "write a page"));
    command->add_flag("--quiet", run.quiet, "no progress");
    command->callback([&options, &code] { code = lives_command(options); });
}

}  // namespace gearpod::mc
