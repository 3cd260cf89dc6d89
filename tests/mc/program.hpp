// Runs the built program as a user does, and collects its output.
#pragma once

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "mc/results/results_file.hpp"
#include "tests/mc/gearbox_bits.hpp"
#include "tests/numbers.hpp"
#include "tests/shipped_studies.hpp"

namespace gearpod::test {

// Temporary folder, removed by the destructor.
class Folder {
  public:
    Folder() {
        std::string name =
            (std::filesystem::temp_directory_path() / "gearpod-test-XXXXXX").string();
        REQUIRE(mkdtemp(name.data()) != nullptr);
        path_ = name;
        std::filesystem::permissions(path_, std::filesystem::perms(0755));
    }
    ~Folder() { std::filesystem::remove_all(path_); }
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;

    std::string path() const { return path_.string(); }
    std::string file(const std::string& name) const { return (path_ / name).string(); }
    bool empty() const { return std::filesystem::is_empty(path_); }
    long files() const {
        return std::distance(std::filesystem::directory_iterator(path_),
                             std::filesystem::directory_iterator{});
    }

  private:
    std::filesystem::path path_;
};

// Path of a file, not yet written, in a temporary folder of its own.
struct TemporaryFile {
    explicit TemporaryFile(const std::string& name) : path(folder.file(name)) {}

    Folder folder;
    std::string path;
};

// Replaces every line break and the spaces around it by a single space.
inline std::string without_line_breaks(const std::string& text) {
    std::string out;
    for (const char c : text) {
        const bool after_break = !out.empty() && out.back() == '\n';
        if (c == '\n') {
            out.erase(out.find_last_not_of(" \n") + 1);
            out += '\n';
        } else if (c != ' ' || !after_break) {
            out += c;
        }
    }
    std::replace(out.begin(), out.end(), '\n', ' ');
    return out;
}

struct Outcome {
    int code = 0;
    std::string output;  // both streams

    // True if the output contains the text, perhaps broken into several lines.
    bool mentions(const std::string& text) const {
        return output.find(text) != std::string::npos ||
               without_line_breaks(output).find(text) != std::string::npos;
    }
};

inline Outcome shell(const std::string& command) {
    FILE* pipe = popen(("exec 2>&1; " + command).c_str(), "r");
    REQUIRE(pipe != nullptr);
    Outcome outcome;
    std::array<char, 4096> buffer;
    while (fgets(buffer.data(), buffer.size(), pipe) != nullptr) {
        outcome.output += buffer.data();
    }
    outcome.code = WEXITSTATUS(pclose(pipe));
    return outcome;
}

// Command prefix that limits the memory to so many kB. Empty under the address sanitizer, whose
// shadow needs all memory.
inline std::string within_memory([[maybe_unused]] int kilobytes) {
#ifdef __SANITIZE_ADDRESS__
    return "";
#else
    return "ulimit -v " + std::to_string(kilobytes) + "; ";
#endif
}

// Option of `describe` that lets it measure as much as a release build does in so many seconds.
// The sanitizers make programs about fifteen times as slow.
inline std::string measuring_for(int seconds) {
#ifdef __SANITIZE_ADDRESS__
    seconds *= 15;
#endif
    return " --seconds " + std::to_string(seconds);
}

// Runs the program. `describe` measures for 10 s of each thread by default, here for one, and
// prints everything.
inline Outcome program(const std::string& arguments) {
    const bool describes =
        arguments.starts_with("describe ") && arguments.find("--keys") == std::string::npos;
    const bool measures = describes && arguments.find("--seconds") == std::string::npos;
    return shell(std::string(GEARPOD_PROGRAM) + " " + arguments + (describes ? " --full" : "") +
                 (measures ? " --seconds 1" : ""));
}

// Processor time of all child processes that have ended.
inline double children_s() {
    rusage used{};
    getrusage(RUSAGE_CHILDREN, &used);
    return static_cast<double>(used.ru_utime.tv_sec + used.ru_stime.tv_sec) +
           1e-6 * static_cast<double>(used.ru_utime.tv_usec + used.ru_stime.tv_usec);
}

inline void check_mentions(const Outcome& outcome, const std::vector<std::string>& words) {
    INFO(outcome.output);
    for (const std::string& text : words) {
        INFO(text);
        CHECK(outcome.mentions(text));
    }
}

// Checks that a command ended with success.
inline Outcome require_success(const Outcome& outcome) {
    INFO(outcome.output);
    REQUIRE(outcome.code == 0);
    return outcome;
}
inline Outcome require_success(const std::string& arguments) {
    INFO(arguments);
    return require_success(program(arguments));
}

// Checks that a command ended as one with bad input does, with a message that has all these words.
inline Outcome check_refused(const Outcome& outcome, const std::vector<std::string>& words = {}) {
    check_mentions(outcome, words);
    INFO(outcome.output);
    CHECK(outcome.code == 2);
    return outcome;
}
inline Outcome check_refused(const std::string& arguments,
                             const std::vector<std::string>& words = {}) {
    INFO(arguments);
    return check_refused(program(arguments), words);
}

// Command prefix for that many ranks, allowed as root and with more ranks than processors; empty in
// a build without MPI. Open MPI unloads modules that leak memory, which the address sanitizer
// cannot attribute; programs of one rank are checked for leaks.
inline std::string mpirun(int ranks) {
    if (std::string(GEARPOD_MPIEXEC).empty()) {
        return "";
    }
    return std::string(
               "OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 "
               "ASAN_OPTIONS=detect_leaks=0 ") +
           GEARPOD_MPIEXEC + " --oversubscribe -n " + std::to_string(ranks) + " ";
}

inline std::string study(const std::string& name) {
    return study_path(name);
}

inline std::string bytes_of(const std::string& path) {
    std::ifstream stream(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

inline void write_bytes(const std::string& path, const std::string& bytes) {
    std::ofstream(path, std::ios::binary) << bytes;
}

// Message of the error that a call throws, "" if there is none.
template <class Call>
std::string message_of(Call call) {
    try {
        call();
    } catch (const std::runtime_error& error) {
        return error.what();
    }
    return "";
}

// All datasets of the gearboxes bit by bit.
inline Bits bits(const mc::Results& results) {
    Bits all;
    const auto add = [&](const auto& columns) {
        for (const auto& column : columns) {
            const auto more = bits_of(column.values);
            all.insert(all.end(), more.begin(), more.end());
        }
    };
    add(results.parameters);
    add(results.features);
    add(results.contact_loss);
    for (const auto& variant : results.variants) {
        add(variant.features);
    }
    all.insert(all.end(), results.group.begin(), results.group.end());
    all.insert(all.end(), results.status.begin(), results.status.end());
    return all;
}

inline Bits bits(const std::string& path) {
    return bits(mc::read_results(path));
}

}  // namespace gearpod::test
