// Options of `report`, `repair`, `misses` and `rare`.
#include "mc/options/options.hpp"

namespace gearpod::mc {

void add_report(CLI::App& app, ReportOptions& report, int& code) {
    auto* command = app.add_subcommand(
        "report", "print detection rates, POD and feature ranking from a results file");
    command->add_option("results", report.results, "results file (HDF5)")->required();
    require_file_name(command->add_option("--json", report.json,
                                          "write JSON to a file, or - for standard output"));
    require_file_name(
        command->add_option("--html", report.html, "write a page with figures to a file"));
    require_file_name(command->add_option("--pdf", report.pdf,
                                          "write a one-page summary with its limits to a file"));
    require_file_name(command->add_option("--csv", report.csv, "write all tables into a folder"));
    require_file_name(command->add_option(
        "--figures", report.figures, "write the page's figures into a folder, as SVG and PNG"));
    require_file_name(command->add_option(
        "--evidence", report.evidence,
        "write an evidence pack into a folder: a document (PDF) by subjects of EASA AMC1 29.1465 "
        "and MIL-HDBK-1823A, all tables, the JSON, the study and the hashes of these files"));
    require_file_name(command->add_option(
        "--dataset", report.dataset,
        "write a dataset for machine learning into a folder: features with labels, fault sizes and "
        "gearboxes, split by gearbox for training, validation and test (CSV), stored signals, and "
        "a data card"));
    command->add_option("--by", report.condition,
                        "random input, e.g. torque_N_m; also use a separate threshold for each of "
                        "its values");
    add_number(*command, "--alarm-cost", report.alarm_cost,
               "cost of a false alarm; with the next two options, find the threshold of least "
               "expected cost",
               at_least(0.0));
    add_number(*command, "--miss-cost", report.miss_cost, "cost of a missed fault", at_least(0.0));
    add_number(*command, "--fault-share", report.fault_share, "share of records that have a fault",
               from_to(0.0, 1.0));
    command->add_flag("--show-withheld", report.shows_withheld,
                      "report lives although their signals are interpolated too coarsely");
    add_force(*command, report.force);
    command->callback([&report, &code] { code = report_command(report); });
}

void add_repair(CLI::App& app, RepairOptions& repair, int& code) {
    auto* command = app.add_subcommand(
        "repair",
        "renew the integrity hash of a results file that another program has changed on purpose or "
        "written anew; the file is read completely first");
    command->add_option("results", repair.results, "results file (HDF5)")->required();
    command->callback([&repair, &code] { code = repair_command(repair); });
}

void add_misses(CLI::App& app, MissesOptions& misses, int& code) {
    auto* command = app.add_subcommand(
        "misses",
        "estimate how often a feature misses a fault of one size, when misses are rare and due to "
        "noise (importance sampling of the noise)");
    command
        ->add_option("results", misses.results,
                     "results file (HDF5) of `run`; gives the study and the threshold")
        ->required();
    command->add_option("--feature", misses.feature, "feature of the acceleration signal")
        ->required();
    add_number(*command, "--size", misses.size, "fault size, in the unit of the study")->required();
    add_number(*command, "--noise-level", misses.noise_level,
               "one of sensor.noise_levels (default: 1, or the first above 0)");
    add_number(*command, "--gearboxes", misses.gearboxes, "number of gearboxes (default: 200)");
    add_number(*command, "--records", misses.records,
               "records of each gearbox, a multiple of four (default: 64)");
    require_file_name(command->add_option("--json", misses.json,
                                          "write JSON to a file, or - for standard output"));
    command->add_flag("--quiet", misses.quiet, "show no progress");
    add_force(*command, misses.force);
    command->callback([&misses, &code] { code = misses_command(misses); });
}

void add_rare(CLI::App& app, RareOptions& rare, int& code) {
    auto* command = app.add_subcommand(
        "rare",
        "estimate the threshold of rare false alarms, or a rare miss rate, when they are due to "
        "variation between gearboxes (multilevel splitting)");
    command
        ->add_option("results", rare.results,
                     "results file (HDF5) of `run`; gives the study and the threshold")
        ->required();
    command->add_option("--feature", rare.feature, "feature of the file")->required();
    auto* rate = add_number(*command, "--rate", rare.rate, "false-alarm rate; find its threshold");
    add_number(*command, "--size", rare.size,
               "fault size, in the unit of the study; find its miss rate")
        ->excludes(rate);
    add_number(*command, "--noise-level", rare.noise_level,
               "one of sensor.noise_levels (default: 1, or the first above 0)");
    add_number(*command, "--gearboxes", rare.gearboxes,
               "number of gearboxes of each level (default: 1000)");
    require_file_name(
        command->add_option("--json", rare.json, "write JSON to a file, or - for standard output"));
    command->add_flag("--quiet", rare.quiet, "show no progress");
    add_force(*command, rare.force);
    command->callback([&rare, &code] { code = rare_command(rare); });
}

}  // namespace gearpod::mc
