// Options of `report`, `misses` and `rare`.
#include "mc/options/options.hpp"

namespace gearpod::mc {

void add_report(CLI::App& app, ReportOptions& report, int& code) {
    auto* command = app.add_subcommand("report", "detection rates from a results file");
    command->add_option("results", report.results, "results file (HDF5)")->required();
    needs_name(command->add_option("--json", report.json,
                                   "write JSON to a file, or to - for the terminal"));
    needs_name(command->add_option("--html", report.html, "write a page with figures to a file"));
    needs_name(command->add_option("--pdf", report.pdf,
                                   "write the answer with its limits on one sheet to a file"));
    needs_name(command->add_option("--csv", report.csv, "write every table into a folder"));
    needs_name(command->add_option("--figures", report.figures,
                                   "write the page's figures into a folder, as SVG and PNG"));
    command->add_option("--by", report.condition,
                        "random input, e.g. torque_N_m, whose values get thresholds of their own");
    command->add_option(
        "--alarm-cost", report.alarm_cost,
        "of a false alarm; with the next two, the threshold of least expected cost");
    command->add_option("--miss-cost", report.miss_cost, "of a record with a fault that is missed");
    command->add_option("--fault-share", report.fault_share, "share of records that have a fault");
    command->callback([&report, &code] { code = report_command(report); });
}

void add_misses(CLI::App& app, MissesOptions& misses, int& code) {
    auto* command = app.add_subcommand(
        "misses",
        "how often a feature misses a fault of one size, where that is rare: computes gearboxes "
        "with the fault, of each several records whose noise is tilted towards a miss");
    command
        ->add_option("results", misses.results,
                     "results file (HDF5) of run, whose threshold it takes")
        ->required();
    command->add_option("--feature", misses.feature, "feature of the accelerometer")->required();
    command->add_option("--size", misses.size, "fault size, in its unit in the study")->required();
    command->add_option("--noise-level", misses.noise_level,
                        "one of sensor.noise_levels; else 1 or the least above 0");
    command->add_option("--gearboxes", misses.gearboxes, "how many; 200 unless given");
    command->add_option("--records", misses.records,
                        "of each, a multiple of four; 64 unless given");
    needs_name(command->add_option("--json", misses.json,
                                   "write JSON to a file, or to - for the terminal"));
    command->add_flag("--quiet", misses.quiet, "show no progress");
    command->callback([&misses, &code] { code = misses_command(misses); });
}

void add_rare(CLI::App& app, RareOptions& rare, int& code) {
    auto* command = app.add_subcommand(
        "rare",
        "the threshold for rare false alarms, or how often a fault is missed, where gearboxes make "
        "the alarms or misses: lets those that come near them exchange some of their draws, level "
        "by level");
    command
        ->add_option("results", rare.results,
                     "results file (HDF5) of run, whose study and threshold it takes")
        ->required();
    command->add_option("--feature", rare.feature, "feature of the file")->required();
    auto* rate =
        command->add_option("--rate", rare.rate, "of false alarms whose threshold is asked for");
    command
        ->add_option("--size", rare.size,
                     "fault size, in its unit in the study, whose misses are asked for")
        ->excludes(rate);
    command->add_option("--noise-level", rare.noise_level,
                        "one of sensor.noise_levels; else 1 or the least above 0");
    command->add_option("--gearboxes", rare.gearboxes, "of a level; 1000 unless given");
    needs_name(
        command->add_option("--json", rare.json, "write JSON to a file, or to - for the terminal"));
    command->add_flag("--quiet", rare.quiet, "show no progress");
    command->callback([&rare, &code] { code = rare_command(rare); });
}

}  // namespace gearpod::mc
