#include "mc/library/run/command_files.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <exception>
#include <filesystem>
#include <fstream>
#include <span>
#include <utility>

#include "analysis/report/false_alarm_text.hpp"
#include "mc/files/atomic_file.hpp"
#include "mc/files/child_process.hpp"
#include "mc/files/hdf5_data.hpp"
#include "mc/files/input/terminal_text.hpp"
#include "mc/results/results_file.hpp"

namespace gearpod::mc {
namespace {

// Beginning of a file, after a byte order mark and blanks.
std::string beginning_of(const std::string& path) {
    constexpr std::size_t kRead = 4096;
    std::ifstream stream(path, std::ios::binary);
    std::string text(kRead, '\0');
    stream.read(text.data(), kRead);
    text.resize(static_cast<std::size_t>(stream.gcount()));
    text.erase(0, text.starts_with("\xEF\xBB\xBF") ? 3 : 0);
    text.erase(0, std::min(text.find_first_not_of(" \t\r\n"), text.size()));
    return text;
}

bool is_recordings(const std::string& path) {
    try {
        return read_unverified_results(path).provenance_value("kind") == kRecordingsKind;
    } catch (const std::exception&) {
        return false;
    }
}

bool has_simulated_signals(const std::string& path) {
    const Hdf5Handle file = open_file(path, path);
    const auto attributes = attribute_names(file.get());
    const auto links = link_names(file.get());
    return std::ranges::count(attributes, "code_version") == 1 &&
           std::ranges::count(attributes, "format") == 0 &&
           std::ranges::count(links, "signals") == 1;
}

bool is_simulated(const std::string& path) {
    if (!survives_reading(path, [&] { has_simulated_signals(path); })) {
        return false;
    }
    try {
        return has_simulated_signals(path);
    } catch (const Hdf5Error&) {
        return false;
    }
}

}  // namespace

OutputKind text_output(const std::string& name, const std::string& beginning) {
    return {name, [beginning](const std::string& path) {
                return beginning_of(path).starts_with(beginning);
            }};
}

OutputKind json_output() {
    return text_output("JSON", "{");
}

OutputKind page_output() {
    return text_output("a page (HTML)", "<!DOCTYPE html>");
}

OutputKind sheet_output() {
    return text_output("a sheet (PDF)", "%PDF-");
}

OutputKind recordings_output() {
    return {"results of recordings (HDF5)", is_recordings};
}

OutputKind signals_output() {
    return {"signals of `simulate` (HDF5)", is_simulated};
}

std::string why_not_replaced(const std::string& path, const Overwriting& overwriting) {
    std::error_code none;
    const bool file = std::filesystem::is_regular_file(path, none);
    if (!file || std::filesystem::file_size(path, none) == 0 || overwriting.force ||
        overwriting.kind.matches(path)) {
        return "";
    }
    return "is a file of another kind than this output, " + overwriting.kind.name +
           "; name another file, or replace this one with --force";
}

void print_problems(const Problems& problems) {
    fmt::print(stderr, "{}", format(problems));
}

std::optional<Study> load_study(const StudyOptions& options) {
    StudyReading reading = read_study(options.path, options.overrides);
    print_problems(reading.study ? reading.notices : reading.problems);
    return std::move(reading.study);
}

StudyScene make_scene(const StudyOptions& options, Choosing choosing) {
    return make_scene(options.path, read_study(options.path, options.overrides), choosing);
}

StudyScene load_scene(const StudyOptions& options) {
    StudyScene made = make_scene(options);
    print_problems(made ? made.notices : made.problems);
    return made;
}

void warn_of_shortage(const EnsemblePlan& plan, const std::string& path) {
    for (const std::string& shortage :
         {plan.healthy_shortage(), analysis::size_shortage(plan.test_gearboxes, plan.request)}) {
        if (!shortage.empty()) {
            fmt::print(stderr, "{}\n",
                       wrapped_text(fmt::format("{}: warning: {}", path, shortage), 2));
        }
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
