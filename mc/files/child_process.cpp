#include "mc/files/child_process.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <spawn.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <filesystem>
#include <fstream>
#include <memory>
#include <new>
#include <string_view>

#include "machine/stop_signals.hpp"
#include "mc/files/atomic_file.hpp"

namespace gearpod::mc {
namespace {

// Unnamed temporary file, deleted when it is closed.
using UnnamedFile = std::unique_ptr<FILE, int (*)(FILE*)>;

UnnamedFile unnamed_file(const std::string& text) {
    UnnamedFile file(std::tmpfile(), std::fclose);
    if (!file || std::fwrite(text.data(), 1, text.size(), file.get()) != text.size() ||
        std::fflush(file.get()) != 0 || lseek(fileno(file.get()), 0, SEEK_SET) != 0) {
        throw PythonError(std::string("no temporary file: ") + std::strerror(errno));
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

std::vector<char*> pointers_to(std::vector<std::string>& texts) {
    std::vector<char*> pointers;
    for (std::string& text : texts) {
        pointers.push_back(text.data());
    }
    pointers.push_back(nullptr);
    return pointers;
}

constexpr std::uintmax_t kTrialMemory = std::uintmax_t{256} << 20;
constexpr std::uintmax_t kTrial_s = 10, kTrialBytes_s = 10000000, kLongestTrial_s = 3600;

// Limits of the child process: the memory is the present use plus `more_memory` bytes, core files
// are disabled, crashes have their default actions, and the process ends with its parent.
void confine_child(std::uintmax_t more_memory) {
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    for (const int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGALRM}) {
        ::signal(signal, SIG_DFL);  // removes the handlers of the parent process
    }
    for (const int signal : machine::kStopSignals) {  // the parent decides when this one ends
        ::signal(signal, SIG_IGN);
    }
    std::ifstream statm("/proc/self/statm");
    std::uintmax_t pages = 0;
    rlimit limit{};
    if (statm >> pages && ::getrlimit(RLIMIT_AS, &limit) == 0) {
        const auto page = static_cast<std::uintmax_t>(::sysconf(_SC_PAGESIZE));
        limit.rlim_cur = std::min<rlim_t>(limit.rlim_cur, pages * page + more_memory);
        ::setrlimit(RLIMIT_AS, &limit);
    }
    const rlimit none{0, 0};
    ::setrlimit(RLIMIT_CORE, &none);
}

}  // namespace

std::string python_interpreter() {
    const char* given = std::getenv("GEARPOD_PYTHON");
    return given != nullptr && *given != '\0' ? given : "/usr/bin/python3";
}

pid_t start_python(std::vector<std::string> arguments, int input, int output, int errors) {
    arguments.insert(arguments.begin(), python_interpreter());
    std::vector<std::string> environment{"PYTHONHASHSEED=0"};
    for (char** entry = environ; *entry != nullptr; ++entry) {
        if (!std::string_view(*entry).starts_with("PYTHONHASHSEED=")) {
            environment.emplace_back(*entry);
        }
    }
    posix_spawn_file_actions_t streams;
    posix_spawn_file_actions_init(&streams);
    posix_spawn_file_actions_adddup2(&streams, input, STDIN_FILENO);
    posix_spawn_file_actions_adddup2(&streams, output, STDOUT_FILENO);
    posix_spawn_file_actions_adddup2(&streams, errors, STDERR_FILENO);
    posix_spawnattr_t attributes;
    posix_spawnattr_init(&attributes);
    sigset_t none;
    ::sigemptyset(&none);
    posix_spawnattr_setsigmask(&attributes, &none);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGMASK);
    pid_t child = -1;
    const int error = posix_spawn(&child, arguments[0].c_str(), &streams, &attributes,
                                  pointers_to(arguments).data(), pointers_to(environment).data());
    posix_spawn_file_actions_destroy(&streams);
    posix_spawnattr_destroy(&attributes);
    if (error != 0) {
        throw PythonError(
            fmt::format("{} cannot be started ({}); install python3, or name another Python 3 in "
                        "GEARPOD_PYTHON",
                        arguments[0], std::strerror(error)));
    }
    return child;
}

int wait_for_end(pid_t child) {
    int status = 0;
    while (::waitpid(child, &status, 0) < 0) {
        if (errno != EINTR) {
            throw PythonError(std::strerror(errno));
        }
    }
    return status;
}

std::string ended_text(int status) {
    return WIFSIGNALED(status) ? fmt::format("was ended by signal {} ({})", WTERMSIG(status),
                                             ::strsignal(WTERMSIG(status)))
                               : fmt::format("ended with exit code {}", WEXITSTATUS(status));
}

PythonOutput run_python(const std::vector<std::string>& arguments, const std::string& input,
                        bool silent) {
    const UnnamedFile in = unnamed_file(input), out = unnamed_file("");
    const Descriptor null(::open("/dev/null", O_WRONLY | O_CLOEXEC));
    const int status = wait_for_end(start_python(arguments, fileno(in.get()), fileno(out.get()),
                                                 silent ? null.get() : STDERR_FILENO));
    return {status, content(out.get())};
}

bool survives_reading(const std::string& path, const std::function<void()>& read,
                      std::uintmax_t memory_per_byte) {
    std::error_code error;
    const std::uintmax_t found = std::filesystem::file_size(path, error);
    const std::uintmax_t size = error ? 0 : found;
    const pid_t child = ::fork();
    if (child < 0) {
        return true;
    }
    if (child == 0) {
        confine_child(kTrialMemory + memory_per_byte * size);
        ::alarm(static_cast<unsigned>(std::min(kTrial_s + size / kTrialBytes_s, kLongestTrial_s)));
        try {
            read();
        } catch (const std::bad_alloc&) {
            ::_exit(1);
        } catch (const std::exception&) {
            ::_exit(0);  // the caller gets the same exception
        }
        ::_exit(0);
    }
    int status = 0;
    while (::waitpid(child, &status, 0) < 0) {
        if (errno != EINTR) {
            return true;
        }
    }
    return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

}  // namespace gearpod::mc
