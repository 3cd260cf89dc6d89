// Command `run STUDY`: simulates a study and reports its detection rates.
#include <CLI/CLI.hpp>

#include "mc/commands/commands.hpp"
#include "mc/commands/options/options.hpp"
#include "mc/library/run/run_options.hpp"

namespace gearpod::mc {

void add_run(CLI::App& app, int& code) {
    const auto [command, options] = add_command<RunOptions>(
        app, code, "run", "simulate a study and report its detection rates", run_command);
    add_study(command, options.study);
    add_ensemble(command, "number of gearboxes over all fault sizes", options.study);
    add_results(command, options, "continue an interrupted run, or add gearboxes to a finished one",
                "overwrite the results of another study or any other file; start even if the "
                "memory may not suffice");
    command
        .add_option("--part", options.part,
                    "compute part K of N of the gearboxes, e.g. 2/4; `merge` joins the parts")
        ->type_name("K/N");
    add_progress(command, options);
    command
        .add_option_function<std::vector<std::string>>(
            "--signals",
            [&run = options](const std::vector<std::string>& rows) {
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
    command.add_flag("--quiet", options.quiet, "print problems only");
}

}  // namespace gearpod::mc
