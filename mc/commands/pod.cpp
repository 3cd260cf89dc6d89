// Command `pod TABLE`: probability of detection (POD) from a table of inspections.

#include <nlohmann/json.hpp>
#include <stdexcept>

#include "analysis/report/inspection_report.hpp"
#include "mc/commands/commands.hpp"
#include "mc/commands/options/options.hpp"
#include "mc/commands/output_folder.hpp"
#include "mc/files/input/terminal_text.hpp"
#include "mc/files/signal_file.hpp"
#include "mc/library/inspection_table.hpp"
#include "mc/library/run/command_files.hpp"
#include "mc/report/page.hpp"

namespace gearpod::mc {

namespace {

struct PodOptions : InspectionOptions {
    std::string table;
    std::string json, html;  // "": none; JSON "-": standard output
    bool full = false;       // prints all findings
    std::string evidence;    // folder for the evidence pack; "": none
    bool force = false;      // replaces outputs of another kind
};

InspectedTable read_inspections(const PodOptions& options) {
    try {
        return inspect_table(read_text_table(options.table), options);
    } catch (const SignalError& error) {
        throw std::runtime_error(printable(error.what()));
    }
}

int pod_command(const PodOptions& options) {
    const FileRole read{"the table", options.table};
    if (!can_write_json_and_page(options.json, options.html, {read}, options.force)) {
        return kBadInput;
    }
    const InspectedTable inspected = read_inspections(options);
    const nlohmann::json all = inspection_json(inspected);
    if (!options.evidence.empty()) {
        const OutputFolder folder{{"--evidence", options.evidence},
                                  evidence_files(all, options.table)};
        if (!can_write_folders({folder}, {read, {"--json", options.json}, {"--html", options.html}},
                               options.force)) {
            return kBadInput;
        }
        write_files(folder);
    }
    if (!write_json_and_page(all, options.json, options.html)) {
        return kBadInput;
    }
    if (!options.json.empty()) {
        return kDone;
    }
    print_findings(
        analysis::inspection_report(inspected.request, inspected.result, inspected.names),
        options.full);
    print_written("page", options.html);
    print_written("evidence", options.evidence);
    return kDone;
}

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

void add_pod(CLI::App& app, int& code) {
    const auto [command, options] = add_command<PodOptions>(
        app, code, "pod",
        "estimate the probability of detection (POD) from a table of inspections: hit/miss data "
        "or signal responses (a-hat versus a)",
        reporting<pod_command>);
    add_pod_data(command, options);
    command
        .add_option("--link", options.links,
                    "link function: logit, probit, cloglog, loglog (default: the best fit)")
        ->check(CLI::IsMember({"logit", "probit", "cloglog", "loglog"}))
        ->delimiter(',')
        ->allow_extra_args(false);
    command
        .add_option("--size-scale", options.size_scale,
                    "scale of the size: linear or log (default: the better fit)")
        ->check(CLI::IsMember({"linear", "log"}));
    command.add_option("--response-scale", options.response_scale,
                       "scale of the response: linear, log, box-cox or a power (default: the "
                       "better fit of linear and log)");
    add_number(command, "--floor", options.floor,
               "POD of vanishing flaws (default: the false-call rate of size 0)",
               from_to(0.0, 0.999));
    command.add_flag("--fit-ceiling", options.fit_ceiling,
                     "also fit curves with a maximum POD below 1");
    command.add_flag("--firth", options.firth,
                     "penalised likelihood (Firth), for hits and misses that sizes separate");
    command
        .add_option("--convention", options.convention,
                    "convention of the confidence bounds: calibrated (default; covers the "
                    "confidence in small tables), or the asymptotic handbook (MIL-HDBK-1823A: "
                    "two-sided for hits, one-sided for responses), one-sided, two-sided, joint")
        ->check(CLI::IsMember({"calibrated", "handbook", "one-sided", "two-sided", "joint"}));
    command
        .add_option("--bounds", options.bounds,
                    "method of asymptotic bounds: likelihood-ratio (default for hits) or wald "
                    "(default for responses); without --convention: the handbook's")
        ->check(CLI::IsMember({"likelihood-ratio", "wald"}));
    add_number(command, "--confidence", options.confidence,
               "confidence level of the bounds (default: 0.95)", from_to(0.5, 0.9999));
    add_number(command, "--target", options.target,
               "size that a90/95 must reach; print how many specimens that needs", above(0.0));
    add_full(command, options.full);
    add_json(command, options.json);
    add_page(command, options.html);
    add_file(
        command, "--evidence", options.evidence,
        "write an evidence pack into a folder: a document (PDF) by subjects of MIL-HDBK-1823A, all "
        "tables, the JSON and the hashes of these files");
    add_force(command, options.force);
}

}  // namespace gearpod::mc
