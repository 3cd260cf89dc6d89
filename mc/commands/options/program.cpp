#include "mc/commands/options/program.hpp"

#include <fmt/core.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <exception>
#include <string>
#include <string_view>

#include "analysis/report/report.hpp"
#include "lockstep/kernels/kernel_table.hpp"
#include "mc/files/input/problems.hpp"
#include "mc/files/input/terminal_text.hpp"
#include "mc/library/run/run_options.hpp"

namespace gearpod::mc {
namespace {

// Sets the width of reports to the width of the terminal.
void fit_terminal() {
    winsize size{};
    if (ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0) {
        analysis::set_text_width(std::min<std::size_t>(size.ws_col, 160));
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

}  // namespace

int run_safely(int argc, char** argv, int (*program)(int argc, char** argv)) {
    if (!check_arguments(argc, argv)) {
        return kBadInput;
    }
    try {
        // A program that was built for another processor would end in an illegal instruction.
        lockstep::choose_instruction_set({});
        // A limit on file sizes is an error of the write, as a full disk is, and no end by a
        // signal.
        std::signal(SIGXFSZ, SIG_IGN);
        fit_terminal();
        const int code = program(argc, argv);
        if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0) {
            fmt::print(stderr, "gearpod: standard output cannot be written\n");
            return kBadInput;
        }
        return code;
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

}  // namespace gearpod::mc
