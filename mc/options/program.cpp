#include "mc/options/program.hpp"

#include <fmt/core.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <exception>
#include <string>

#include "analysis/report/text_lines.hpp"
#include "lockstep/kernels/built_kernels.hpp"
#include "mc/input/exception_text.hpp"
#include "mc/input/printable.hpp"
#include "mc/run/run_options.hpp"

namespace gearpod::mc {
namespace {

// Sets the width of reports to the width of the terminal.
void fit_terminal() {
    winsize size{};
    if (ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0) {
        analysis::set_text_width(std::min<std::size_t>(size.ws_col, 160));
    }
}

}  // namespace

int run_safely(int argc, char** argv, int (*program)(int argc, char** argv)) {
    try {
        // A program that was built for another processor would end in an illegal instruction.
        lockstep::choose_instruction_set({});
        // A limit on file sizes is an error of the write, as a full disk is, and no end by a signal.
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
