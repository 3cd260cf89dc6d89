// Command `report RESULTS`: detection rates, POD and ranking of the results of a run, as text,
// JSON, page, sheet, tables, evidence pack and dataset.
#include <fmt/core.h>

#include <exception>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <tuple>

#include "mc/commands/commands.hpp"
#include "mc/commands/lives.hpp"
#include "mc/commands/options/options.hpp"
#include "mc/commands/output_folder.hpp"
#include "mc/ensemble/ranks.hpp"
#include "mc/ensemble/results_check.hpp"
#include "mc/files/atomic_file.hpp"
#include "mc/files/input/problems.hpp"
#include "mc/files/input/terminal_text.hpp"
#include "mc/files/json_text.hpp"
#include "mc/library/run/command_files.hpp"
#include "mc/report/dataset.hpp"
#include "mc/report/numerical_quality.hpp"
#include "mc/report/page.hpp"
#include "mc/report/run_report.hpp"
#include "mc/results/reliability_of_results.hpp"
#include "mc/results/result_rows.hpp"

namespace gearpod::mc {
namespace {

// Files of this command that no file of a folder may overwrite.
std::vector<FileRole> other_files(const ReportOptions& options) {
    return {{"the results file", options.results},
            {"--json", options.json},
            {"--html", options.html},
            {"--pdf", options.pdf}};
}

// Writes the requested JSON, tables, page, sheet, figures and evidence. Returns false after
// printing a problem.
bool write_report_files(const ReportOptions& options, const Results& results, const RowSource& rows,
                        const std::optional<analysis::Reliability>& reliability,
                        const RunFindings& run) {
    nlohmann::json json = report_json(results, rows, reliability, run);
    json["results"] = options.results;
    const auto tables = options.csv.empty() ? std::vector<NamedFile>{} : table_files(json);
    const auto evidence =
        options.evidence.empty() ? std::vector<NamedFile>{} : evidence_files(json, options.results);
    const auto others = other_files(options);
    const bool tables_good =
        can_write_folder({"--csv", options.csv}, tables, others, options.force);
    std::vector<NamedFile> dataset;
    if (!options.dataset.empty()) {
        nlohmann::json source = json;
        source["dataset"] = dataset_json(results, rows.rows(), options.results);
        dataset = dataset_files(source);
    }
    const bool dataset_good =
        can_write_folder({"--dataset", options.dataset}, dataset, others, options.force);
    if (!can_write_folder({"--evidence", options.evidence}, evidence, others, options.force) ||
        !tables_good || !dataset_good) {
        return false;
    }
    if (!options.json.empty() && !write_text_to(options.json, json_text(json, 2) + "\n")) {
        return false;
    }
    if (!options.csv.empty()) {
        write_files(options.csv, tables);
    }
    if (!options.evidence.empty()) {
        write_files(options.evidence, evidence);
    }
    if (!options.dataset.empty()) {
        write_files(options.dataset, dataset);
    }
    if (!options.pdf.empty()) {
        const std::string sheet = report_summary(json_text(json));
        write_file(options.pdf, std::as_bytes(std::span(sheet)));
    }
    write_report_page(json_text(json), options.html, options.figures);
    return true;
}

// Reads the cost options: all three or none. Returns false after printing the problem.
bool read_costs(const ReportOptions& options, std::optional<analysis::Costs>& costs) {
    const auto& [alarm, miss, share] =
        std::tie(options.alarm_cost, options.miss_cost, options.fault_share);
    if (!alarm && !miss && !share) {
        return true;
    }
    if (!alarm || !miss || !share) {
        fmt::print(stderr,
                   "--alarm-cost, --miss-cost, --fault-share: expected costs need all "
                   "three\n");
        return false;
    }
    costs = analysis::Costs{*alarm, *miss, *share};
    return true;
}

int report_command(const ReportOptions& options) {
    const FileRole read{"the results file", options.results}, json{"--json", options.json},
        html{"--html", options.html};
    const bool json_good = can_write(json, {read}, {json_output(), options.force});
    const bool pdf_good =
        can_write({"--pdf", options.pdf}, {read, json, html}, {sheet_output(), options.force});
    std::optional<analysis::Costs> costs;
    const bool costs_good = read_costs(options, costs);
    const bool html_good = can_write(html, {read, json}, {page_output(), options.force});
    if (!html_good || !json_good || !pdf_good || !costs_good) {
        return kBadInput;
    }
    try {
        Results results = read_frame(options.results);
        if (results.provenance_value("kind") == kLivesKind) {
            return report_lives(options);
        }
        const FileRows rows(options.results, results);
        check_results(options.results, results, rows);
        results.detection = detect_all(results, rows);
        const auto reliability = reliability_of(results, rows, options.condition, thread_count(),
                                                kMostAssessedValues, costs);
        const RunFindings run = findings_of_run(results, rows, reliability);
        if (!options.json.empty() || !options.html.empty() || !options.pdf.empty() ||
            !options.csv.empty() || !options.figures.empty() || !options.evidence.empty() ||
            !options.dataset.empty()) {
            if (!write_report_files(options, results, rows, reliability, run)) {
                return kBadInput;
            }
        }
        if (!options.json.empty()) {
            return kDone;
        }
        const std::string state = results.provenance_value("state");
        if (state == "running" || state.starts_with("interrupted")) {
            fmt::print(stderr, "{}: contains {} of {} gearboxes ({})\n", options.results,
                       count_rows(rows, results.request.threshold_records).all,
                       printable(results.provenance_value("gearboxes_asked_for")),
                       printable(state));
        }
        fmt::print("{}", report_text(run.report));
        const std::pair<const char*, const std::string&> written[] = {
            {"page", options.html},         {"sheet", options.pdf},
            {"tables", options.csv},        {"figures", options.figures},
            {"evidence", options.evidence}, {"dataset", options.dataset}};
        for (const auto& [what, where] : written) {
            if (!where.empty()) {
                fmt::print("\n{}: {}\n", what, where);
            }
        }
    } catch (const std::exception& error) {
        fmt::print(stderr, "{}\n", exception_text(error));
        return kBadInput;
    }
    return kDone;
}

}  // namespace

void add_report(CLI::App& app, int& code) {
    const auto options = std::make_shared<ReportOptions>();
    auto* command = app.add_subcommand(
        "report", "print detection rates, POD and feature ranking from a results file");
    command->add_option("results", options->results, "results file (HDF5)")->required();
    add_json(*command, options->json);
    add_page(*command, options->html);
    require_file_name(command->add_option("--pdf", options->pdf,
                                          "write a one-page summary with its limits to a file"));
    require_file_name(command->add_option("--csv", options->csv, "write all tables into a folder"));
    require_file_name(command->add_option(
        "--figures", options->figures, "write the page's figures into a folder, as SVG and PNG"));
    require_file_name(command->add_option(
        "--evidence", options->evidence,
        "write an evidence pack into a folder: a document (PDF) by subjects of EASA AMC1 29.1465 "
        "and MIL-HDBK-1823A, all tables, the JSON, the study and the hashes of these files"));
    require_file_name(command->add_option(
        "--dataset", options->dataset,
        "write a dataset for machine learning into a folder: features with labels, fault sizes and "
        "gearboxes, split by gearbox for training, validation and test (CSV), stored signals, and "
        "a data card"));
    command->add_option("--by", options->condition,
                        "random input, e.g. torque_N_m; also use a separate threshold for each of "
                        "its values");
    add_number(*command, "--alarm-cost", options->alarm_cost,
               "cost of a false alarm; with the next two options, find the threshold of least "
               "expected cost",
               at_least(0.0));
    add_number(*command, "--miss-cost", options->miss_cost, "cost of a missed fault",
               at_least(0.0));
    add_number(*command, "--fault-share", options->fault_share,
               "share of records that have a fault", from_to(0.0, 1.0));
    command->add_flag("--show-withheld", options->shows_withheld,
                      "report lives although their signals are interpolated too coarsely");
    add_force(*command, options->force);
    command->callback([options, &code] { code = report_command(*options); });
}

}  // namespace gearpod::mc
