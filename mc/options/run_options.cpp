#include "mc/options/options.hpp"

namespace gearpod::mc {

void add_run(CLI::App& app, RunOptions& run, int& code) {
    auto* command =
        app.add_subcommand("run", "simulate the whole study and report detection rates");
    add_study(*command, run.study);
    add_shorthand(*command, "--instances", "ensemble.instances", "gearboxes over all fault sizes",
                  run.study);
    add_shorthand(*command, "--seed", "ensemble.seed", "seed of all random numbers", run.study);
    add_results(*command, run, "continue an interrupted run, or add gearboxes to a finished one",
                "overwrite the results of another study, or a file that is none; start although "
                "the memory will not suffice");
    command
        ->add_option("--part", run.part,
                     "compute one part of the gearboxes, e.g. 2/4; merge makes the whole of all")
        ->type_name("K/N");
    add_progress(*command, run);
    command->add_option("--watch", run.watch, "feature whose detection rate the progress shows");
    command
        ->add_option("--signals", run.signals,
                     "rows whose signals over a planet turn go into the results, e.g. 0,17")
        ->type_name("ROW,ROW...")
        ->delimiter(',')
        ->allow_extra_args(false);
    command->add_flag("--quiet", run.quiet, "print nothing but problems");
    command->callback([&run, &code] { code = run_command(run); });
}

}  // namespace gearpod::mc
