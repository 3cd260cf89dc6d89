#include "mc/options/options.hpp"

namespace gearpod::mc {

void add_run(CLI::App& app, RunOptions& run, int& code) {
    auto* command = app.add_subcommand("run", "simulate a study and report its detection rates");
    add_study(*command, run.study);
    add_shorthand(*command, "--instances", "ensemble.instances",
                  "number of gearboxes over all fault sizes", run.study);
    add_shorthand(*command, "--seed", "ensemble.seed", "seed of all random numbers", run.study);
    add_results(*command, run, "continue an interrupted run, or add gearboxes to a finished one",
                "overwrite the results of another study or any other file; start even if the "
                "memory may not suffice");
    command
        ->add_option("--part", run.part,
                     "compute part K of N of the gearboxes, e.g. 2/4; `merge` joins the parts")
        ->type_name("K/N");
    add_progress(*command, run);
    command->add_option("--watch", run.watch, "feature whose detection rate the progress shows");
    command
        ->add_option_function<std::vector<std::string>>(
            "--signals",
            [&run](const std::vector<std::string>& rows) {
                for (const std::string& row : rows) {
                    run.signals.push_back(whole_number(row));
                }
            },
            "store the signals of these rows over one planet turn in the results, "
            "e.g. 0,17")
        ->type_name("ROW,ROW...")
        ->check(number_check(NumberForm::whole, {}))
        ->delimiter(',')
        ->allow_extra_args(false);
    command->add_flag("--quiet", run.quiet, "print problems only");
    command->callback([&run, &code] { code = run_command(run); });
}

}  // namespace gearpod::mc
