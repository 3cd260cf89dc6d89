#include "mc/files/python/python_worker.hpp"

#include <fmt/format.h>
#include <poll.h>
#include <signal.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <cstring>
#include <memory>
#include <nlohmann/json.hpp>
#include <utility>

#include "machine/clocks.hpp"
#include "machine/team.hpp"
#include "mc/files/atomic_file.hpp"
#include "python_sources.hpp"

namespace gearpod::mc {
namespace {

// Time after which a notice says which feature is still being computed.
constexpr double kNotice_s = 60.0;
constexpr int kPoll_ms = 100;

std::atomic<double> waited_total_s{0.0};

}  // namespace

PythonWorker::PythonWorker() {
    std::array<int, 2> ends{-1, -1};
    if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0) {
        throw PythonError(fmt::format("creating a socket failed ({})", std::strerror(errno)));
    }
    here_ = Descriptor(ends[0]);
    const Descriptor there(ends[1]);
    // -B: write no compiled files next to the user's; -u: show at once what features print.
    child_ = start_python({"-Bu", "-c", kWorkerSource}, there.get(), STDERR_FILENO, STDERR_FILENO);
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
    throw PythonError(fmt::format("{}: the Python process {}", work, ended_text(end())));
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
        status = wait_for_end(child_);
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
