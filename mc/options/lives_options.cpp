#include "mc/options/options.hpp"

namespace gearpod::mc {

void add_lives(CLI::App& app, LivesOptions& options, int& code) {
    auto* command = app.add_subcommand(
        "lives",
        "simulate gearboxes that are measured repeatedly while a crack grows, and report the "
        "cracks found in time, the warning time and the false alarms");
    RunOptions& run = options.run;
    add_study(*command, run.study);
    add_shorthand(*command, "--instances", "ensemble.instances",
                  "number of gearboxes with a growing crack", run.study);
    add_shorthand(*command, "--seed", "ensemble.seed", "seed of all random numbers", run.study);
    add_results(*command, run,
                "continue an interrupted run, or add cracked gearboxes to a finished one",
                "overwrite the results of another study or any other file");
    add_progress(*command, run);
    require_file_name(command->add_option("--json", options.json,
                                          "write JSON to a file, or - for standard output"));
    require_file_name(
        command->add_option("--html", options.html, "write a page with figures to a file"));
    command->add_flag("--show-withheld", options.shows_withheld,
                      "report lives although their signals are interpolated too coarsely");
    command->add_flag("--quiet", run.quiet, "print problems only");
    command->callback([&options, &code] { code = lives_command(options); });
}

}  // namespace gearpod::mc
