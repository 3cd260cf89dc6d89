#include <fmt/core.h>

#include "mc/commands/commands.hpp"
#include "mc/commands/options/options.hpp"
#include "mc/commands/output_folder.hpp"
#include "mc/library/run/command_files.hpp"
#include "mc/numerics/accuracy/report.hpp"

namespace gearpod::mc {

namespace {

struct AccuracyOptions {
    StudyOptions study;
    std::string json;               // "": none; "-": standard output instead of the table
    std::string html, figures;      // page and folder of its figures; "": none
    std::string peers;              // table of other programs' results, "": none
    int repeats = 3;                // timings of each solver setting
    std::optional<long> gearboxes;  // size of the pilot ensemble; 0: no detection rates
    double seconds = 300.0;         // limit of processor time; 0: none
    bool force = false;             // replaces outputs of another kind
    bool quiet = false;
};

int accuracy_command(const AccuracyOptions& options) {
    const bool writable = can_write_json_and_page(
        options.json, options.html, {{"the study", options.study.path}, {"--peers", options.peers}},
        options.force);
    const auto made = load_scene(options.study);
    if (!made || !writable) {
        return kBadInput;
    }
    AccuracyRequest request;
    request.repeats = options.repeats;
    request.gearboxes = options.gearboxes;
    request.seconds = options.seconds;
    if (!options.quiet) {
        request.progress = [](const std::string& text) { fmt::print(stderr, "{}\n", text); };
    }
    const Planner& planner = *made.planner;
    planner.check_choice();
    std::vector<PeerResult> peers;
    if (!options.peers.empty()) {
        peers = read_peers(options.peers);
    }
    AccuracyReport report = measure_accuracy(planner, request);
    report.peers = std::move(peers);
    const bool terminal = options.json == "-";
    if (!terminal) {
        fmt::print("{}", accuracy_text(report));
    }
    const std::string json = accuracy_json(report, made.scene->ensemble());
    if (!options.json.empty() && !write_text_to(options.json, json)) {
        return kBadInput;
    }
    write_report_page(json, options.html, options.figures);
    if (!terminal) {
        print_written("page", options.html);
    }
    return kDone;
}

}  // namespace

void add_accuracy(CLI::App& app, int& code) {
    const auto [command, options] = add_command<AccuracyOptions>(
        app, code, "accuracy",
        "compare solver settings for a study: numerical error and computing time of each",
        reporting<accuracy_command>);
    add_study(command, options.study);
    add_json(command, options.json);
    add_file(command, "--html", options.html,
             "write a page with work-precision diagrams to a file");
    add_file(command, "--figures", options.figures,
             "write the page's figures into a folder, as SVG, PNG and PDF");
    command.add_option("--peers", options.peers,
                       "table (CSV) with results of other programs, for comparison");
    add_number(command, "--repeats", options.repeats,
               "number of timings of each solver setting (default: 3)", from_to(1, 1000));
    add_number(command, "--gearboxes", options.gearboxes,
               "number of gearboxes whose detection rates are compared; 0: none (default: 480, or "
               "as many as the time allows)",
               from_to(0, 1e6));
    add_number(command, "--seconds", options.seconds,
               "processor time after which remaining parts are omitted; 0: no limit (default: 300)",
               from_to(0.0, 1e9, "s"));
    add_force(command, options.force);
    command.add_flag("--quiet", options.quiet, "show no progress");
}

}  // namespace gearpod::mc
