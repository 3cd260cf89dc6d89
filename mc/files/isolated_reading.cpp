#include "mc/files/isolated_reading.hpp"

#include <signal.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <exception>
#include <filesystem>
#include <fstream>
#include <new>

#include "machine/stop_signals.hpp"

namespace gearpod::mc {
namespace {

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
