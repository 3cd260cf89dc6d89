#include "mc/run/support.hpp"

#include <fmt/core.h>

#include <exception>
#include <filesystem>
#include <span>
#include <utility>

#include "analysis/report/false_alarm_text.hpp"
#include "mc/files/atomic_file.hpp"
#include "mc/input/printable.hpp"
#include "mc/input/wrapped_text.hpp"

namespace gearpod::mc {

void print_problems(const Problems& problems) {
    fmt::print(stderr, "{}", format(problems));
}

std::optional<Study> load_study(const StudyOptions& options) {
    StudyReading reading = read_study(options.path, options.overrides);
    print_problems(reading.study ? reading.notices : reading.problems);
    return std::move(reading.study);
}

StudyScene make_scene(const StudyOptions& options) {
    return make_scene(options.path, read_study(options.path, options.overrides));
}

StudyScene load_scene(const StudyOptions& options) {
    StudyScene made = make_scene(options);
    print_problems(made ? made.notices : made.problems);
    return made;
}

std::string shortage_of(const Study& study) {
    const Ensemble& ensemble = study.ensemble;
    return analysis::sample_shortage(ensemble.threshold_instances, study.detection.false_alarm_rate,
                                     study.detection.confidence, analysis::Subject::gearboxes,
                                     ensemble.threshold_records,
                                     ensemble.uses_importance_sampling());
}

void warn_of_shortage(const Study& study, const std::string& path) {
    if (const std::string shortage = shortage_of(study); !shortage.empty()) {
        fmt::print(stderr, "{}\n", wrapped_text(fmt::format("{}: warning: {}", path, shortage), 2));
    }
}

bool can_write(const FileRole& output, const std::vector<FileRole>& others) {
    if (output.path.empty() || output.path == "-") {
        return true;
    }
    for (const auto& [role, path] : others) {
        if (path != "-" && same_file(output.path, path)) {
            fmt::print(stderr, "{} {}: is also {} and would overwrite it; name another file\n",
                       output.role, output.path, role);
            return false;
        }
    }
    const std::string reason = why_not_writable(output.path);
    if (!reason.empty()) {
        fmt::print(stderr, "{}: cannot be written: {}\n", output.path, reason);
    }
    return reason.empty();
}

bool can_write(const FileRole& output, const std::vector<FileRole>& others,
               const Overwriting& overwriting) {
    if (!can_write(output, others)) {
        return false;
    }
    const bool is_file = !output.path.empty() && output.path != "-";
    const std::string why = is_file ? why_not_replaced(output.path, overwriting) : "";
    if (!why.empty()) {
        fmt::print(stderr, "{} {}: {}\n", output.role, printable(output.path), why);
    }
    return why.empty();
}

bool can_write_json_and_page(const std::string& json, const std::string& html,
                             std::vector<FileRole> read, bool force) {
    const bool json_good = can_write({"--json", json}, read, {json_output(), force});
    read.push_back({"--json", json});
    return can_write({"--html", html}, read, {page_output(), force}) && json_good;
}

bool write_text_to(const std::string& path, const std::string& text) {
    if (path == "-") {
        fmt::print("{}", text);
        return true;
    }
    try {
        write_file(path, std::as_bytes(std::span(text)));
    } catch (const std::exception& error) {
        fmt::print(stderr, "{}\n", error.what());
        return false;
    }
    return true;
}

std::string why_no_results_name(const std::string& path) {
    constexpr std::pair<const char*, const char*> kKinds[] = {{".csv", "report {} --csv DIR"},
                                                              {".tsv", "report {} --csv DIR"},
                                                              {".txt", "report {}"},
                                                              {".json", "report {} --json F.json"},
                                                              {".html", "report {} --html F.html"},
                                                              {".htm", "report {} --html F.html"},
                                                              {".png", "report {} --figures DIR"},
                                                              {".svg", "report {} --figures DIR"},
                                                              {".pdf", "report {} --pdf F.pdf"},
                                                              {".xlsx", "report {} --csv DIR"},
                                                              {".mat", ""},
                                                              {".toml", ""}};
    const std::filesystem::path name(path);
    for (const auto& [kind, command] : kKinds) {
        if (name.extension() == kind) {
            const std::string right = std::filesystem::path(name).replace_extension(".h5").string();
            const std::string then = fmt::format(fmt::runtime(command), right);
            return fmt::format("the results are HDF5; name {}{}", right,
                               then.empty() ? "" : ", then gearpod " + then);
        }
    }
    return "";
}

}  // namespace gearpod::mc
