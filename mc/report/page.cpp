#include "mc/report/page.hpp"

#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <memory>
#include <span>
#include <stdexcept>
#include <vector>

#include "mc/files/atomic_file.hpp"

namespace gearpod::mc {
namespace {

[[noreturn]] void fail(const std::string& what) {
    throw std::runtime_error("the page cannot be created: " + what);
}

std::string from_environment(const char* name, const std::string& otherwise) {
    const char* value = std::getenv(name);
    return value != nullptr && *value != '\0' ? value : otherwise;
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

// Unnamed temporary file, deleted when it is closed.
using TemporaryFile = std::unique_ptr<FILE, int (*)(FILE*)>;

TemporaryFile temporary_file(const std::string& text) {
    TemporaryFile file(std::tmpfile(), std::fclose);
    if (!file || std::fwrite(text.data(), 1, text.size(), file.get()) != text.size() ||
        std::fflush(file.get()) != 0 || lseek(fileno(file.get()), 0, SEEK_SET) != 0) {
        fail(std::string("no temporary file: ") + std::strerror(errno));
    }
    return file;
}

std::string content(FILE* file) {
    std::rewind(file);
    std::string text;
    std::array<char, 65536> buffer;
    while (const std::size_t count = std::fread(buffer.data(), 1, buffer.size(), file)) {
        text.append(buffer.data(), count);
    }
    return text;
}

// Runs a program. Returns its exit code, or 128 plus the number of the signal that ended it.
int run(const std::vector<std::string>& words, FILE* input, FILE* output) {
    std::vector<char*> arguments;
    for (const std::string& word : words) {
        arguments.push_back(const_cast<char*>(word.c_str()));
    }
    arguments.push_back(nullptr);
    posix_spawn_file_actions_t streams;
    posix_spawn_file_actions_init(&streams);
    posix_spawn_file_actions_adddup2(&streams, fileno(input), STDIN_FILENO);
    posix_spawn_file_actions_adddup2(&streams, fileno(output), STDOUT_FILENO);
    pid_t child = 0;
    const int error =
        posix_spawn(&child, words[0].c_str(), &streams, nullptr, arguments.data(), environ);
    posix_spawn_file_actions_destroy(&streams);
    if (error != 0) {
        fail(words[0] + ": " + std::strerror(error) +
             "; install python3, or name another Python 3 in GEARPOD_PYTHON");
    }
    int status = 0;
    while (waitpid(child, &status, 0) < 0) {
        if (errno != EINTR) {
            fail(std::strerror(errno));
        }
    }
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

// Output of build_page.py for the JSON and further arguments.
std::string build_page_output(const std::string& json, const std::vector<std::string>& arguments) {
    const std::string python = from_environment("GEARPOD_PYTHON", "/usr/bin/python3");
    const std::filesystem::path folder =
        from_environment("GEARPOD_REPORT_DIR", report_folder().string());
    const std::string program = folder / "build_page.py";
    if (!std::filesystem::exists(program)) {
        fail(program +
             " does not exist; set GEARPOD_REPORT_DIR to the folder analysis/report of gearpod's "
             "sources");
    }
    const TemporaryFile input = temporary_file(json), output = temporary_file("");
    // -B: write no compiled files next to the sources; -s: ignore the user's own packages.
    std::vector<std::string> words{python, "-Bs", program, "-"};
    words.insert(words.end(), arguments.begin(), arguments.end());
    const int code = run(words, input.get(), output.get());
    std::string page = content(output.get());
    if (code != 0 || page.empty()) {
        fail(python + " " + program + " ended with " + std::to_string(code));
    }
    return page;
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

std::string report_page(const std::string& json, const std::string& figures) {
    return build_page_output(json, figures.empty()
                                       ? std::vector<std::string>{}
                                       : std::vector<std::string>{"--figures", figures});
}

void write_report_page(const std::string& json, const std::string& html,
                       const std::string& figures) {
    if (html.empty() && figures.empty()) {
        return;
    }
    const std::string page = report_page(json, figures);
    if (!html.empty()) {
        write_file(html, std::as_bytes(std::span(page)));
    }
}

std::string report_summary(const std::string& json) {
    return build_page_output(json, {"--pdf"});
}

std::string report_evidence(const std::string& json) {
    return build_page_output(json, {"--evidence"});
}

}  // namespace gearpod::mc
