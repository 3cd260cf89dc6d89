// Options of `pod` and `compare`.
#include "mc/options/options.hpp"

namespace gearpod::mc {
namespace {

void add_pod_data(CLI::App& command, PodOptions& pod) {
    command.add_option("table", pod.table, "table (CSV) with one line per inspection")->required();
    command.add_option("--size", pod.size, "column of the flaw size; 0: no flaw (default: size)");
    command
        .add_option("--hit", pod.hits,
                    "column with 1 (hit) or 0 (miss) (default: hit); several columns are repeated "
                    "inspections")
        ->allow_extra_args(false);
    command
        .add_option("--response", pod.values,
                    "column of the response a-hat (default: response); several columns are "
                    "repeated inspections")
        ->allow_extra_args(false);
    command.add_option("--specimen", pod.specimen,
                       "column with the name of the specimen (default: one specimen per line)");
    add_number(command, "--threshold", pod.threshold, "decision threshold of responses");
    add_number(command, "--false-call-rate", pod.false_call_rate,
               "false-call rate; sets the threshold from the responses of size 0",
               from_to(1e-6, 0.5));
    command
        .add_option("--alarm", pod.alarm,
                    "side of the threshold that is a hit: high (default) or low")
        ->check(CLI::IsMember({"high", "low"}));
    add_number(command, "--left", pod.left, "responses at or below this value are left-censored");
    add_number(command, "--right", pod.right,
               "responses at or above this value are right-censored");
}

}  // namespace

void add_pod(CLI::App& app, PodOptions& pod, int& code) {
    auto* command = app.add_subcommand(
        "pod",
        "estimate the probability of detection (POD) from a table of inspections: hit/miss data "
        "or signal responses (a-hat versus a)");
    add_pod_data(*command, pod);
    command
        ->add_option("--link", pod.links,
                     "link function: logit, probit, cloglog, loglog (default: the best fit)")
        ->check(CLI::IsMember({"logit", "probit", "cloglog", "loglog"}))
        ->delimiter(',')
        ->allow_extra_args(false);
    command
        ->add_option("--size-scale", pod.size_scale,
                     "scale of the size: linear or log (default: the better fit)")
        ->check(CLI::IsMember({"linear", "log"}));
    command->add_option("--response-scale", pod.response_scale,
                        "scale of the response: linear, log, box-cox or a power (default: the "
                        "better fit of linear and log)");
    add_number(*command, "--floor", pod.floor,
               "POD of vanishing flaws (default: the false-call rate of size 0)",
               from_to(0.0, 0.999));
    command->add_flag("--fit-ceiling", pod.fit_ceiling,
                      "also fit curves with a maximum POD below 1");
    command->add_flag("--firth", pod.firth,
                      "penalised likelihood (Firth), for hits and misses that sizes separate");
    command
        ->add_option("--convention", pod.convention,
                     "convention of the confidence bounds: calibrated (default; covers the "
                     "confidence in small tables), or the asymptotic handbook (MIL-HDBK-1823A: "
                     "two-sided for hits, one-sided for responses), one-sided, two-sided, joint")
        ->check(CLI::IsMember({"calibrated", "handbook", "one-sided", "two-sided", "joint"}));
    command
        ->add_option("--bounds", pod.bounds,
                     "method of asymptotic bounds: likelihood-ratio (default for hits) or wald "
                     "(default for responses); without --convention: the handbook's")
        ->check(CLI::IsMember({"likelihood-ratio", "wald"}));
    add_number(*command, "--confidence", pod.confidence,
               "confidence level of the bounds (default: 0.95)", from_to(0.5, 0.9999));
    add_number(*command, "--target", pod.target,
               "size that a90/95 must reach; print how many specimens that needs", above(0.0));
    require_file_name(
        command->add_option("--json", pod.json, "write JSON to a file, or - for standard output"));
    require_file_name(
        command->add_option("--html", pod.html, "write a page with figures to a file"));
    require_file_name(command->add_option(
        "--evidence", pod.evidence,
        "write an evidence pack into a folder: a document (PDF) by subjects of MIL-HDBK-1823A, all "
        "tables, the JSON and the hashes of these files"));
    add_force(*command, pod.force);
    command->callback([&] { code = pod_command(pod); });
}

void add_compare(CLI::App& app, CompareOptions& compare, int& code) {
    auto* command = app.add_subcommand(
        "compare",
        "compare detection between results files, for example of two sensors, noises or designs");
    command
        ->add_option("results", compare.results,
                     "results files (HDF5); all others are compared with the first")
        ->required();
    require_file_name(command->add_option("--json", compare.json,
                                          "write JSON to a file, or - for standard output"));
    require_file_name(
        command->add_option("--html", compare.html, "write a page with figures to a file"));
    add_force(*command, compare.force);
    command->callback([&] { code = compare_command(compare); });
}

}  // namespace gearpod::mc
