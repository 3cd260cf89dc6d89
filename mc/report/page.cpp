#include "mc/report/page.hpp"

#include <cstdlib>
#include <nlohmann/json.hpp>
#include <span>
#include <stdexcept>
#include <utility>

#include "mc/files/atomic_file.hpp"
#include "mc/files/child_process.hpp"
#include "mc/files/json_text.hpp"
#include "mc/results/provenance.hpp"

namespace gearpod::mc {
namespace {

[[noreturn]] void fail(const std::string& what) {
    throw std::runtime_error("a file of the report cannot be created: " + what);
}

// Folder of the Python scripts, relative to the running program. In a build folder the scripts are
// next to the program.
std::filesystem::path report_folder() {
    std::error_code none;
    const auto program = std::filesystem::read_symlink("/proc/self/exe", none).parent_path();
    const auto adjacent = program / "report";
    return std::filesystem::exists(adjacent / "build_page.py", none)
               ? adjacent
               : (program / GEARPOD_REPORT_FROM_PROGRAM).lexically_normal();
}

std::string build_page_output(const std::string& json, const std::vector<std::string>& arguments) {
    const char* given = std::getenv("GEARPOD_REPORT_DIR");
    const std::filesystem::path folder =
        given != nullptr && *given != '\0' ? std::filesystem::path(given) : report_folder();
    const std::string program = folder / "build_page.py";
    if (!std::filesystem::exists(program)) {
        fail(program +
             " does not exist; set GEARPOD_REPORT_DIR to the folder analysis/report of gearpod's "
             "sources");
    }
    // -B: write no compiled files next to the sources; -s: ignore the user's own packages.
    std::vector<std::string> words{"-Bs", program, "-"};
    words.insert(words.end(), arguments.begin(), arguments.end());
    try {
        PythonOutput output = run_python(words, json);
        if (output.status == 0 && !output.text.empty()) {
            return std::move(output.text);
        }
        fail(python_interpreter() + " " + program + " " + ended_text(output.status));
    } catch (const PythonError& error) {
        fail(error.what());
    }
}

}  // namespace

std::filesystem::path schema_path() {
    std::error_code none;
    const auto report = std::filesystem::canonical(report_folder(), none);
    for (const char* folder : {"../studies", "../../studies"}) {
        const auto path = (report / folder / "study.schema.json").lexically_normal();
        if (!report.empty() && std::filesystem::exists(path, none)) {
            return path;
        }
    }
    return {};
}

void write_report_page(const std::string& json, const std::string& html,
                       const std::string& figures) {
    if (html.empty() && figures.empty()) {
        return;
    }
    const std::string page =
        build_page_output(json, figures.empty() ? std::vector<std::string>{}
                                                : std::vector<std::string>{"--figures", figures});
    if (!html.empty()) {
        write_file(html, std::as_bytes(std::span(page)));
    }
}

std::string report_summary(const std::string& json) {
    return build_page_output(json, {"--pdf"});
}

std::vector<NamedFile> report_files(const nlohmann::json& report, const std::string& kind) {
    // A line with names and sizes (JSON), then the bytes.
    const std::string output = build_page_output(json_text(report), {kind});
    std::vector<NamedFile> files;
    std::size_t begin = output.find('\n') + 1;
    for (const auto& [name, size] : nlohmann::json::parse(output.substr(0, begin))
                                        .get<std::vector<std::pair<std::string, std::size_t>>>()) {
        files.push_back({name, output.substr(begin, size)});
        begin += size;
    }
    return files;
}

std::vector<NamedFile> evidence_files(nlohmann::json report, const std::string& file) {
    report["evidence"] = {{"file", file}, {"report_by", version_text()}};
    return report_files(report, "--evidence");
}

}  // namespace gearpod::mc
