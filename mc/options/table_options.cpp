// Options of `pod` and `compare`.
#include "mc/options/options.hpp"

namespace gearpod::mc {
namespace {

void add_pod_data(CLI::App& command, PodOptions& pod) {
    command.add_option("table", pod.table, "table of inspections (CSV), a line each")->required();
    command.add_option("--size", pod.size, "column of the flaw's size; 0: no flaw (default: size)");
    command
        .add_option("--hit", pod.hits,
                    "column of 1 (hit) and 0 (miss) (default: hit); several are repeated "
                    "inspections of the line's specimen")
        ->allow_extra_args(false);
    command
        .add_option("--response", pod.values,
                    "column of the response, a-hat (default: response); several are repeats")
        ->allow_extra_args(false);
    command.add_option("--specimen", pod.specimen,
                       "column that names the specimen (default: each line its own)");
    command.add_option("--threshold", pod.threshold, "decision threshold of responses");
    command
        .add_option("--false-call-rate", pod.false_call_rate,
                    "sets the threshold from the responses of size 0")
        ->check(CLI::Range(1e-6, 0.5));
    command.add_option("--alarm", pod.alarm, "the side that is a hit: high (default) or low")
        ->check(CLI::IsMember({"high", "low"}));
    command.add_option("--left", pod.left, "responses at or below are only known to be so");
    command.add_option("--right", pod.right, "responses at or above are only known to be so");
}

}  // namespace

void add_pod(CLI::App& app, PodOptions& pod, int& code) {
    auto* command = app.add_subcommand(
        "pod", "probability of detection from a table of inspections, hit/miss or a-hat against a");
    add_pod_data(*command, pod);
    command->add_option("--link", pod.links, "logit, probit, cloglog, loglog (default: the best)")
        ->check(CLI::IsMember({"logit", "probit", "cloglog", "loglog"}))
        ->delimiter(',')
        ->allow_extra_args(false);
    command->add_option("--size-scale", pod.size_scale, "linear or log (default: the better)")
        ->check(CLI::IsMember({"linear", "log"}));
    command->add_option("--response-scale", pod.response_scale,
                        "linear, log, box-cox or a power (default: the better of linear and log)");
    command->add_option("--floor", pod.floor, "POD of the smallest flaws (default: false calls)")
        ->check(CLI::Range(0.0, 0.999));
    command->add_flag("--fit-ceiling", pod.fit_ceiling, "also curves that stay below 1");
    command->add_flag("--firth", pod.firth, "penalised likelihood, where data separate");
    command
        ->add_option("--convention", pod.convention,
                     "of bounds: handbook (default; two-sided for hits, one-sided for responses), "
                     "one-sided, two-sided, joint")
        ->check(CLI::IsMember({"handbook", "one-sided", "two-sided", "joint"}));
    command
        ->add_option("--bounds", pod.bounds,
                     "likelihood-ratio (default for hits) or wald (default for responses)")
        ->check(CLI::IsMember({"likelihood-ratio", "wald"}));
    command->add_option("--confidence", pod.confidence, "of the bounds (default: 0.95)")
        ->check(CLI::Range(0.5, 0.9999));
    command->add_option("--target", pod.target, "size at which a90's bound is wanted")
        ->check(CLI::PositiveNumber);
    needs_name(command->add_option("--json", pod.json, "write JSON to a file, or to -"));
    needs_name(command->add_option("--html", pod.html, "write a page with figures to a file"));
    command->callback([&] { code = pod_command(pod); });
}

void add_compare(CLI::App& app, CompareOptions& compare, int& code) {
    auto* command = app.add_subcommand(
        "compare", "what a change of sensor, feature, noise or design does to detection");
    command->add_option("results", compare.results, "results files (HDF5); held against the first")
        ->required();
    needs_name(command->add_option("--json", compare.json, "write JSON to a file, or to -"));
    needs_name(command->add_option("--html", compare.html, "write a page with figures to a file"));
    command->callback([&] { code = compare_command(compare); });
}

}  // namespace gearpod::mc
