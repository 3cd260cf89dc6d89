#include "mc/files/isolated_reading.hpp"

#include <fmt/format.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <exception>
#include <filesystem>
#include <fstream>
#include <new>
#include <span>
#include <utility>

#include "mc/files/file_descriptor.hpp"

namespace gearpod::mc {
namespace {

constexpr std::uintmax_t kTrialMemory = std::uintmax_t{256} << 20, kTrialMemoryPerByte = 8;
constexpr std::uintmax_t kTrial_s = 8, kTrialBytes_s = 10000000, kLongestTrial_s = 3600;

}  // namespace

void confine_child(std::uintmax_t more_memory) {
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    for (const int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGALRM, SIGINT, SIGTERM}) {
        ::signal(signal, SIG_DFL);  // removes the handlers of the parent process
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

bool survives_reading(const std::string& path, const std::function<void()>& read) {
    std::error_code error;
    const std::uintmax_t found = std::filesystem::file_size(path, error);
    const std::uintmax_t size = error ? 0 : found;
    const pid_t child = ::fork();
    if (child < 0) {
        return true;
    }
    if (child == 0) {
        confine_child(kTrialMemory + kTrialMemoryPerByte * size);
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

namespace {

constexpr std::size_t kFreeMemory = std::size_t{256} << 20, kMemoryPerByte = 1000;
// Time without any reply after which reading fails: this time, plus one second per ten megabytes of
// the file.
constexpr std::uintmax_t kTimeout_ms = 8000, kBytes_ms = 10000, kLongestTimeout_ms = 3600000;

enum class Request : char { names, read, unit, sampling_Hz, sampling_Hz_of, find, contents, notes };
enum class Reply : char { good, refused };

// A message consists of its kind and further bytes.
bool send_message(int fd, char kind, const std::string& bytes) {
    return send_framed(fd, kind + bytes);
}
bool receive_message(int fd, char& kind, std::string& bytes, int timeout_ms) {
    if (!receive_framed(fd, bytes, timeout_ms) || bytes.empty()) {
        return false;
    }
    kind = bytes.front();
    bytes.erase(0, 1);
    return true;
}

std::string bytes_of_doubles(std::span<const double> values) {
    std::string bytes(values.size() * sizeof(double), '\0');
    if (!values.empty()) {
        std::memcpy(bytes.data(), values.data(), bytes.size());
    }
    return bytes;
}

std::vector<double> doubles_in(const std::string& bytes) {
    std::vector<double> values(bytes.size() / sizeof(double));
    if (!values.empty()) {
        std::memcpy(values.data(), bytes.data(), values.size() * sizeof(double));
    }
    return values;
}

// Texts without zero bytes, each followed by one.
std::string bytes_of_texts(const std::vector<std::string>& texts) {
    std::string bytes;
    for (const std::string& text : texts) {
        bytes += text + '\0';
    }
    return bytes;
}

std::vector<std::string> texts_in(const std::string& bytes) {
    std::vector<std::string> texts;
    for (std::size_t at = 0; at < bytes.size(); at = bytes.find('\0', at) + 1) {
        texts.emplace_back(bytes.c_str() + at);
    }
    return texts;
}

std::string bytes_of_rate(std::optional<double> rate) {
    return rate ? bytes_of_doubles(std::array{*rate}) : "";
}

std::optional<double> rate_in(const std::string& bytes) {
    const std::vector<double> rate = doubles_in(bytes);
    return rate.empty() ? std::nullopt : std::optional(rate.front());
}

std::string reply_to(Request request, const std::string& name, SignalFile& file) {
    switch (request) {
        case Request::names:
            return bytes_of_texts(file.names());
        case Request::read:
            return bytes_of_doubles(file.read(name));
        case Request::unit:
            return file.unit(name);
        case Request::sampling_Hz:
            return bytes_of_rate(file.sampling_Hz());
        case Request::sampling_Hz_of:
            return bytes_of_rate(file.sampling_Hz_of(name));
        case Request::find: {
            const std::vector<std::string> choice = texts_in(name);
            return file.find({choice.at(0), choice.at(1), !choice.at(2).empty()});
        }
        case Request::contents:
            return file.contents();
        case Request::notes:
            break;
    }
    return bytes_of_texts(file.notes());
}

// Main loop of the child process, until the parent closes the connection.
[[noreturn]] void serve(int fd, const std::string& path, std::size_t memory,
                        const std::function<std::unique_ptr<SignalFile>()>& open) {
    confine_child(memory);
    std::unique_ptr<SignalFile> file;
    Request request = Request::notes;  // the first reply reports whether the file can be opened
    std::string name;
    for (char kind = 0;; request = static_cast<Request>(kind)) {
        Reply reply = Reply::good;
        std::string text;
        try {
            file = file ? std::move(file) : open();
            text = reply_to(request, name, *file);
        } catch (const SignalError& error) {
            reply = Reply::refused;
            text = error.what();
        } catch (const std::bad_alloc&) {
            reply = Reply::refused;
            text = path + ": is damaged, or needs more memory than reading a file may use";
        }
        if (!send_message(fd, static_cast<char>(reply), text) || !file ||
            !receive_message(fd, kind, name, -1)) {
            ::_exit(0);
        }
    }
}

class IsolatedSignal : public SignalFile {
  public:
    IsolatedSignal(const std::string& path,
                   const std::function<std::unique_ptr<SignalFile>()>& open)
        : path_(path) {
        int ends[2] = {-1, -1};
        if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0) {
            throw SignalError(fmt::format("{}: cannot be read: creating a socket failed ({})", path,
                                          std::strerror(errno)));
        }
        here_ = std::make_unique<Descriptor>(ends[0]);
        Descriptor there(ends[1]);
        std::error_code error;
        const auto found = std::filesystem::file_size(path, error);
        const std::uintmax_t size = error ? 0 : found;
        timeout_ms_ =
            static_cast<int>(std::min(kTimeout_ms + size / kBytes_ms, kLongestTimeout_ms));
        child_ = ::fork();
        if (child_ < 0) {
            throw SignalError(fmt::format("{}: cannot be read: creating a process failed ({})",
                                          path, std::strerror(errno)));
        }
        if (child_ == 0) {
            ::close(ends[0]);
            try {
                serve(ends[1], path, kFreeMemory + kMemoryPerByte * size, open);
            } catch (...) {
                ::_exit(1);
            }
        }
        there.close();
        try {
            receive_reply();
        } catch (...) {
            end();
            throw;
        }
    }
    IsolatedSignal(const IsolatedSignal&) = delete;
    IsolatedSignal& operator=(const IsolatedSignal&) = delete;
    ~IsolatedSignal() override { end(); }

    std::vector<std::string> names() const override {
        return texts_in(send_request(Request::names, ""));
    }
    std::vector<double> read(const std::string& name) override {
        return doubles_in(send_request(Request::read, name));
    }
    std::string unit(const std::string& name) override { return send_request(Request::unit, name); }
    std::optional<double> sampling_Hz() override {
        return rate_in(send_request(Request::sampling_Hz, ""));
    }
    std::optional<double> sampling_Hz_of(const std::string& name) override {
        return rate_in(send_request(Request::sampling_Hz_of, name));
    }
    std::string find(const ColumnChoice& choice) override {
        return send_request(Request::find, bytes_of_texts({choice.name, choice.near,
                                                           choice.requested ? "requested" : ""}));
    }
    std::string contents() override { return send_request(Request::contents, ""); }
    std::vector<std::string> notes() override { return texts_in(send_request(Request::notes, "")); }

  private:
    std::string send_request(Request request, const std::string& name) const {
        send_message(here_->get(), static_cast<char>(request), name);
        return receive_reply();
    }
    std::string receive_reply() const {
        char kind = 0;
        std::string text;
        if (!receive_message(here_->get(), kind, text, timeout_ms_)) {
            throw SignalError(
                path_ +
                ": is damaged: the library for this file type crashes on it, or does not finish");
        }
        if (static_cast<Reply>(kind) == Reply::refused) {
            throw SignalError(text);
        }
        return text;
    }
    void end() {
        here_->close();
        if (child_ > 0) {
            ::kill(child_, SIGKILL);
            while (::waitpid(child_, nullptr, 0) < 0 && errno == EINTR) {
            }
            child_ = -1;
        }
    }

    std::string path_;
    std::unique_ptr<Descriptor> here_;
    pid_t child_ = -1;
    int timeout_ms_ = 0;
};

}  // namespace

std::unique_ptr<SignalFile> isolated_signal(
    const std::string& path, const std::function<std::unique_ptr<SignalFile>()>& open) {
    return std::make_unique<IsolatedSignal>(path, open);
}

}  // namespace gearpod::mc
