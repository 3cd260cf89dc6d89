#include "mc/commands/options/program.hpp"

#include <fmt/core.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <exception>
#include <string>
#include <string_view>
#include <system_error>

#include "analysis/report/report.hpp"
#include "lockstep/kernels/kernel_table.hpp"
#include "mc/files/input/problems.hpp"
#include "mc/files/input/terminal_text.hpp"
#include "mc/library/run/run_options.hpp"

namespace gearpod::mc {
namespace {

// Writes a message as far as possible. What cannot be written, as on a full disk, is lost.
ssize_t write_message(void*, const char* text, std::size_t size) {
    std::size_t written = 0;
    for (ssize_t count = 1; written < size && count > 0;) {
        count = ::write(STDERR_FILENO, text + written, size - written);
        written += static_cast<std::size_t>(std::max<ssize_t>(0, count));
    }
    return static_cast<ssize_t>(size);
}

// Makes writing to stderr succeed always: fmt throws if it fails, also while a message is printed
// about another error. A closed pipe is an error of the write, too, and no end by a signal.
void lose_unwritable_messages() {
    std::signal(SIGPIPE, SIG_IGN);
    if (FILE* messages = ::fopencookie(nullptr, "w", {nullptr, write_message, nullptr, nullptr})) {
        std::setvbuf(messages, nullptr, _IONBF, 0);
        stderr = messages;
    }
}

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
    lose_unwritable_messages();
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
            throw std::system_error(errno, std::generic_category(),
                                    "standard output cannot be written");
        }
        return code;
    } catch (const std::exception& error) {
        const auto* const output = dynamic_cast<const std::system_error*>(&error);
        if (output != nullptr && output->code() == std::errc::broken_pipe) {
            return kBadInput;  // whoever read the output, such as `head`, wanted no more of it
        }
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
