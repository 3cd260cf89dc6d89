// Options of `sweep`.
#include "mc/options/options.hpp"

namespace gearpod::mc {

void add_sweep(CLI::App& app, SweepOptions& options, int& code) {
    auto* command = app.add_subcommand(
        "sweep",
        "run a study at every combination of some key values, with the same random numbers, and "
        "compare the results; finished points are not computed again");
    add_study(*command, options.study);
    command
        ->add_option("--vary", options.vary,
                     "key to vary and its values, e.g. sensor.noise_m_s2=[0.5,1,2]; repeat the "
                     "option for more keys")
        ->type_name("SECTION.KEY=[A,B,...]")
        ->required()
        ->allow_extra_args(false);
    command->add_flag("--lives", options.lives,
                      "run `lives` instead of `run`: cracks found before tooth failure, warning "
                      "times and false alarms at every combination");
    add_shorthand(*command, "--instances", "ensemble.instances",
                  "number of gearboxes over all fault sizes", options.study);
    add_shorthand(*command, "--seed", "ensemble.seed", "seed of all random numbers", options.study);
    require_file_name(
        command->add_option("--out", options.out,
                            "folder of the results files (default: the study's name with -sweep)"));
    require_file_name(command->add_option("--json", options.json,
                                          "write JSON to a file, or - for standard output"));
    require_file_name(
        command->add_option("--html", options.html, "write a page with curves to a file"));
    command->add_flag("--force", options.force,
                      "overwrite the results of another study or any other file");
    command->add_flag("--quiet", options.quiet, "show no progress");
    command->callback([&options, &code] { code = sweep_command(options); });
}

}  // namespace gearpod::mc
