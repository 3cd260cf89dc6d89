#include <fmt/ranges.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <exception>
#include <string>
#include <string_view>
#include <vector>

#include "analysis/report/report.hpp"
#include "lockstep/kernels/kernel_table.hpp"
#include "mc/commands/commands.hpp"
#include "mc/commands/help/reference.hpp"
#include "mc/commands/options/options.hpp"
#include "mc/ensemble/ranks.hpp"
#include "mc/files/input/problems.hpp"
#include "mc/files/input/spelling.hpp"
#include "mc/files/input/terminal_text.hpp"
#include "mc/numerics/forecast/memory.hpp"
#include "mc/results/provenance.hpp"

namespace {

using namespace gearpod::mc;

// True if `name` is a command; otherwise prints an error.
bool is_command(CLI::App& app, const std::string& name) {
    std::vector<std::string> names;
    for (const CLI::App* command : app.get_subcommands({})) {
        names.push_back(command->get_name());
    }
    if (std::ranges::find(names, name) != names.end()) {
        return true;
    }
    const std::string meant = suggest(name, {names.begin(), names.end()});
    fmt::print(stderr, "{}: unknown command; {}the commands are {}\n", name,
               meant.starts_with("did you mean") ? meant + " " : "", fmt::join(names, ", "));
    return false;
}

int output_error = 0;  // errno of the first write to standard output that failed

// Writes text as far as possible. What cannot be written, as on a full disk, is lost.
template <int descriptor>
ssize_t write_lossily(void*, const char* text, std::size_t size) {
    std::size_t written = 0;
    for (ssize_t count = 1; written < size && count > 0;) {
        count = ::write(descriptor, text + written, size - written);
        written += static_cast<std::size_t>(std::max<ssize_t>(0, count));
    }
    if (written < size && descriptor == STDOUT_FILENO && output_error == 0) {
        output_error = errno;
    }
    return static_cast<ssize_t>(size);
}

// Makes writing to the standard streams succeed always: fmt throws if it fails, also while a
// message is printed about another error. A closed pipe is no end by a signal.
void lose_unwritable_text() {
    std::signal(SIGPIPE, SIG_IGN);
    const auto replace = [](FILE*& stream, cookie_write_function_t* write, int buffering) {
        if (FILE* lossy = ::fopencookie(nullptr, "w", {nullptr, write, nullptr, nullptr})) {
            std::setvbuf(lossy, nullptr, buffering, BUFSIZ);
            stream = lossy;
        }
    };
    replace(stderr, write_lossily<STDERR_FILENO>, _IONBF);
    replace(stdout, write_lossily<STDOUT_FILENO>, isatty(STDOUT_FILENO) == 1 ? _IOLBF : _IOFBF);
}

void fit_terminal() {
    winsize size{};
    if (ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0) {
        gearpod::analysis::set_text_width(std::min<std::size_t>(size.ws_col, 160));
    }
}

// Refuses arguments with control characters: messages show arguments, and a terminal would obey
// escape sequences in them.
bool check_arguments(int argc, char** argv) {
    for (int i = 1; i < argc; ++i) {
        const std::string_view argument = argv[i];
        const std::string seen = printable(argument);
        const auto is_blank = [](char c) { return c == '\n' || c == '\t' || c == '\r'; };
        std::string without_blanks(argument);
        std::erase_if(without_blanks, is_blank);
        if (!is_printable(without_blanks)) {
            fmt::print(stderr, "gearpod: argument {} ({}) has control characters; leave them out\n",
                       i, seen);
            return false;
        }
    }
    return true;
}

// Adds the options that print the program's own description: man page, bash completion and JSON.
// The build and the documentation call the program for them.
void add_descriptions(CLI::App& app) {
    const auto print = [](const std::string& text) {
        fmt::print("{}", text);
        throw CLI::Success();
    };
    app.add_flag_callback(
        "--man", [&app, print] { print(man_page(app, version_text())); },
        "print the man page (gearpod --man | man -l -)");
    app.add_flag_callback(
        "--completion", [&app, print] { print(bash_completion(app)); },
        "print the bash completion (source <(gearpod --completion))");
    app.add_flag_callback(
        "--reference", [&app, print] { print(reference_json(app, version_text())); },
        "print commands, study keys, distributions and features as JSON");
}

int run_program(int argc, char** argv) {
    CLI::App app{
        "gearpod: which gear-tooth faults do a sensor, a feature and a threshold detect, and with "
        "what probability?"};
    app.set_version_flag(
        "--version", [] { return build_text(Ranks::library()); },
        "print the version and the build settings");
    add_descriptions(app);
    app.require_subcommand(1);
    int code = kDone;
#define GEARPOD_COMMAND(name) add_##name(app, code);
#include "mc/commands/commands.def"
#undef GEARPOD_COMMAND

    if (argc > 1 && argv[1][0] != '-' && !is_command(app, argv[1])) {
        return kBadInput;
    }
    return parse(app, argc, argv, code);
}

}  // namespace

int main(int argc, char** argv) {
    fix_memory_limits();
    lose_unwritable_text();
    if (!check_arguments(argc, argv)) {
        return kBadInput;
    }
    try {
        // A program that was built for another processor would end in an illegal instruction.
        gearpod::lockstep::choose_instruction_set({});
        // A limit on file sizes is an error of the write, as a full disk is, and no end by a
        // signal.
        std::signal(SIGXFSZ, SIG_IGN);
        fit_terminal();
        const int code = run_program(argc, argv);
        std::fflush(stdout);
        // Whoever closes a pipe, such as `head`, wants no more output.
        if (output_error != 0 && output_error != EPIPE) {
            fmt::print(stderr, "gearpod: standard output cannot be written ({})\n",
                       std::strerror(output_error));
        }
        return output_error == 0 ? code : kBadInput;
    } catch (const std::exception& error) {
        // Name the command and its first argument, because the command did not handle the error.
        std::string call = "gearpod";
        for (int i = 1; i < std::min(argc, 3); ++i) {
            call += std::string(" ") + argv[i];
        }
        fmt::print(stderr, "{}: {}\n", printable(call), exception_text(error));
        return kBadInput;
    }
}
