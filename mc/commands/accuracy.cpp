#include <fmt/core.h>

#include <exception>

#include "mc/accuracy/report.hpp"
#include "mc/commands/commands.hpp"
#include "mc/input/exception_text.hpp"
#include "mc/report/page.hpp"
#include "mc/run/support.hpp"
#include "mc/study/other_sources.hpp"

namespace gearpod::mc {

int accuracy_command(const AccuracyOptions& options) {
    std::vector<FileRole> others{{"the study", options.study.path}, {"--peers", options.peers}};
    const bool json_good =
        can_write({"--json", options.json}, others, {json_output(), options.force});
    others.push_back({"--json", options.json});
    const bool writable =
        can_write({"--html", options.html}, others, {page_output(), options.force}) && json_good;
    const auto made = load_scene(options.study);
    if (!made || !writable) {
        return kBadInput;
    }
    const Study& study = made.scene->study();
    if (study.effects.quasi_static()) {
        print_problems({{options.study.path, 0, "effects.motion",
                         "a quasi-static study has no time integration, so there are no solver "
                         "settings to compare",
                         "choose a motion with inertia, e.g. \"translational-torsional\""}});
        return kBadInput;
    }
    if (is_coupled(study)) {
        print_problems({{options.study.path, 0, "sensor.stages",
                         "stages that elastic shafts couple are integrated by one method only, so "
                         "there are no solver settings to compare",
                         "remove shaft_stiffness_N_m_rad, or compare the settings of each stage's "
                         "own study"}});
        return kBadInput;
    }
    AccuracyRequest request;
    request.repeats = options.repeats;
    request.gearboxes = options.gearboxes;
    request.seconds = options.seconds;
    if (!options.quiet) {
        request.progress = [](const std::string& text) { fmt::print(stderr, "{}\n", text); };
    }
    try {
        std::vector<PeerResult> peers;
        if (!options.peers.empty()) {
            peers = read_peers(options.peers);
        }
        AccuracyReport report = measure_accuracy(study, request);
        report.peers = std::move(peers);
        const bool terminal = options.json == "-";
        if (!terminal) {
            fmt::print("{}", accuracy_text(report));
        }
        const std::string json = accuracy_json(report, study);
        if (!options.json.empty() && !write_text_to(options.json, json)) {
            return kBadInput;
        }
        write_report_page(json, options.html, options.figures);
        if (!options.html.empty() && !terminal) {
            fmt::print("\npage: {}\n", options.html);
        }
        return kDone;
    } catch (const SceneError& error) {
        print_problems({{options.study.path, 0, error.key(), error.what(), error.remedy()}});
    } catch (const std::exception& error) {
        fmt::print(stderr, "{}\n", exception_text(error));
    }
    return kBadInput;
}

}  // namespace gearpod::mc
