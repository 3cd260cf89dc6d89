#include "mc/files/python/python_worker.hpp"

#include <fmt/format.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <memory>
#include <nlohmann/json.hpp>
#include <utility>

#include "machine/clocks.hpp"
#include "machine/team.hpp"
#include "mc/files/file_descriptor.hpp"
#include "python_sources.hpp"

namespace gearpod::mc {
namespace {

// Time after which a notice says which feature is still being computed.
constexpr double kNotice_s = 60.0;
constexpr int kPoll_ms = 100;

std::atomic<double> waited_total_s{0.0};

// Environment of this process, with a fixed order of Python's sets.
std::vector<std::string> worker_environment() {
    std::vector<std::string> all;
    for (char** entry = environ; *entry != nullptr; ++entry) {
        if (std::string_view(*entry).substr(0, 15) != "PYTHONHASHSEED=") {
            all.emplace_back(*entry);
        }
    }
    all.emplace_back("PYTHONHASHSEED=0");
    return all;
}

std::vector<char*> pointers_to(std::vector<std::string>& texts) {
    std::vector<char*> pointers;
    for (std::string& text : texts) {
        pointers.push_back(text.data());
    }
    pointers.push_back(nullptr);
    return pointers;
}

}  // namespace

PythonWorker::PythonWorker() {
    const std::string python = python_interpreter();
    std::array<int, 2> ends{-1, -1};
    if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0) {
        throw PythonError(
            fmt::format("{}: creating a socket failed ({})", python, std::strerror(errno)));
    }
    here_ = Descriptor(ends[0]);
    const Descriptor there(ends[1]);
    // -B: write no compiled files next to the user's; -u: show at once what features print.
    std::vector<std::string> words{python, "-Bu", "-c", kWorkerSource};
    std::vector<std::string> environment = worker_environment();
    posix_spawn_file_actions_t streams;
    posix_spawn_file_actions_init(&streams);
    posix_spawn_file_actions_adddup2(&streams, there.get(), STDIN_FILENO);
    posix_spawn_file_actions_adddup2(&streams, STDERR_FILENO, STDOUT_FILENO);
    // Signals that the program handles or blocks must act in the worker as usual.
    posix_spawnattr_t attributes;
    posix_spawnattr_init(&attributes);
    sigset_t none;
    ::sigemptyset(&none);
    posix_spawnattr_setsigmask(&attributes, &none);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGMASK);
    const int error = posix_spawn(&child_, python.c_str(), &streams, &attributes,
                                  pointers_to(words).data(), pointers_to(environment).data());
    posix_spawn_file_actions_destroy(&streams);
    posix_spawnattr_destroy(&attributes);
    if (error != 0) {
        child_ = -1;
        throw PythonError(
            fmt::format("{}: cannot be started ({}); name a Python 3 with numpy in GEARPOD_PYTHON",
                        python, std::strerror(error)));
    }
}

std::vector<double> PythonWorker::ask(const nlohmann::json& request, std::span<const double> values,
                                      const std::string& work, nlohmann::json& reply) {
    std::string message = request.dump();
    message.append(sizeof(double) - 1 - message.size() % sizeof(double), ' ');
    message += '\n';  // the doubles are aligned
    std::string bytes;
    if (child_ < 0 || !send_framed(here_.get(), message, std::as_bytes(values))) {
        report_end(work);
    }
    wait_for_reply(work);
    if (!receive_framed(here_.get(), bytes, -1)) {
        report_end(work);
    }
    const std::size_t line = bytes.find('\n');
    reply = nlohmann::json::parse(bytes.substr(0, line));
    if (const auto refused = reply.find("refused"); refused != reply.end()) {
        throw PythonError(refused->get<std::string>());
    }
    std::vector<double> received((bytes.size() - line - 1) / sizeof(double));
    if (!received.empty()) {
        std::memcpy(received.data(), bytes.data() + line + 1, received.size() * sizeof(double));
    }
    return received;
}

void PythonWorker::wait_for_reply(const std::string& work) {
    const auto start = WallClock::now();
    double counted_s = 0.0;
    const auto count = [&] {
        const double now_s = seconds_since(start);
        waited_total_s += now_s - std::exchange(counted_s, now_s);
    };
    bool noticed = false;
    pollfd ready{here_.get(), POLLIN, 0};
    while (::poll(&ready, 1, kPoll_ms) <= 0) {
        count();
        try {
            machine::throw_if_cancelled();
        } catch (const machine::Cancelled&) {
            end();
            throw;
        }
        if (!noticed && seconds_since(start) > kNotice_s) {
            noticed = true;
            fmt::print(stderr, "note: Python has been computing for {:g} s: {}\n", kNotice_s, work);
        }
    }
    count();
}

void PythonWorker::report_end(const std::string& work) {
    const int status = end();
    const std::string how = WIFSIGNALED(status)
                                ? fmt::format("was ended by signal {} ({})", WTERMSIG(status),
                                              ::strsignal(WTERMSIG(status)))
                                : fmt::format("ended with exit code {}", WEXITSTATUS(status));
    throw PythonError(fmt::format("{}: the Python process {}", work, how));
}

int PythonWorker::end() {
    int status = 0;
    if (child_ < 0) {
        return status;
    }
    here_.close();
    // A process that has closed its end is ending by itself, and its own status is wanted.
    constexpr int kTries = 50;
    pid_t ended = 0;
    for (int i = 0; i < kTries && ended == 0; ++i) {
        ended = ::waitpid(child_, &status, WNOHANG);
        if (ended == 0) {
            ::usleep(2000);
        }
    }
    if (ended == 0) {
        ::kill(child_, SIGKILL);
        while (::waitpid(child_, &status, 0) < 0 && errno == EINTR) {
        }
    }
    child_ = -1;
    return status;
}

PythonWorker& PythonWorker::of_thread() {
    thread_local std::unique_ptr<PythonWorker> worker;
    if (!worker || worker->child_ < 0) {
        worker = std::make_unique<PythonWorker>();
    }
    return *worker;
}

double PythonWorker::waited_s() {
    return waited_total_s;
}

PythonFile PythonWorker::load(const std::string& path) {
    return load(path, nullptr);
}

void PythonWorker::require(const std::string& path, const PythonHashes& hashes) {
    const auto found = loaded_.find(path);
    if (found == loaded_.end() || found->second != hashes) {
        load(path, &hashes);
    }
}

PythonFile PythonWorker::load(const std::string& path, const PythonHashes* expected) {
    nlohmann::json request{{"file", path}}, json;
    if (expected != nullptr) {
        request["sha256"] = expected->sha256;
        request["modules"] = expected->modules;
    }
    ask(request, {}, path, json);
    PythonFile file{{json.at("sha256"), json.at("modules")}, {}};
    for (const auto& one : json.at("functions")) {
        file.functions.push_back({one.at("name"), one.at("title"), one.at("unit"), one.at("alarm"),
                                  one.at("uses"), one.at("doc"), one.at("samples")});
    }
    loaded_[path] = file.hashes;
    return file;
}

}  // namespace gearpod::mc
