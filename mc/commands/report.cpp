// Command `report RESULTS`: detection rates, POD and ranking of the results of a run, as text,
// JSON, page, sheet, tables and evidence pack.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>

#include "mc/commands/commands.hpp"
#include "mc/commands/lives.hpp"
#include "mc/commands/options/options.hpp"
#include "mc/commands/output_folder.hpp"
#include "mc/ensemble/ranks.hpp"
#include "mc/ensemble/results_check.hpp"
#include "mc/files/atomic_file.hpp"
#include "mc/files/input/terminal_text.hpp"
#include "mc/files/json_text.hpp"
#include "mc/library/run/command_files.hpp"
#include "mc/report/page.hpp"
#include "mc/report/run_report.hpp"
#include "mc/results/reliability_of_results.hpp"
#include "mc/results/result_rows.hpp"

namespace gearpod::mc {
namespace {

// Writes the requested JSON, tables, page, sheet, figures and evidence. Returns false after
// printing a problem.
bool write_report_files(const ReportOptions& options, const Results& results, const RowSource& rows,
                        const std::optional<analysis::Reliability>& reliability,
                        const RunFindings& run) {
    nlohmann::json json = report_json(results, rows, reliability, run);
    json["results"] = options.results;
    std::vector<OutputFolder> folders;
    if (!options.csv.empty()) {
        folders.push_back({{"--csv", options.csv}, report_files(json, "--csv")});
    }
    if (!options.evidence.empty()) {
        folders.push_back(
            {{"--evidence", options.evidence}, evidence_files(json, options.results)});
    }
    if (!can_write_folders(folders,
                           {{"the results file", options.results},
                            {"--json", options.json},
                            {"--html", options.html},
                            {"--pdf", options.pdf}},
                           options.force) ||
        !write_json_and_page(json, options.json, options.html, options.figures)) {
        return false;
    }
    for (const OutputFolder& folder : folders) {
        write_files(folder);
    }
    if (!options.pdf.empty()) {
        const std::string sheet = report_summary(json_text(json));
        write_file(options.pdf, std::as_bytes(std::span(sheet)));
    }
    return true;
}

int report_command(const ReportOptions& options) {
    const FileRole read{"the results file", options.results}, json{"--json", options.json},
        html{"--html", options.html};
    const bool json_good = can_write(json, {read}, {json_output(), options.force});
    const bool pdf_good =
        can_write({"--pdf", options.pdf}, {read, json, html}, {sheet_output(), options.force});
    const bool html_good = can_write(html, {read, json}, {page_output(), options.force});
    if (!html_good || !json_good || !pdf_good) {
        return kBadInput;
    }
    Results results = read_frame(options.results);
    if (results.provenance_value("kind") == kLivesKind) {
        return report_lives(options);
    }
    const FileRows rows(options.results, results);
    check_results(options.results, results, rows);
    results.detection = detect_all(results, rows);
    const auto reliability = reliability_of(results, rows, options.condition, thread_count());
    const RunFindings run = findings_of_run(results, rows, reliability);
    const std::pair<const char*, const std::string&> outputs[] = {{"page", options.html},
                                                                  {"sheet", options.pdf},
                                                                  {"tables", options.csv},
                                                                  {"figures", options.figures},
                                                                  {"evidence", options.evidence}};
    const bool writes =
        std::ranges::any_of(outputs, [](const auto& output) { return !output.second.empty(); });
    if ((writes || !options.json.empty()) &&
        !write_report_files(options, results, rows, reliability, run)) {
        return kBadInput;
    }
    if (!options.json.empty()) {
        return kDone;
    }
    const std::string state = results.provenance_value("state");
    if (state == "running" || state.starts_with("interrupted")) {
        fmt::print(stderr, "{}: contains {} of {} gearboxes ({})\n", options.results,
                   run.failures.counts.all,
                   printable(results.provenance_value("gearboxes_asked_for")), printable(state));
    }
    ReportOptions printed = options;  // what an option asks for is printed without --section
    if (!options.full && options.sections.empty()) {
        if (!options.condition.empty()) {
            printed.sections.emplace_back("conditions");
        }
    }
    if (!print_report(printed, run.report, !results.provenance_value("part").empty())) {
        return kBadInput;
    }
    for (const auto& [what, where] : outputs) {
        print_written(what, where);
    }
    return kDone;
}

}  // namespace

bool print_report(const ReportOptions& options, const analysis::Report& report, bool part) {
    if (options.sections.empty()) {
        fmt::print("{}", options.full ? report_text(report)
                                      : screen_text(report, screen_end(options.results, part)));
        return true;
    }
    std::vector<std::string> names;
    for (const analysis::Section& section : report.sections) {
        names.push_back(section.key);
    }
    bool good = true;
    for (const std::string& name : options.sections) {
        if (std::ranges::count(names, name) == 0) {
            const bool known = std::ranges::count(kRunSections, name) > 0;
            fmt::print(stderr, "--section {}: {} the report of {}; its sections are {}\n",
                       printable(name), known ? "is empty in" : "is not in", options.results,
                       fmt::join(names, ", "));
            good = good && known;
        }
    }
    fmt::print("{}", good ? report_text(sections_of(report, options.sections)) : "");
    return good;
}

void add_report(CLI::App& app, int& code) {
    const auto [command, options] = add_command<ReportOptions>(
        app, code, "report", "print detection rates, POD and feature ranking from a results file",
        reporting<report_command>);
    command.add_option("results", options.results, "results file (HDF5)")->required();
    add_full(command, options.full);
    command
        .add_option("--section", options.sections,
                    fmt::format("print these sections: {}; of lives: answer, results, basis",
                                fmt::join(kRunSections, ", ")))
        ->type_name("NAME")
        ->allow_extra_args(false);
    add_json(command, options.json);
    add_page(command, options.html);
    add_file(command, "--pdf", options.pdf, "write a one-page summary with its limits to a file");
    add_file(command, "--csv", options.csv, "write all tables into a folder");
    add_file(command, "--figures", options.figures,
             "write the page's figures into a folder, as SVG, PNG and PDF");
    add_file(
        command, "--evidence", options.evidence,
        "write an evidence pack into a folder: a document (PDF) by subjects of EASA AMC1 29.1465 "
        "and MIL-HDBK-1823A, all tables, the JSON, the study and the hashes of these files");
    command.add_option("--by", options.condition,
                       "random input, e.g. torque_N_m; also use a separate threshold for each of "
                       "its values");
    command.add_flag("--show-withheld", options.shows_withheld,
                     "report lives although their signals are interpolated too coarsely");
    add_force(command, options.force);
}

}  // namespace gearpod::mc
